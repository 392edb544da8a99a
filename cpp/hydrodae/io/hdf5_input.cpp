#include "hydrodae/io/hdf5_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "hydrodae/core/text.h"
#include "hydrodae/io/hdf5_collections.h"

namespace hydrodae::io::hdf5 {
namespace {

/// A file may claim more than it holds, or than memory does. No database needs more numbers in a
/// table (sixty bodies, 300 frequencies), in a list or texts of this length.
constexpr double most_numbers = 5e7;
constexpr hsize_t longest_list = 10'000'000, most_labels = 100'000;
constexpr std::size_t longest_text = 4096;

std::string shape_text(const std::vector<hsize_t>& shape) {
  std::vector<std::string> sizes;
  for (hsize_t size : shape)
    sizes.push_back(std::to_string(size));
  return "(" + joined(sizes) + ")";
}

std::vector<hsize_t> shape_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (!shape.empty())
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

std::size_t size_of(const std::vector<hsize_t>& shape) {
  std::size_t size = 1;
  for (hsize_t n : shape)
    size *= static_cast<std::size_t>(n);
  return size;
}

/// h5py's complex numbers: a compound of two doubles "r" and "i"; single precision is converted.
Handle complex_type() {
  Handle type =
      checked(H5Tcreate(H5T_COMPOUND, sizeof(std::complex<double>)), H5Tclose, "HDF5 type");
  checked(H5Tinsert(type, "r", 0, H5T_NATIVE_DOUBLE), "HDF5 type");
  checked(H5Tinsert(type, "i", sizeof(double), H5T_NATIVE_DOUBLE), "HDF5 type");
  return type;
}

std::string trimmed(const char* text, std::size_t length) {
  std::string out(text, length);
  out.resize(std::min(out.find('\0'), out.size()));
  out.erase(out.find_last_not_of(' ') + 1);
  return out;
}

} // namespace

struct Input::Source {
  std::string name;
  Handle object; ///< keeps the owner of an attribute open
  Handle id, type, space;
  std::vector<hsize_t> shape;
  bool is_attribute = false;

  herr_t read(hid_t memory_type, void* out) const {
    return is_attribute ? H5Aread(id, memory_type, out)
                        : H5Dread(id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
  }
};

Input::Input(const std::string& path) : path_(path) {
  std::error_code ignored; // what cannot be asked cannot be opened either
  if (!std::filesystem::exists(path, ignored))
    throw CaseError(path + ": no such file");
  if (H5Fis_hdf5(path.c_str()) <= 0)
    throw CaseError(path + ": not an HDF5 file");
  check_collections(path);
  file_ = checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                  path + ": cannot be opened");
}

void Input::refuse(const std::string& object, const std::string& message) const {
  throw CaseError({path_}, "", object + ": " + message);
}

bool Input::has_object(const std::string& object) const {
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    if (H5Lexists(file_, object.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
      return false;
    if (end == std::string::npos)
      return true;
  }
}

bool Input::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Input::members(const std::string& group) const {
  std::vector<std::string> names;
  if (!has_object(group))
    return names;
  const Handle id = checked(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose,
                            path_ + ": " + group + ": cannot be opened");
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names),
          path_ + ": " + group);
  return names;
}

Input::Source Input::open_dataset(const std::string& dataset) const {
  if (!has_object(dataset))
    refuse(dataset, "missing dataset");
  Source source;
  source.name = dataset;
  const std::string what = path_ + ": " + dataset + ": cannot be read";
  source.id = checked(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), H5Dclose, what);
  source.type = checked(H5Dget_type(source.id), H5Tclose, what);
  source.space = checked(H5Dget_space(source.id), H5Sclose, what);
  source.shape = shape_of(source.space);
  refuse_null(source);
  refuse_truncated(source);
  return source;
}

Input::Source Input::open_attribute(const std::string& object, const std::string& attribute) const {
  if (!has_attribute(object, attribute))
    refuse(object, "missing attribute " + in_quotes(attribute));
  Source source;
  source.name = object + ": attribute " + in_quotes(attribute);
  const std::string what = path_ + ": " + source.name + ": cannot be read";
  source.object = checked(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose, what);
  source.id = checked(H5Aopen(source.object, attribute.c_str(), H5P_DEFAULT), H5Aclose, what);
  source.type = checked(H5Aget_type(source.id), H5Tclose, what);
  source.space = checked(H5Aget_space(source.id), H5Sclose, what);
  source.shape = shape_of(source.space);
  refuse_null(source);
  source.is_attribute = true;
  return source;
}

/// HDF5 before 1.12 reads beyond what a damaged compact dataset keeps in its header.
void Input::refuse_truncated(const Source& source) const {
  const Handle creation =
      checked(H5Dget_create_plist(source.id), H5Pclose, path_ + ": " + source.name);
  if (H5Pget_layout(creation) == H5D_COMPACT &&
      H5Dget_storage_size(source.id) < size_of(source.shape) * H5Tget_size(source.type))
    refuse(source.name, "holds less data than its shape needs: the file is damaged");
}

/// A null dataspace looks like one number, and reads as nothing.
void Input::refuse_null(const Source& source) const {
  if (H5Sget_simple_extent_type(source.space) == H5S_NULL)
    refuse(source.name, "is empty (a null dataspace)");
}

void Input::require_shape(const Source& source, const std::vector<hsize_t>& shape) const {
  if (source.shape != shape)
    refuse(source.name,
           "expected shape " + shape_text(shape) + ", found " + shape_text(source.shape));
  double count = 1.0;
  for (hsize_t n : shape)
    count *= static_cast<double>(n);
  if (count > most_numbers)
    refuse(source.name, "expected at most " + number_text(most_numbers) + " numbers, found shape " +
                            shape_text(shape));
}

