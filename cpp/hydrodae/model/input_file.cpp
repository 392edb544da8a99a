#include "hydrodae/model/input_file.h"

#include <algorithm>
#include <sstream>

namespace hydrodae::model {

namespace {

/// Column of the label in a line, after the digest and a space
constexpr std::size_t label_at = 65;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    out.push_back(line);
  return out;
}

/// First line of `lines` that is missing in `others`; empty: none.
std::string first_missing(const std::vector<std::string>& lines,
                          const std::vector<std::string>& others) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return std::find(others.begin(), others.end(), line) == others.end();
  });
  return found == lines.end() ? "" : found->substr(std::min(label_at, found->size()));
}

} // namespace

std::string text_of_files(const std::vector<InputFile>& files) {
  std::string out;
  for (const InputFile& file : files)
    out += file.sha256 + " " + file.key + " = " + file.name + "\n";
  return out;
}

std::string changed_file(const std::string& before, const std::string& now) {
  const std::vector<std::string> old_lines = lines_of(before), new_lines = lines_of(now);
  if (const std::string changed = first_missing(new_lines, old_lines); !changed.empty())
    return changed + " has changed since";
  if (const std::string left_out = first_missing(old_lines, new_lines); !left_out.empty())
    return left_out + " is missing now";
  return before == now ? "" : "the files that the case reads have another order now";
}

} // namespace hydrodae::model
