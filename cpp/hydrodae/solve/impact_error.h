#pragma once
/// What an impact makes of a small error of the motion: who arrives later strikes later, at another
/// speed, and rebounds from there (the saltation matrix: Mueller, Chaos, Solitons & Fractals 5
/// (1995) 1671; Leine and Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
/// 2004, ch. 7).

#include "hydrodae/solve/switching.h"

namespace hydrodae::solve {

class ImpactError {
public:
  /// @param which the switch that was struck
  /// @param y0, yp0; y1, yp1 before and after the impact at t; of the latter's layout is the regime
  ImpactError(const system::Regime& system, Switching& switching, std::size_t which, double t,
              const VectorX& y0, const VectorX& yp0, const VectorX& y1, const VectorX& yp1);

  /// Carries a change of q, u, z (lambda0,) from before to after the impact.
  /// @param unit what counts as one of each (lambda0,)
  void operator()(VectorX& change, const VectorX& unit) const;

private:
  const system::Regime& s_;
  Switching& switching_;
  std::size_t which_;
  double t_;
  Switching::Motion struck_; ///< of its coordinate before the impact
  VectorX y0_, yp0_;         ///< in the layout of y1 (n,)
  VectorX jump_, slip_;      ///< y1 - y0, yp0 - yp1 in q, u, z (lambda0,)
};

} // namespace hydrodae::solve
