#pragma once
/// Singular poses of closed loops, for the guards that allow less there.

#include <memory>

#include "hydrodae/core/error.h"
#include "hydrodae/core/solver_options.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::run {

struct Step;

/// Decides whether a step was at or next to a singular pose of a closed loop. There the constraint
/// rows of a mechanism are a hundred times nearer to dependence on each other than in its best pose
/// seen, as the masses feel it. By geometry alone they are near it, too: light bars between heavy
/// ones look dependent in any pose. Rows that always follow from others are thus no singular pose.
/// Scenes without loops have nothing to watch.
class PoseWatch {
public:
  /// @param options whose method makes the steps; they outlive the watch, which follows changes
  /// @param y pose of the start, taken for a regular one
  /// @param wanted some guard will ask
  PoseWatch(const system::Regime& system, const SolverOptions& options, const VectorX& y,
            bool wanted);
  ~PoseWatch();

  /// Of short steps one in four is looked at, since the way through such a pose takes more; long
  /// ones are looked at inside, too.
  bool near_singular(const Step& step);

  /// Adds to `halt`, of a step that cannot be made next to a singular pose, what to do about it.
  Halt with_remedy(Halt halt, double t, const VectorX& y, const VectorX& yp);

  /// Other rows hold from now on; takes the pose of y for a regular one.
  void restart(const VectorX& y);

  struct State {
    VectorX best;        ///< independence of the rows in the best pose seen, by mechanism
    VectorX best_pivots; ///< least pivots of the rows in the best pose seen, by mechanism
    long asked = 0;      ///< times that a singular pose would have mattered
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

/// Do the joints close a loop through moving bodies and the ground?
bool has_loop(const system::Regime& system);

/// The same equations with both levels of the constraints as rows.
system::Regime stabilised(system::Regime system);

} // namespace hydrodae::run
