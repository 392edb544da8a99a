#pragma once
/// Units as FMUs tell them: powers of base units, a factor and an offset.

#include <array>
#include <optional>
#include <string>

namespace hydrodae::cosim {

/// SI value = factor * value + offset. Radians count as numbers: tools differ over them.
struct FmuUnit {
  static constexpr std::array<const char*, 7> bases = {"kg", "m", "s", "A", "K", "mol", "cd"};
  std::array<int, 7> powers{};
  double factor = 1.0, offset = 0.0;

  /// "kg m-1 s-2 times 100000".
  std::string text() const;
};

/// Of a channel, "N m s/rad"; nothing where it is not fixed, "N (s/m)^n".
std::optional<FmuUnit> unit_of(const std::string& text);

/// Are numbers in one the same in the other?
bool same_unit(const FmuUnit& a, const FmuUnit& b);

} // namespace hydrodae::cosim
