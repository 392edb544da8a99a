#pragma once
#include <memory>
#include <optional>

#include "hydrodae/system/jacobian.h"

namespace hydrodae::statics {

/// Completes the start: y (positions, velocities, memory given) gets its multipliers and y' all its
/// rates from one solve of the saddle-point system
///
///   [ M  -G^T ] [ u'     ]   [ f               ]
///   [ G   0   ] [ lambda ] = [ -(dG/dt) u      ]
///
/// Throws ModelError naming the joint and its gap when the joints are not closed at the start, or
/// the velocities part them; SolverError when the matrix is singular.
void consistent_start(const system::Regime& system, const system::Pattern& pattern, VectorX& y,
                      VectorX& yp);

/// Makes accepted instants consistent again where loads or drives have jumped, in a system whose
/// rows neither come nor go, so that its matrix is ordered once.
class Consistency {
public:
  explicit Consistency(system::Regime& system);
  Consistency(const Consistency&) = delete;
  Consistency& operator=(const Consistency&) = delete;
  ~Consistency();

  /// Rates and reactions that belong to the positions, velocities and loads, whatever formulation
  /// is integrated; velocities that drives do not allow any more jump by impulses of the rows.
  /// Throws SolverError where they do not exist.
  /// @returns the work of all rows through their impulses [J] where velocities jumped
  std::optional<double> restore(double t, VectorX& y, VectorX& yp);

private:
  struct Parts;
  system::Regime& s_;
  std::unique_ptr<Parts> parts_;
};

} // namespace hydrodae::statics
