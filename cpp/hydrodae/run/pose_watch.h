#pragma once
/// Singular poses of closed loops, for guards with stricter limits there.

#include <memory>

#include "hydrodae/core/error.h"
#include "hydrodae/core/solver_options.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::run {

struct Step;

/// Decides whether a step was at or near a singular pose of a closed loop. The constraint rows of a
/// mechanism are there a hundred times closer to linear dependence than in its best pose so far, in
/// the metric of the masses. They must be close by geometry alone, too: light bars between heavy
/// ones look dependent in any pose. Redundant rows are thus no singular pose. Scenes without loops
/// need no watch.
class PoseWatch {
public:
  /// @param options  options of the method; they must outlive the watch, which follows changes
  /// @param y  pose at the start, assumed regular
  /// @param wanted  true: a guard needs the watch
  PoseWatch(const system::Regime& system, const SolverOptions& options, const VectorX& y,
            bool wanted);
  ~PoseWatch();

  /// Returns whether the step is near a singular pose. One in four short steps is checked, because
  /// passing such a pose takes more; long steps are also checked inside.
  bool near_singular(const Step& step);

  /// Adds advice to `halt`, for a step that failed near a singular pose.
  Halt with_remedy(Halt halt, double t, const VectorX& y, const VectorX& yp);

  /// Restarts with other rows; the pose of y is assumed regular.
  void restart(const VectorX& y);

  struct State {
    VectorX best;        ///< best independence of the rows so far, by mechanism
    VectorX best_pivots; ///< least pivots of the rows in the best pose so far, by mechanism
    long asked = 0;      ///< number of times that a singular pose would have mattered
  };
  const State& state() const { return state_; }
  void set(State state) { state_ = std::move(state); }

private:
  struct Rows;

  void begin(const VectorX& y);
  VectorX independence(double t, const VectorX& y, const VectorX& yp);
  VectorX pivots(const VectorX& y) const;
  bool is_singular(double t, const VectorX& y, const VectorX& yp);

  const system::Regime& s_;
  const SolverOptions& options_;
  std::unique_ptr<Rows> rows_; ///< null: nothing to watch
  State state_;
  VectorX y_, yp_; ///< scratch
};

/// Returns whether joints close a loop through moving bodies and the ground.
bool has_loop(const system::Regime& system);

/// Regime with both levels of the constraints as rows.
system::Regime stabilised(system::Regime system);

} // namespace hydrodae::run
