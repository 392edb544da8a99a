#pragma once
/// What is known of the loads and drives ahead of time. A step's error estimate knows the load at a
/// few points only; while nothing moves, steps grow, and would pass over what comes later.

#include <string>
#include <vector>

#include "hydrodae/math/windows.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// Limits of the steps by the functions of time that act on a scene.
class Forcing {
public:
  /// Samples all drives and all laws that follow the time from 0 to `end` [s]; those that are
  /// Python functions at half the `output_step` [s] or finer.
  Forcing(const Regime& system, double end, double output_step);

  /// The latest time that a step may reach [s], and what limits it, in words.
  struct Limit {
    double time = 0.0;
    const std::string* by = nullptr;
  };

  /// @param turns of the state from which the step starts: where bodies are on their paths
  /// @param gap largest part of the step between two times at which it asks for the loads
  /// @param stretch of what waves allow, 1 for most runs
  Limit limit(const Turns& turns, double gap, double stretch);

  /// By group: how far its bodies will about be moved, in units of their lever [-]; 0: not at all.
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
  double shortest_wave_ = INFINITY; ///< period of the shortest that matters [s]
  std::string waves_ = "the waves", turning_ = "a joint that turns this fast";
  VectorX motion_;
};

} // namespace hydrodae::system
