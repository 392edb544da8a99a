#include "hydrodae/core/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

namespace hydrodae {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Words of other codes, and the name for each here.
constexpr std::pair<std::string_view, std::string_view> words_of_others[] = {
    {"irregular", "jonswap"},
    {"js", "jonswap"},
    {"pm", "pierson_moskowitz"},
    {"issc", "bretschneider"},
    {"spectrumimport", "table"},
    {"elevationimport", "measured"},
    {"airy", "regular"},
    {"regularcic", "regular"},
    {"hinge", "revolute"},
    {"slider", "prismatic"},
    {"translational", "prismatic"},
    {"rotational", "revolute"},
    {"ball", "spherical"},
    {"hardstop", "end_stop"},
    {"statespace", "exponential"},
    {"state_space", "exponential"},
};

/// Number of edits (insert, delete, replace, swap neighbours) that turn a into b; optimal string
/// alignment.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size() + 1;
  std::vector<std::size_t> before(n), last(n), row(n);
  for (std::size_t j = 0; j < n; ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j < n; ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[n - 1];
}

} // namespace

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value + 0.0); // avoids "-0"
  return text;
}

std::string rounded_text(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value))
    return number_text(value);
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1.0 - digits);
  return number_text(std::round(value / unit) * unit);
}

std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names) {
  for (const auto& [word, name] : words_of_others)
    if (lower(wanted) == word && std::find(names.begin(), names.end(), name) != names.end())
      return std::string(name);
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, (wanted.size() + 1) / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(lower(wanted), lower(name));
    if (distance < best_distance && distance < name.size()) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view wanted, const std::vector<std::string>& names,
                       const std::vector<std::string>& taken) {
  if (names.empty())
    return "; the list is empty";
  std::vector<std::string> free;
  std::copy_if(names.begin(), names.end(), std::back_inserter(free), [&](const std::string& name) {
    return std::find(taken.begin(), taken.end(), name) == taken.end();
  });
  const std::string near = nearest_name(wanted, free);
  return (near.empty() ? "" : "; did you mean " + in_quotes(near) + "?") +
         std::string(near.empty() ? "; " : " (") + "valid: " + joined(names) +
         (near.empty() ? "" : ")");
}

} // namespace hydrodae
