#pragma once
/// The HDF5 file driver through which HDF5 reads and writes an OrderedFile.

#include "hydrodae/io/hdf5.h"

namespace hydrodae::io {

class OrderedFile;

hdf5::Handle ordered_access_properties(OrderedFile& file);

} // namespace hydrodae::io
