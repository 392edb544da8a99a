#pragma once
/// Tolerances follow the motion: an error of a micrometre is nothing where a device moves by
/// metres, and all where it moves by micrometres. Where bodies turn much more than they are
/// displaced, as a top that spins upright, those of translations follow the displacement.

#include "hydrodae/system/jacobian.h"

namespace hydrodae::system {

/// Part of the motion of a group below which the tolerance of translations does not follow them.
inline constexpr double least_translation = 1e-3;

/// Motion up to which a body counts as at rest: what rounding moves [levers, rad].
inline constexpr double rest_motion = 1e-10;

/// Keeps System::motion_scale: by group, the part of the full scales (a tenth of a body's lever)
/// that the motion takes, between 1 and what rounding of the positions leaves. It is the largest of
/// the displacement reached so far and, fading, of what the start and the loads let expect. And
/// System::translation_scale: the part of it that the translations take, 1e-3 at least.
class MotionScale {
public:
  /// @param pattern of the Jacobian
  /// @param y, yp a consistent start
  /// @param forced motion to expect of loads and drives, by group in levers (Forcing::motion)
  /// @param hold time over which that is believed [s]
  /// @param rtol of the run
  MotionScale(Regime& system, const Pattern& pattern, const VectorX& y, const VectorX& yp,
              const VectorX& forced, double hold, double rtol);

  /// Takes an accepted state; the scales of the system change where the motion outgrew them, or
  /// stayed far below what was expected.
  void accept(double t, const VectorX& y);

  /// A load has set in at t that moves more than the scales allow for: the motion to expect of y,
  /// y' counts as at a start. False where they allow for it.
  bool begin_again(const Pattern& pattern, double t, const VectorX& y, const VectorX& yp);

  /// Largest displacement so far from the start, by group in levers or rad (n_groups,).
  const VectorX& reached() const { return state_.reached; }

  /// Has nothing moved by more than rounding? So it is where nothing can move.
  bool at_rest() const {
    return s_.lambda0 == 0 ||
           (state_.reached.size() > 0 && state_.reached.maxCoeff() < rest_motion);
  }

  /// Groups whose motion is below what rounding lets the tolerance follow.
  std::vector<std::string> notes() const;

  struct State { ///< by group (n_groups,)
    VectorX expected, reached;
    VectorX expected_translation, translated;
    VectorX since; ///< time from which on the expected motion is believed [s]
  };
  const State& state() const { return state_; }

  /// The scales of the system are those that its Held has.
  void set(State state);

private:
  void expect_start(const Pattern& pattern, double t, const VectorX& y, const VectorX& yp);
  void expect(const BodyData& body, bool translation, double motion);
  bool update(double t);

  Regime& s_;
  VectorX start_; ///< positions (n_q,)
  VectorX least_; ///< by group
  VectorX hold_;  ///< by group [s]
  State state_;
};

/// Displacement of each body from the positions `from` (n_q,): translations over the lever, or the
/// angle [-] (n_bodies,).
VectorX displacements(const Regime& system, const VectorX& from, const VectorX& y);

} // namespace hydrodae::system
