#include "hydrodae/io/record_file.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::io {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::size_t from = 0;
  while (true) {
    const std::size_t comma = line.find(',', from);
    out.push_back(trimmed(line.substr(from, comma - from)));
    if (comma == std::string::npos)
      return out;
    from = comma + 1;
  }
}

/// Place of a column by its name without the unit.
std::size_t column(const FilePlace& where, const std::vector<std::string>& head,
                   const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < head.size(); ++k) {
    names.push_back(trimmed(head[k].substr(0, head[k].find('['))));
    if (names.back() == name)
      return k;
  }
  throw CaseError(where, "",
                  "expected the names of the columns, among them 'time' and 'elevation'; "
                  "there is no " +
                      in_quotes(name) + " (found: " + joined(names) + ")");
}

double number(const FilePlace& where, const std::vector<std::string>& row, std::size_t k,
              const std::string& name) {
  const std::string text = k < row.size() ? row[k] : "";
  double x = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x))
    throw CaseError(where, "", name + " must be a number, got " + in_quotes(text));
  return x;
}

} // namespace

void read_record(const std::string& path, std::vector<double>& time,
                 std::vector<double>& elevation) {
  std::ifstream file(path);
  if (!file)
    throw CaseError({path}, "", std::string("cannot read it: ") + std::strerror(errno));
  std::string line;
  int count = 0;
  std::size_t t = 0, eta = 0;
  bool named = false;
  while (std::getline(file, line)) {
    ++count;
    const FilePlace where{path, count};
    const std::string text = trimmed(line);
    if (text.empty() || text[0] == '#')
      continue;
    const std::vector<std::string> row = cells(line);
    if (!named) {
      t = column(where, row, "time");
      eta = column(where, row, "elevation");
      named = true;
      continue;
    }
    time.push_back(number(where, row, t, "time"));
    elevation.push_back(number(where, row, eta, "elevation"));
  }
  if (!named)
    throw CaseError({path}, "", "is empty; expected columns 'time' and 'elevation'");
}

} // namespace hydrodae::io
