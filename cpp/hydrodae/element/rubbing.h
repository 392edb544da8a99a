#pragma once
/// Laws that stick and slip at places of their own: what their list answers beside being Elements.
/// Which places slip is in signals of the law that have no name; they change at located events.

#include <cstddef>

namespace hydrodae::element {

class Rubbing {
public:
  virtual ~Rubbing() = default;

  virtual bool may_rub() const { return true; }

  /// Numbers of `rubs` of each law.
  virtual int n_rubs() const = 0;

  /// How far each place is from doing else than the signals say; at zero it changes, below it
  /// should have.
  /// @param in, signals  of this law, as in Elements::evaluate
  /// @param out  (n_rubs,)
  virtual void rubs(std::size_t law, double t, const double* in, const double* signals,
                    double* out) const = 0;

  /// Writes into the signals what sticks and what slips.
  /// @returns whether there is anything new
  virtual bool settle(std::size_t law, double t, const double* in, double* signals) const = 0;
};

} // namespace hydrodae::element
