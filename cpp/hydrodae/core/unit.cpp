#include "hydrodae/core/unit.h"

#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "hydrodae/core/text.h"

namespace hydrodae {

namespace {

constexpr double radians_of_degree = std::numbers::pi / 180.0;

/// Units with the powers of kg, m, s, ... and the factor to SI.
const std::map<std::string, Unit>& known_units() {
  static const std::map<std::string, Unit> units = {
      {"1", {}},
      {"-", {}},
      {"%", {{}, 0.01}},
      {"rad", {}},
      {"deg", {{}, radians_of_degree}},
      {"rev", {{}, 2.0 * std::numbers::pi}},
      {"rpm", {{0, 0, -1}, std::numbers::pi / 30.0}},
      {"kg", {{1}}},
      {"t", {{1}, 1000.0}},
      {"m", {{0, 1}}},
      {"s", {{0, 0, 1}}},
      {"min", {{0, 0, 1}, 60.0}},
      {"h", {{0, 0, 1}, 3600.0}},
      {"l", {{0, 3}, 1e-3}},
      {"N", {{1, 1, -2}}},
      {"J", {{1, 2, -2}}},
      {"Wh", {{1, 2, -2}, 3600.0}},
      {"W", {{1, 2, -3}}},
      {"Pa", {{1, -1, -2}}},
      {"bar", {{1, -1, -2}, 1e5}},
      {"V", {{1, 2, -3, -1}}},
      {"A", {{0, 0, 0, 1}}},
      {"K", {{0, 0, 0, 0, 1}}},
  };
  return units;
}

/// Unit of a symbol such as "mm", "kN", "MW", "mbar"; g only here, because kg is the base unit.
std::optional<Unit> symbol_of(const std::string& symbol) {
  const auto& units = known_units();
  if (const auto found = units.find(symbol); found != units.end())
    return found->second;
  static const std::map<char, double> prefixes = {
      {'n', 1e-9}, {'u', 1e-6}, {'m', 1e-3}, {'c', 1e-2}, {'k', 1e3}, {'M', 1e6}, {'G', 1e9}};
  static const std::string with_prefix = " m s N J W Wh Pa bar V A rad ";
  if (symbol == "g")
    return Unit{{1}, 1e-3};
  const auto prefix = symbol.empty() ? prefixes.end() : prefixes.find(symbol.front());
  if (prefix == prefixes.end() ||
      with_prefix.find(" " + symbol.substr(1) + " ") == std::string::npos)
    return std::nullopt;
  Unit out = units.at(symbol.substr(1));
  out.factor *= prefix->second;
  return out;
}

/// Parser of products with powers, "kN m2", "N*m", "kg.m2.s-2", and at most one slash: everything
/// after it is in the denominator, with or without parentheses.
class UnitText {
public:
  explicit UnitText(const std::string& text) : text_(text) {}

  std::optional<Unit> read() {
    Unit out;
    if (!product(out, 1) || at_ != text_.size())
      return std::nullopt;
    return out;
  }

private:
  bool ends() {
    while (at_ < text_.size() && text_[at_] == ' ')
      ++at_;
    return at_ == text_.size() || text_[at_] == ')';
  }

  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c)
      return false;
    ++at_;
    return true;
  }

  /// @param sign  1 before a slash, -1 after it
  bool product(Unit& out, int sign) {
    bool divided = false;
    for (bool first = true; !ends(); first = false) {
      if (!first && take('/')) {
        if (divided)
          return false;
        divided = true;
        sign = -sign;
      } else if (!first) {
        take('*') || take('.');
      }
      if (ends() || !part(out, sign))
        return false;
    }
    return true;
  }

  bool part(Unit& out, int sign) {
    if (take('('))
      return product(out, sign) && take(')') && (ends() || text_[at_] != '^');
    const std::size_t from = at_;
    if (take('1') || take('-') || take('%'))
      ;
    else
      while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])))
        ++at_;
    const std::optional<Unit> unit = symbol_of(text_.substr(from, at_ - from));
    const int times = power();
    if (!unit || times == 0)
      return false;
    for (std::size_t k = 0; k < out.powers.size(); ++k)
      out.powers[k] += sign * times * unit->powers[k];
    out.factor *= std::pow(unit->factor, sign * times);
    return true;
  }

  /// Power of one digit after a symbol, "m3", "s-1", "m^2"; 0 for anything else.
  int power() {
    const bool told = take('^'), minus = take('-');
    if (at_ >= text_.size() || !std::isdigit(static_cast<unsigned char>(text_[at_])))
      return told || minus ? 0 : 1;
    const int digit = text_[at_++] - '0';
    if (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])))
      return 0;
    return minus ? -digit : digit;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

} // namespace

std::string Unit::text() const {
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

std::optional<Unit> unit_of(const std::string& text) {
  return text.empty() ? std::nullopt : UnitText(text).read();
}

std::optional<Conversion> conversion(const Unit& from, const Unit& to) {
  if (from.powers != to.powers)
    return std::nullopt;
  constexpr double rounding = 1e-12;
  Conversion out{from.factor / to.factor, (from.offset - to.offset) / to.factor};
  if (std::abs(out.factor - 1.0) <= rounding)
    out.factor = 1.0;
  return out;
}

SignalName signal_of(std::string_view text) {
  const std::size_t open = text.find('[');
  if (open == std::string_view::npos || text.back() != ']')
    return {std::string(text), std::nullopt};
  const std::size_t last =
      open == 0 ? std::string_view::npos : text.find_last_not_of(' ', open - 1);
  return {std::string(text.substr(0, last == std::string_view::npos ? 0 : last + 1)),
          std::string(text.substr(open + 1, text.size() - open - 2))};
}

std::string equation(const std::string& unit, const std::string& other, const Conversion& to) {
  if (to.offset == 0.0)
    return "1 " + unit + " = " + number_text(to.factor) + " " + other;
  return "x " + unit + " = (" + number_text(to.factor) + " x + " + number_text(to.offset) + ") " +
         other;
}

} // namespace hydrodae
