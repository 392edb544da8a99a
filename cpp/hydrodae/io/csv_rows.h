#pragma once
/// Text files with commas whose first line names the columns: empty lines and those that begin with
/// # are passed over, a unit in brackets may follow a name.

#include <string>
#include <vector>

#include "hydrodae/core/error.h"

namespace hydrodae::io {

/// One cell: its text without blanks and quotes, and where it begins, from 1.
struct CsvCell {
  std::string text;
  int column = 1;
};

/// One line.
struct CsvRow {
  FilePlace place; ///< without column
  std::vector<CsvCell> cells;

  /// Cell k as a finite number; `name` calls it in messages. Throws CaseError with line and column.
  double number(std::size_t k, const std::string& name) const;
};

/// The lines of a file, that of the names first. Throws CaseError where it cannot be read.
std::vector<CsvRow> read_csv_rows(const std::string& path);

/// A name of a column without its unit: "omega" of "omega [rad/s]".
std::string csv_name(const std::string& text);

/// The unit in brackets, "" without: "rad/s" of "omega [rad/s]".
std::string csv_unit(const std::string& text);

} // namespace hydrodae::io
