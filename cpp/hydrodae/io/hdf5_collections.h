#pragma once
#include <string>

namespace hydrodae::io::hdf5 {

/// Throws CaseError where a collection of texts of variable length is damaged. The HDF5 library
/// reads an object of no size in such a collection for ever (H5HG__cache_heap_deserialize), so the
/// file is searched before it is opened. Layout: HDF5 File Format Specification, III.E.
void check_collections(const std::string& path);

} // namespace hydrodae::io::hdf5
