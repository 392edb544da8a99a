#pragma once
/// Units of signals as powers of base units, a factor and an offset.

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace hydrodae {

/// Unit with SI value = factor * value + offset. Radians count as numbers, because tools differ.
struct Unit {
  static constexpr std::array<const char*, 7> bases = {"kg", "m", "s", "A", "K", "mol", "cd"};
  std::array<int, 7> powers{};
  double factor = 1.0, offset = 0.0;

  /// Text "kg m-1 s-2 times 100000".
  std::string text() const;
};

/// Unit of "N m s/rad", "m3/(s Pa)", "kN", "deg/s", "rpm", "bar", "kN.m"; nothing for variable ("N
/// (s/m)^n") or unknown units. Everything after a slash is in the denominator.
std::optional<Unit> unit_of(const std::string& text);

/// Conversion of a value to another unit: factor * value + offset.
struct Conversion {
  double factor = 1.0, offset = 0.0;

  bool is_none() const { return factor == 1.0 && offset == 0.0; }
  double of(double value) const { return is_none() ? value : factor * value + offset; }
  double back(double value) const { return is_none() ? value : (value - offset) / factor; }
};

/// Conversion between two units; nothing for different quantities. Factors that differ only by
/// rounding, as in files, are equal.
std::optional<Conversion> conversion(const Unit& from, const Unit& to);

/// Name with the unit given in a case, "joints/hinge/angle [deg]".
struct SignalName {
  std::string name;
  std::optional<std::string> unit;
};
SignalName signal_of(std::string_view text);

/// Text "1 kN = 1000 N"; with an offset "x degC = (1 x + 273.15) K".
std::string equation(const std::string& unit, const std::string& other, const Conversion& to);

} // namespace hydrodae
