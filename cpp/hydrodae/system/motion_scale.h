#pragma once
/// Tolerances in proportion to the motion: an error of a micrometre matters only where a device
/// moves by micrometres. If bodies turn much more than they are displaced (a spinning top), the
/// tolerances of translations follow the displacement.

#include "hydrodae/system/jacobian.h"

namespace hydrodae::system {

/// Smallest translation, as part of the motion of a group, that sets its tolerance.
inline constexpr double least_translation = 1e-3;

/// Largest motion of a body that counts as at rest: the effect of rounding [levers, rad].
inline constexpr double rest_motion = 1e-10;

/// Updates System::motion_scale: by group, the motion as a part of the full scales (a tenth of a
/// body's lever), between the rounding error of positions and 1. The motion is the larger of the
/// displacement so far and, fading, the expectation from start and loads. Updates
/// System::translation_scale, too: the part due to translations, at least 1e-3.
class MotionScale {
public:
  /// @param pattern  pattern of the Jacobian
  /// @param y, yp  consistent start
  /// @param forced  expected motion from loads and drives, by group in levers (Forcing::motion)
  /// @param hold  time over which this expectation counts [s]
  /// @param rtol  relative tolerance of the run
  MotionScale(Regime& system, const Pattern& pattern, const VectorX& y, const VectorX& yp,
              const VectorX& forced, double hold, double rtol);

  /// Takes an accepted state. The scales change if the motion exceeds them, or stays far below the
  /// expectation.
  void accept(double t, const VectorX& y);

  /// Restarts the expectation at t, where a load sets in, from y and y' as at a start. Returns
  /// false if the scales already allow for the motion.
  bool begin_again(const Pattern& pattern, double t, const VectorX& y, const VectorX& yp);

  /// Largest displacement from the start so far, by group in levers or rad (n_groups,).
  const VectorX& reached() const { return state_.reached; }

  /// Returns whether nothing has moved by more than rounding; true as well if nothing can move.
  bool at_rest() const {
    return s_.lambda0 == 0 ||
           (state_.reached.size() > 0 && state_.reached.maxCoeff() < rest_motion);
  }

  /// Notes on groups whose motion is too small for the tolerance to follow, because of rounding.
  std::vector<std::string> notes() const;

  struct State { ///< quantities by group (n_groups,)
    VectorX expected, reached;
    VectorX expected_translation, translated;
    VectorX since; ///< start of the period in which the expected motion counts [s]
  };
  const State& state() const { return state_; }

  /// Sets the state; the scales of the system come from its `Held`.
  void set(State state);

private:
  void expect_start(const Pattern& pattern, double t, const VectorX& y, const VectorX& yp);
  void expect(const BodyData& body, bool translation, double motion);
  bool update(double t);

  Regime& s_;
  VectorX start_; ///< positions at the start (n_q,)
  VectorX least_; ///< lower bound by group, from rounding
  VectorX hold_;  ///< duration of the expectation by group [s]
  State state_;
};

/// Displacement of each body from the positions `from` (n_q,): the larger of translation over lever
/// and angle [-] (n_bodies,).
VectorX displacements(const Regime& system, const VectorX& from, const VectorX& y);

} // namespace hydrodae::system
