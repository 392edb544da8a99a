#pragma once
/// Results files for reading: what `Results` of Python is made of.

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hydrodae/io/hdf5.h"

namespace hydrodae::io {

/// One open results file. It may be damaged, or written by another program: every function throws
/// CaseError where the contents are not what it reads. Sizes are checked before memory is asked
/// for.
class ResultsReader {
public:
  using Value = std::variant<double, std::int64_t, std::string, std::vector<double>>;
  using Shape = std::vector<hsize_t>;

  /// Opens the file.
  /// @param search  whether to look first for texts that the HDF5 library would read for ever
  ResultsReader(const std::string& path, bool search);

  /// Nothing can be read after it.
  void close() { file_.reset(); }

  /// Paths of all datasets, in the order of their names. They may be no UTF-8.
  std::vector<std::string> datasets() const;

  bool has(const std::string& member) const; ///< of the root group

  /// Attributes of a group or dataset by name, "/" for those of the file; without references.
  std::vector<std::pair<std::string, Value>> attributes(const std::string& object) const;

  Shape shape(const std::string& dataset) const;

  /// Shape of the first `rows` rows of a dataset of real numbers, as `read` gives them.
  Shape shape_of_rows(const std::string& dataset, hsize_t rows) const;

  /// The numbers themselves, row by row.
  void read(const std::string& dataset, const Shape& rows, double* out) const;

private:
  hdf5::Handle open(const std::string& dataset) const;
  Value value_of(hid_t attribute, const std::string& what) const;
  std::string text_of(hid_t attribute, hid_t type, const std::string& what) const;
  void require_held(double bytes, const std::string& what) const;

  hdf5::Quiet quiet_;
  double size_ = 0.0; ///< of the file in bytes
  hdf5::Handle file_;
};

} // namespace hydrodae::io
