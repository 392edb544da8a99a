#include "hydrodae/io/hdf5.h"

namespace hydrodae::io::hdf5 {
namespace {

herr_t take_first(unsigned, const H5E_error2_t* error, void* text) {
  *static_cast<std::string*>(text) = error->desc ? error->desc : "";
  return 1; // stop after the innermost entry
}

} // namespace

std::string reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  return text.empty() ? "unknown HDF5 error" : text;
}

Handle text_type() {
  Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "HDF5 text type");
  checked(H5Tset_size(type, H5T_VARIABLE), "HDF5 text type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "HDF5 text type");
  return type;
}

} // namespace hydrodae::io::hdf5
