#include "hydrodae/io/csv_rows.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "hydrodae/core/text.h"

namespace hydrodae::io {
namespace {

constexpr const char* csv_blanks = " \t\r\"";

std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(csv_blanks), last = text.find_last_not_of(csv_blanks);
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<CsvCell> cells_of(const std::string& line) {
  std::vector<CsvCell> out;
  std::size_t from = 0;
  while (true) {
    const std::size_t comma = line.find(',', from), begin = line.find_first_not_of(" \t\"", from);
    const std::size_t column = begin < comma ? begin : from;
    out.push_back({without_blanks(line.substr(from, comma - from)), static_cast<int>(column) + 1});
    if (comma == std::string::npos)
      return out;
    from = comma + 1;
  }
}

} // namespace

double CsvRow::number(std::size_t k, const std::string& name) const {
  FilePlace where = place;
  const std::string text = k < cells.size() ? cells[k].text : "";
  if (k < cells.size())
    where.column = cells[k].column;
  double x = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x))
    throw CaseError(where, "", name + " must be a number, got " + in_quotes(text));
  return x;
}

std::vector<CsvRow> read_csv_rows(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw CaseError({path}, "", std::string("cannot read it: ") + std::strerror(errno));
  std::vector<CsvRow> out;
  std::string line;
  for (int count = 1; std::getline(file, line); ++count) {
    const std::string text = without_blanks(line);
    if (!text.empty() && text[0] != '#')
      out.push_back({{path, count}, cells_of(line)});
  }
  return out;
}

std::string csv_name(const std::string& text) {
  return without_blanks(text.substr(0, text.find('[')));
}

std::string csv_unit(const std::string& text) {
  const std::size_t open = text.find('['), close = text.find(']', open);
  return open == std::string::npos || close == std::string::npos
             ? ""
             : without_blanks(text.substr(open + 1, close - open - 1));
}

} // namespace hydrodae::io
