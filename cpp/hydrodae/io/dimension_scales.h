#pragma once
/// Names of the dimensions of a dataset (HDF5 dimension scales), by which netCDF and xarray know
/// that all channels share one time axis.

#include <string>
#include <vector>

#include "hydrodae/io/hdf5.h"

namespace hydrodae::io::hdf5 {

/// Makes a dataset, which lies at the root, the scale of the dimension `name`.
void make_scale(hid_t dataset, const std::string& name, const std::string& what);

/// A dataset of words at the root that is the scale of a dimension: "component": x, y, z.
void write_labels(hid_t file, const std::string& name, const std::vector<std::string>& labels,
                  const std::string& what);

/// The scales of the dimensions of many datasets, by their names at the root, one for each
/// dimension: the attribute DIMENSION_LIST. The list of users that a scale may carry is left out,
/// since readers do not need it and its cost grows with the square of the number of channels.
class ScaleList {
public:
  ScaleList(hid_t file, const std::vector<std::string>& scales, const std::string& what);
  void attach(hid_t dataset, const std::string& what);

private:
  std::vector<hobj_ref_t> references_;
  Handle type_, space_;
};

} // namespace hydrodae::io::hdf5
