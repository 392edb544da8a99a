#include "hydrodae/cosim/fmu_units.h"

#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "hydrodae/core/text.h"

namespace hydrodae::cosim {

namespace {

using Powers = std::array<int, 7>;

/// Powers of kg, m, s, ...
const std::map<std::string, Powers> known = {
    {"1", {}},           {"-", {}},           {"rad", {}},        {"kg", {1}},
    {"m", {0, 1}},       {"s", {0, 0, 1}},    {"N", {1, 1, -2}},  {"J", {1, 2, -2}},
    {"W", {1, 2, -3}},   {"Pa", {1, -1, -2}}, {"Hz", {0, 0, -1}}, {"V", {1, 2, -3, -1}},
    {"A", {0, 0, 0, 1}},
};

/// Adds `sign` times the powers of "m3" or "N". @returns whether it is known
bool add(const std::string& factor, int sign, Powers& powers) {
  std::size_t end = factor.size();
  while (end > 1 && std::isdigit(static_cast<unsigned char>(factor[end - 1])))
    --end;
  const auto unit = known.find(factor.substr(0, end));
  if (unit == known.end() || factor.size() - end > 1)
    return false;
  const int times = end < factor.size() ? factor[end] - '0' : 1;
  for (std::size_t k = 0; k < powers.size(); ++k)
    powers[k] += sign * times * unit->second[k];
  return true;
}

} // namespace

std::string FmuUnit::text() const {
  std::string out;
  for (std::size_t k = 0; k < powers.size(); ++k)
    if (powers[k] != 0)
      out += (out.empty() ? "" : " ") + std::string(bases[k]) +
             (powers[k] == 1 ? "" : std::to_string(powers[k]));
  if (out.empty())
    out = "a number";
  if (factor != 1.0)
    out += " times " + number_text(factor);
  if (offset != 0.0)
    out += " plus " + number_text(offset);
  return out;
}

std::optional<FmuUnit> unit_of(const std::string& text) {
  FmuUnit out;
  const std::size_t slash = text.find('/');
  std::string below = slash == std::string::npos ? "" : text.substr(slash + 1);
  if (below.size() > 1 && below.front() == '(' && below.back() == ')')
    below = below.substr(1, below.size() - 2);
  std::string factor;
  for (std::istringstream words(text.substr(0, slash)); words >> factor;)
    if (!add(factor, 1, out.powers))
      return std::nullopt;
  for (std::istringstream words(below); words >> factor;)
    if (!add(factor, -1, out.powers))
      return std::nullopt;
  return out;
}

bool same_unit(const FmuUnit& a, const FmuUnit& b) {
  constexpr double rounding = 1e-9;
  return a.powers == b.powers && std::abs(a.factor - b.factor) <= rounding * std::abs(b.factor) &&
         a.offset == b.offset;
}

} // namespace hydrodae::cosim
