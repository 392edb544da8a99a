#pragma once
/// Laws with places that stick and slip. Unnamed signals of the law state which places slip; they
/// change at located events.

#include <cstddef>

namespace hydrodae::element {

class Rubbing {
public:
  virtual ~Rubbing() = default;

  virtual bool may_rub() const { return true; }

  /// Number of values in `rubs` for each law.
  virtual int n_rubs() const = 0;

  /// Margins of each place to its next change of state: zero at the change, negative after it.
  /// @param in, signals  values of this law, as in Elements::evaluate
  /// @param out  (n_rubs,)
  virtual void rubs(std::size_t law, double t, const double* in, const double* signals,
                    double* out) const = 0;

  /// Writes into the signals which places stick and which slip.
  /// @returns whether any signal has changed
  virtual bool settle(std::size_t law, double t, const double* in, double* signals) const = 0;
};

} // namespace hydrodae::element
