#include "hydrodae/io/record_file.h"

#include "hydrodae/core/text.h"
#include "hydrodae/io/csv_rows.h"

namespace hydrodae::io {
namespace {

/// Place of a column by its name without the unit.
std::size_t record_column(const CsvRow& head, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < head.cells.size(); ++k) {
    names.push_back(csv_name(head.cells[k].text));
    if (names.back() == name)
      return k;
  }
  throw CaseError(head.place, "",
                  "expected the names of the columns, among them 'time' and 'elevation'; "
                  "there is no " +
                      in_quotes(name) + " (found: " + joined(names) + ")");
}

} // namespace

void read_record(const std::string& path, std::vector<double>& time,
                 std::vector<double>& elevation) {
  const std::vector<CsvRow> rows = read_csv_rows(path);
  if (rows.empty())
    throw CaseError({path}, "", "is empty; expected columns 'time' and 'elevation'");
  const std::size_t t = record_column(rows.front(), "time"),
                    eta = record_column(rows.front(), "elevation");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    time.push_back(rows[i].number(t, "time"));
    elevation.push_back(rows[i].number(eta, "elevation"));
  }
}

} // namespace hydrodae::io
