#include "hydrodae/io/results_reader.h"

#include <algorithm>

#include "hydrodae/io/hdf5.h"

namespace hydrodae::io {
namespace {

using hdf5::checked;
using hdf5::Handle;

ResultsReader::Shape shape_in(hid_t space, const std::string& what) {
  const int rank = checked(H5Sget_simple_extent_ndims(space), what);
  ResultsReader::Shape shape(static_cast<std::size_t>(rank));
  if (rank > 0)
    checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr), what);
  return shape;
}

double count_in(const ResultsReader::Shape& shape) {
  double count = 1.0;
  for (const hsize_t n : shape)
    count *= static_cast<double>(n);
  return count;
}

bool holds_numbers(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_FLOAT || kind == H5T_INTEGER;
}

std::string text_of(hid_t attribute, hid_t type, const std::string& what) {
  if (checked(H5Tis_variable_str(type), what) > 0) {
    const Handle memory = checked(H5Tcopy(type), H5Tclose, what);
    char* text = nullptr;
    checked(H5Aread(attribute, memory, &text), what);
    const std::string out = text ? text : "";
    H5free_memory(text);
    return out;
  }
  std::string out(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, out.data()), what);
  out.resize(std::min(out.find('\0'), out.size()));
  return out;
}

} // namespace

struct ResultsReader::Impl {
  hdf5::Quiet quiet;
  Handle file;

  Handle open(const std::string& dataset) const {
    return checked(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset);
  }
  Value value_of(hid_t attribute, const std::string& what) const;
};

ResultsReader::ResultsReader(const std::string& path) : impl_(std::make_unique<Impl>()) {
  impl_->file =
      checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "cannot be opened");
}

ResultsReader::~ResultsReader() = default;

void ResultsReader::close() { impl_->file.reset(); }

std::vector<std::string> ResultsReader::datasets() const {
  std::vector<std::string> names;
  // HDF5 1.12 has given another name to the type of `object`.
  const auto note = [](hid_t, const char* name, const auto* object, void* out) -> herr_t {
    if (object->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  checked(H5Ovisit2(impl_->file, H5_INDEX_NAME, H5_ITER_INC, note, &names, H5O_INFO_BASIC),
          "its names cannot be read");
  return names;
}

bool ResultsReader::has(const std::string& member) const {
  return H5Lexists(impl_->file, member.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::pair<std::string, ResultsReader::Value>>
ResultsReader::attributes(const std::string& object) const {
  const std::string what = object + ": attributes cannot be read";
  const Handle owner = checked(H5Oopen(impl_->file, object.c_str(), H5P_DEFAULT), H5Oclose, what);
  std::vector<std::string> names;
  const auto note = [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  checked(H5Aiterate2(owner, H5_INDEX_NAME, H5_ITER_INC, nullptr, note, &names), what);
  std::vector<std::pair<std::string, Value>> out;
  for (const std::string& name : names) {
    if (name == "DIMENSION_LIST" || name == "REFERENCE_LIST") // references to dimension scales
      continue;
    const std::string which = "attribute " + name;
    const Handle attribute = checked(H5Aopen(owner, name.c_str(), H5P_DEFAULT), H5Aclose, which);
    out.emplace_back(name, impl_->value_of(attribute, which));
  }
  return out;
}

ResultsReader::Value ResultsReader::Impl::value_of(hid_t attribute, const std::string& what) const {
  const Handle type = checked(H5Aget_type(attribute), H5Tclose, what);
  const Handle space = checked(H5Aget_space(attribute), H5Sclose, what);
  const Shape shape = shape_in(space, what);
  const H5T_class_t kind = H5Tget_class(type);
  const bool single = shape.empty();
  if (kind == H5T_STRING && single)
    return text_of(attribute, type, what);
  if (single && (kind == H5T_INTEGER || kind == H5T_ENUM)) { // h5py's bool is an enum
    std::int64_t number = 0;
    checked(H5Aread(attribute, H5T_NATIVE_INT64, &number), what);
    return number;
  }
  if (!holds_numbers(type))
    throw CaseError(what + ": expected a text or real numbers, found another type");
  std::vector<double> numbers(static_cast<std::size_t>(count_in(shape)));
  if (!numbers.empty())
    checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, numbers.data()), what);
  if (single)
    return numbers.front();
  return numbers;
}

ResultsReader::Shape ResultsReader::shape(const std::string& dataset) const {
  const Handle id = impl_->open(dataset);
  return shape_in(checked(H5Dget_space(id), H5Sclose, dataset), dataset);
}

ResultsReader::Shape ResultsReader::shape_of_rows(const std::string& dataset,
                                                  unsigned long long rows) const {
  const Handle id = impl_->open(dataset);
  const Handle type = checked(H5Dget_type(id), H5Tclose, dataset);
  if (!holds_numbers(type))
    throw CaseError("expected numbers, found another type");
  Shape found = shape_in(checked(H5Dget_space(id), H5Sclose, dataset), dataset);
  if (!found.empty())
    found.front() = std::min(found.front(), rows);
  return found;
}

void ResultsReader::read(const std::string& dataset, const Shape& rows, double* out) const {
  const Handle id = impl_->open(dataset);
  const Handle source = checked(H5Dget_space(id), H5Sclose, dataset);
  if (count_in(rows) == 0.0)
    return;
  if (rows.empty()) {
    checked(H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out), dataset);
    return;
  }
  const Shape start(rows.size(), 0);
  checked(H5Sselect_hyperslab(source, H5S_SELECT_SET, start.data(), nullptr, rows.data(), nullptr),
          dataset);
  const Handle target = checked(
      H5Screate_simple(static_cast<int>(rows.size()), rows.data(), nullptr), H5Sclose, dataset);
  checked(H5Dread(id, H5T_NATIVE_DOUBLE, target, source, H5P_DEFAULT, out), dataset);
}

} // namespace hydrodae::io
