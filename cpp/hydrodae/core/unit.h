#pragma once
/// Units of signals as powers of base units, a factor and an offset.

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace hydrodae {

/// SI value = factor * value + offset. Radians count as numbers: tools differ over them.
struct Unit {
  static constexpr std::array<const char*, 7> bases = {"kg", "m", "s", "A", "K", "mol", "cd"};
  std::array<int, 7> powers{};
  double factor = 1.0, offset = 0.0;

  /// "kg m-1 s-2 times 100000".
  std::string text() const;
};

/// Of "N m s/rad", "m3/(s Pa)", "kN", "deg/s", "rpm", "bar", "kN.m"; nothing where it is not fixed,
/// "N (s/m)^n", or not known. All behind a slash is below it.
std::optional<Unit> unit_of(const std::string& text);

/// A number of one unit in another one: factor * value + offset.
struct Conversion {
  double factor = 1.0, offset = 0.0;

  bool is_none() const { return factor == 1.0 && offset == 0.0; }
  double of(double value) const { return is_none() ? value : factor * value + offset; }
  double back(double value) const { return is_none() ? value : (value - offset) / factor; }
};

/// Nothing where these are units of different things. Factors that differ by rounding only, as
/// those of a file do, are one.
std::optional<Conversion> conversion(const Unit& from, const Unit& to);

/// A name with the unit that a case gives it, "joints/hinge/angle [deg]".
struct SignalName {
  std::string name;
  std::optional<std::string> unit;
};
SignalName signal_of(std::string_view text);

/// "1 kN = 1000 N"; with an offset "x degC = (1 x + 273.15) K".
std::string equation(const std::string& unit, const std::string& other, const Conversion& to);

} // namespace hydrodae
