#include "hydrodae/io/dimension_scales.h"

namespace hydrodae::io::hdf5 {
namespace {

/// A text of fixed length, as the specification of dimension scales wants it.
void write_fixed(hid_t object, const char* name, const std::string& value,
                 const std::string& what) {
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, what);
  checked(H5Tset_size(type, value.size() + 1), what);
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute =
      checked(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  checked(H5Awrite(attribute, type, value.c_str()), what);
}

} // namespace

void make_scale(hid_t dataset, const std::string& name, const std::string& what) {
  write_fixed(dataset, "CLASS", "DIMENSION_SCALE", what);
  write_fixed(dataset, "NAME", name, what);
}

void write_labels(hid_t file, const std::string& name, const std::vector<std::string>& labels,
                  const std::string& what) {
  const Handle type = text_type();
  const hsize_t size = labels.size();
  const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, what);
  const Handle dataset =
      checked(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
              H5Dclose, what);
  std::vector<const char*> words;
  for (const std::string& label : labels)
    words.push_back(label.c_str());
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, words.data()), what);
  make_scale(dataset, name, what);
}

ScaleList::ScaleList(hid_t file, const std::vector<std::string>& scales, const std::string& what)
    : references_(scales.size()) {
  for (std::size_t k = 0; k < scales.size(); ++k)
    checked(H5Rcreate(&references_[k], file, scales[k].c_str(), H5R_OBJECT, -1), what);
  const hsize_t rank = scales.size();
  type_ = checked(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose, what);
  space_ = checked(H5Screate_simple(1, &rank, nullptr), H5Sclose, what);
}

void ScaleList::attach(hid_t dataset, const std::string& what) {
  std::vector<hvl_t> lists;
  for (hobj_ref_t& reference : references_)
    lists.push_back({1, &reference});
  const Handle attribute =
      checked(H5Acreate2(dataset, "DIMENSION_LIST", type_, space_, H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose, what);
  checked(H5Awrite(attribute, type_, lists.data()), what);
}

} // namespace hydrodae::io::hdf5
