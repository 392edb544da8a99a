#pragma once
/// Laws that stick and slip at places of their own: what their list answers beside being Elements.
/// Which places slip is in signals of the law that have no name; they change at located events.

#include <cstddef>

namespace hydrodae::element {

class Rubbing {
public:
  virtual ~Rubbing() = default;

  virtual bool may_rub() const { return true; }

  /// Do all places stick or slip as the signals say?
  /// @param in, signals  of this law, as in Elements::evaluate
  virtual bool agrees(std::size_t law, double t, const double* in, const double* signals) const = 0;

  /// Writes into the signals what sticks and what slips.
  /// @returns whether there is anything new
  virtual bool settle(std::size_t law, double t, const double* in, double* signals) const = 0;
};

} // namespace hydrodae::element
