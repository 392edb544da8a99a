#pragma once
/// Reading HDF5: every function throws CaseError with the file, the object and what was expected.

#include <complex>
#include <string>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/io/hdf5.h"

namespace hydrodae::io::hdf5 {

class Input {
public:
  /// Opens for reading. Throws when the file is missing or not HDF5.
  explicit Input(const std::string& path);

  bool has_object(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;

  /// Names of the members of a group, sorted; none if there is no such group.
  std::vector<std::string> members(const std::string& group) const;

  double number(const std::string& object, const std::string& attribute) const;
  std::string text(const std::string& object, const std::string& attribute) const;
  Vector3 vector3(const std::string& object, const std::string& attribute) const;

  /// Datasets; a matrix must have the given shape, a list may have any length.
  std::vector<std::string> labels(const std::string& dataset) const;
  MatrixX matrix(const std::string& dataset, std::size_t rows, std::size_t columns) const;
  Eigen::VectorXcd complex_list(const std::string& dataset) const;
  Eigen::MatrixXcd complex_matrix(const std::string& dataset, std::size_t rows,
                                  std::size_t columns) const;

  std::vector<double> list(const std::string& dataset) const;
  std::vector<double> table(const std::string& dataset,
                            const std::vector<std::size_t>& shape) const; ///< row by row
  std::vector<std::complex<double>> complex_table(const std::string& dataset,
                                                  const std::vector<std::size_t>& shape) const;

  /// Throws CaseError "<file>: <object>: <message>".
  [[noreturn]] void refuse(const std::string& object, const std::string& message) const;

private:
  struct Source; ///< a dataset or an attribute
  Source open_dataset(const std::string& dataset) const;
  Source open_attribute(const std::string& object, const std::string& attribute) const;
  std::vector<double> numbers(const Source& source, const std::vector<hsize_t>& shape) const;
  std::vector<double> finite_numbers(const Source& source, const std::vector<hsize_t>& shape) const;
  std::vector<std::complex<double>> complex_numbers(const Source& source) const;
  std::vector<std::string> strings(const Source& source) const;
  // All sizes are checked before memory is asked for.
  void refuse_null(const Source& source) const;
  void refuse_truncated(const Source& source) const;
  void require_shape(const Source& source, const std::vector<hsize_t>& shape) const;
  void require_list(const Source& source, hsize_t longest) const;

  Quiet quiet_;
  std::string path_;
  Handle file_;
};

} // namespace hydrodae::io::hdf5
