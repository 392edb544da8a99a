#pragma once
/// Results files for reading, right after their run: what `Results` of Python is made of.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hydrodae::io {

/// One open results file, which this process has written: damaged ones need newer versions of the
/// HDF5 library. Every function throws CaseError where it cannot be read.
class ResultsReader {
public:
  using Value = std::variant<double, std::int64_t, std::string, std::vector<double>>;
  using Shape = std::vector<unsigned long long>;

  explicit ResultsReader(const std::string& path);
  ~ResultsReader();
  ResultsReader(const ResultsReader&) = delete;
  ResultsReader& operator=(const ResultsReader&) = delete;

  /// Nothing can be read after it.
  void close();

  /// Paths of all datasets, in the order of their names.
  std::vector<std::string> datasets() const;

  bool has(const std::string& member) const; ///< true if the root group has this member

  /// Attributes of a group or dataset by name, "/" for those of the file; without references.
  std::vector<std::pair<std::string, Value>> attributes(const std::string& object) const;

  Shape shape(const std::string& dataset) const;

  /// Shape of the first `rows` rows of a dataset of real numbers, as `read` gives them.
  Shape shape_of_rows(const std::string& dataset, unsigned long long rows) const;

  /// Reads the numbers, row by row.
  void read(const std::string& dataset, const Shape& rows, double* out) const;

private:
  struct Impl; ///< keeps hdf5.h out of what includes this header
  std::unique_ptr<Impl> impl_;
};

} // namespace hydrodae::io
