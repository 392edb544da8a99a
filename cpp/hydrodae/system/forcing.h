#pragma once
/// Limits on steps from loads and drives that are known ahead of time. The error estimate of a step
/// samples the load at few points: while nothing moves, steps grow and would pass over later loads.

#include <string>
#include <vector>

#include "hydrodae/math/windows.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// Step limits from the functions of time that act on a scene.
class Forcing {
public:
  /// Samples all drives and all laws that follow the time, from 0 to `end` [s]. Python functions
  /// are sampled at half the `output_step` [s] or finer.
  Forcing(const Regime& system, double end, double output_step);

  /// Latest time that a step may reach [s], and the name of the function that limits it.
  struct Limit {
    double time = 0.0;
    const std::string* by = nullptr;
  };

  /// @param turns  coordinates at the start of the step: positions of bodies on their paths
  /// @param gap  largest part of a step between two evaluations of the loads
  /// @param stretch  factor on the limit by waves, 1 for most runs
  Limit limit(const Turns& turns, double gap, double stretch);

  /// Expected motion of the bodies of each group, in units of their lever [-]; 0: at rest.
  const VectorX& motion() const { return motion_; }

private:
  void add_drives(const Regime& s, double end, double output_step);
  void add_waves(const Regime& s);
  void add_paths(const Regime& s);
  void add_elements(const Regime& s, double end, double output_step);
  void expect(const BodyData& body, bool turns, double motion);

  struct Track {
    std::string name;
    Windows windows;
    std::size_t hint = 0;
  };
  struct Curve { ///< a path in either direction, windows of its arc length [m]
    std::string name;
    std::size_t motion = 0;
    double length = 0.0;
    Windows forward, backward;
    std::size_t forward_hint = 0, backward_hint = 0;
  };
  std::vector<std::size_t> angles_; ///< motions that are angles
  std::vector<Track> tracks_;
  std::vector<Curve> curves_;
  double shortest_wave_ = INFINITY; ///< period of the shortest wave that matters [s]
  std::string waves_ = "the waves", turning_ = "a joint that turns this fast";
  VectorX motion_;
};

} // namespace hydrodae::system
