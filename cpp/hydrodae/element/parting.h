#pragma once
/// Ropes and lines that part permanently when their tension reaches the breaking load.

#include <cstddef>

namespace hydrodae::element {

/// Largest ratio of tension to breaking load along one law.
struct Overload {
  double ratio = 0.0; ///< ratio [-]; 0: the law cannot part, or has parted
  int place = 0;      ///< number of the part or segment, from 1 on
};

/// List of laws that can part. The run writes the last two signals of each law: the place where it
/// has parted (0: whole), and the time [s].
class Parting {
public:
  virtual ~Parting() = default;

  static constexpr int n_signals = 2;

  virtual bool may_part() const { return true; }

  /// @param in, signals  values of this law, as in Elements::evaluate
  virtual Overload overload(std::size_t law, double t, const double* in,
                            const double* signals) const = 0;
};

} // namespace hydrodae::element
