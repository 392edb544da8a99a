#include "hydrodae/io/component_table.h"

#include "hydrodae/core/text.h"
#include "hydrodae/core/types.h"
#include "hydrodae/io/csv_rows.h"

namespace hydrodae::io {
namespace {

constexpr std::size_t no_column = static_cast<std::size_t>(-1);

/// Place of a column whose unit is the one expected; `no_column` without such a name.
std::size_t column_of(const CsvRow& head, const std::string& name, const std::string& unit) {
  std::size_t found = no_column;
  for (std::size_t k = 0; k < head.cells.size(); ++k) {
    const std::string& text = head.cells[k].text;
    if (csv_name(text) != name)
      continue;
    const FilePlace where{head.place.file, head.place.line, head.cells[k].column};
    if (found != no_column)
      throw CaseError(where, "", "the column " + in_quotes(name) + " is there twice");
    if (text.find('[') != std::string::npos && csv_unit(text) != unit)
      throw CaseError(where, "", "expected " + name + " [" + unit + "], got " + in_quotes(text));
    found = k;
  }
  return found;
}

std::size_t needed_column(const CsvRow& head, const std::string& name, const std::string& unit) {
  const std::size_t k = column_of(head, name, unit);
  if (k != no_column)
    return k;
  std::vector<std::string> names;
  for (const CsvCell& cell : head.cells)
    names.push_back(csv_name(cell.text));
  throw CaseError(head.place, "",
                  "expected the names of the columns 'omega [rad/s]', 'amplitude [m]', 'phase "
                  "[rad]' and, if they differ, 'heading [deg]'; there is no " +
                      in_quotes(name) + " (found: " + joined(names) + ")");
}

/// A number that must not be below `least`, or not be `least` itself.
double bounded(const CsvRow& row, std::size_t k, const std::string& name, const std::string& unit,
               bool zero) {
  const double x = row.number(k, name);
  if (x < 0.0 || (!zero && x == 0.0))
    throw CaseError({row.place.file, row.place.line, row.cells[k].column}, "",
                    name + " must be " + (zero ? ">= 0 " : "> 0 ") + unit + ", got " +
                        number_text(x) + " " + unit);
  return x;
}

} // namespace

void read_component_table(const std::string& path, sea::ComponentFile& wave) {
  const std::vector<CsvRow> rows = read_csv_rows(path);
  if (rows.size() < 2)
    throw CaseError({path}, "",
                    std::string(rows.empty() ? "is empty" : "has no component") +
                        "; expected a line 'omega [rad/s],amplitude [m],phase [rad],heading "
                        "[deg]', then one line a component");
  const CsvRow& head = rows.front();
  const std::size_t omega = needed_column(head, "omega", "rad/s"),
                    amplitude = needed_column(head, "amplitude", "m"),
                    phase = needed_column(head, "phase", "rad"),
                    heading = column_of(head, "heading", "deg");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const CsvRow& row = rows[i];
    wave.omega.push_back(bounded(row, omega, "omega", "rad/s", false));
    wave.amplitude.push_back(bounded(row, amplitude, "amplitude", "m", true));
    wave.phase.push_back(row.number(phase, "phase"));
    if (heading != no_column)
      wave.headings.push_back(row.number(heading, "heading") * pi / 180.0);
  }
}

} // namespace hydrodae::io
