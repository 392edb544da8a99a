#pragma once
/// Ropes and lines that part for good where their tension reaches what they bear: what their list
/// answers beside being Elements.

#include <cstddef>

namespace hydrodae::element {

/// Of one law: its largest tension over the breaking load there.
struct Overload {
  double ratio = 0.0; ///< [-]; 0: it does not part, or has done so
  int place = 0;      ///< part or segment that bears it, counted from 1 on
};

/// The last two signals of each law belong to the run: the place where it has parted, 0 while it is
/// whole, and the time [s].
class Parting {
public:
  virtual ~Parting() = default;

  static constexpr int n_signals = 2;

  virtual bool may_part() const { return true; }

  /// @param in, signals  of this law, as in Elements::evaluate
  virtual Overload overload(std::size_t law, double t, const double* in,
                            const double* signals) const = 0;
};

} // namespace hydrodae::element
