#pragma once
#include <memory>
#include <optional>

#include "hydrodae/system/jacobian.h"

namespace hydrodae::statics {

/// Completes the start: the multipliers in y (positions, velocities, memory given) and all rates
/// y', from one solve of the saddle-point system
///
///   [ M  -G^T ] [ u'     ]   [ f               ]
///   [ G   0   ] [ lambda ] = [ -(dG/dt) u      ]
///
/// Throws ModelError with the joint and its gap if the joints are not closed at the start or the
/// velocities open them, SolverError if the matrix is singular.
void consistent_start(const system::Regime& system, const system::Pattern& pattern, VectorX& y,
                      VectorX& yp);

/// Makes accepted instants consistent after jumps of loads or drives. The rows of the system do not
/// change, so that its matrix is ordered once.
class Consistency {
public:
  explicit Consistency(system::Regime& system);
  Consistency(const Consistency&) = delete;
  Consistency& operator=(const Consistency&) = delete;
  ~Consistency();

  /// Computes rates and reactions from positions, velocities and loads, in any formulation.
  /// Velocities that contradict drives jump by impulses of the rows. Throws SolverError if they do
  /// not exist.
  /// @returns the work of all rows through their impulses [J], if velocities jumped
  std::optional<double> restore(double t, VectorX& y, VectorX& yp);

private:
  struct Parts;
  system::Regime& s_;
  std::unique_ptr<Parts> parts_;
};

} // namespace hydrodae::statics