/// A list, whose length only the file knows.
void Input::require_list(const Source& source, hsize_t longest) const {
  if (source.shape.size() != 1)
    refuse(source.name, "expected a list, found shape " + shape_text(source.shape));
  if (source.shape[0] > longest)
    refuse(source.name, "expected a list of at most " + std::to_string(longest) + ", found " +
                            std::to_string(source.shape[0]));
}

std::vector<double> Input::numbers(const Source& source, const std::vector<hsize_t>& shape) const {
  require_shape(source, shape);
  const H5T_class_t kind = H5Tget_class(source.type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER && kind != H5T_ENUM) // h5py's bool is an enum
    refuse(source.name, "expected numbers, found another type");
  std::vector<double> out(size_of(source.shape));
  checked(source.read(H5T_NATIVE_DOUBLE, out.data()), path_ + ": " + source.name);
  return out;
}

std::vector<std::complex<double>> Input::complex_numbers(const Source& source) const {
  // HDF5 leaves out what a compound does not have, and says nothing.
  const auto has = [&](const char* part) {
    const int member = H5Tget_member_index(source.type, part);
    return member >= 0 &&
           H5Tget_member_class(source.type, static_cast<unsigned>(member)) == H5T_FLOAT;
  };
  if (H5Tget_class(source.type) != H5T_COMPOUND || !has("r") || !has("i"))
    refuse(source.name, "expected complex numbers (a compound of r and i), found another type");
  std::vector<std::complex<double>> out(size_of(source.shape));
  checked(source.read(complex_type(), out.data()), path_ + ": " + source.name);
  for (const std::complex<double>& x : out)
    if (!std::isfinite(x.real()) || !std::isfinite(x.imag()))
      refuse(source.name, "holds values that are not finite");
  return out;
}

std::vector<std::string> Input::strings(const Source& source) const {
  if (H5Tget_class(source.type) != H5T_STRING)
    refuse(source.name, "expected text, found another type");
  const std::size_t count = size_of(source.shape);
  std::vector<std::string> out;
  const std::string what = path_ + ": " + source.name;
  if (H5Tis_variable_str(source.type) > 0) {
    std::vector<char*> texts(count, nullptr);
    checked(source.read(source.type, texts.data()), what);
    for (const char* text : texts)
      out.emplace_back(text ? text : "");
    H5Dvlen_reclaim(source.type, source.space, H5P_DEFAULT, texts.data());
  } else {
    const std::size_t length = H5Tget_size(source.type);
    if (length > longest_text)
      refuse(source.name, "expected texts of at most " + std::to_string(longest_text) +
                              " characters, found " + std::to_string(length));
    std::vector<char> texts(count * length);
    checked(source.read(source.type, texts.data()), what);
    for (std::size_t i = 0; i < count; ++i)
      out.push_back(trimmed(texts.data() + i * length, length));
  }
  return out;
}

double Input::number(const std::string& object, const std::string& attribute) const {
  const Source source = open_attribute(object, attribute);
  return numbers(source, {})[0];
}

std::string Input::text(const std::string& object, const std::string& attribute) const {
  const Source source = open_attribute(object, attribute);
  require_shape(source, {});
  return strings(source)[0];
}

Vector3 Input::vector3(const std::string& object, const std::string& attribute) const {
  const Source source = open_attribute(object, attribute);
  const Vector3 out(numbers(source, {3}).data());
  if (!out.allFinite())
    refuse(source.name, "holds values that are not finite");
  return out;
}

std::vector<std::string> Input::labels(const std::string& dataset) const {
  const Source source = open_dataset(dataset);
  require_list(source, most_labels);
  return strings(source);
}

MatrixX Input::matrix(const std::string& dataset, std::size_t rows, std::size_t columns) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::vector<double> values = numbers(open_dataset(dataset), {rows, columns});
  MatrixX out = Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows),
                                           static_cast<Eigen::Index>(columns));
  if (!out.allFinite())
    refuse(dataset, "holds values that are not finite");
  return out;
}

std::vector<double> Input::list(const std::string& dataset) const {
  const Source source = open_dataset(dataset);
  require_list(source, longest_list);
  return finite_numbers(source, source.shape);
}

std::vector<double> Input::table(const std::string& dataset,
                                 const std::vector<std::size_t>& shape) const {
  return finite_numbers(open_dataset(dataset), {shape.begin(), shape.end()});
}

std::vector<double> Input::finite_numbers(const Source& source,
                                          const std::vector<hsize_t>& shape) const {
  std::vector<double> out = numbers(source, shape);
  if (!std::all_of(out.begin(), out.end(), [](double x) { return std::isfinite(x); }))
    refuse(source.name, "holds values that are not finite");
  return out;
}

std::vector<std::complex<double>>
Input::complex_table(const std::string& dataset, const std::vector<std::size_t>& shape) const {
  const Source source = open_dataset(dataset);
  require_shape(source, {shape.begin(), shape.end()});
  return complex_numbers(source);
}

Eigen::VectorXcd Input::complex_list(const std::string& dataset) const {
  const Source source = open_dataset(dataset);
  require_list(source, most_labels);
  const std::vector<std::complex<double>> values = complex_numbers(source);
  return Eigen::Map<const Eigen::VectorXcd>(values.data(),
                                            static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXcd Input::complex_matrix(const std::string& dataset, std::size_t rows,
                                       std::size_t columns) const {
  using RowMajor =
      Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Source source = open_dataset(dataset);
  require_shape(source, {rows, columns});
  const std::vector<std::complex<double>> values = complex_numbers(source);
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows),
                                    static_cast<Eigen::Index>(columns));
}

} // namespace hydrodae::io::hdf5
