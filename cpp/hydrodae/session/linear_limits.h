#pragma once
/// Limits of linear hydrodynamics, made for small motion about the mean pose, and of modes, made
/// for slow rotation.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::session {

/// Measure of one body that exceeded its limit.
struct Crossing {
  /// Time and value of the first sample beyond the limit [s], [rad] or [m]
  double time = 0.0, value = 0.0;
  double largest = 0.0; ///< largest value of all samples
};

/// Watched motion of moving hydrodynamic bodies relative to the mean pose: the pose of the
/// database, turned by the mean yaw, at the start of the body.
struct LinearLimits {
  struct Body {
    int body = 0;
    std::string name;
    Matrix3 mean = Matrix3::Identity(); ///< rotation by the mean yaw
    Vector3 place = Vector3::Zero();    ///< x, y of the start, z of the reference pose [m]
    /// True: the hydrodynamics follow the yaw, and only tilt counts
    bool free_yaw = false;
    double half_draught = INFINITY; ///< [m]
  };
  /// Mode of a rotating body: its centrifugal loads act as a stiffness -m w^2.
  struct Mode {
    int body = 0;
    std::string name; ///< name of the body, then of the mode
    /// Rate at which the centrifugal load is `softening` of its stiffness [rad/s]
    double largest_rate = 0;
  };
  static constexpr double softening = 0.01;
  static constexpr double largest_turn = 15.0 * pi / 180.0; ///< [rad]
  /// Tenth of the wave length [m], for waves whose phase does not follow the bodies
  double tenth_wave = INFINITY;
  std::vector<Body> bodies;
  std::vector<Mode> modes;

  struct OfBody {
    std::optional<Crossing> turn;  ///< rotation [rad], beyond `largest_turn`
    std::optional<Crossing> rise;  ///< vertical [m], beyond half the draught
    std::optional<Crossing> drift; ///< horizontal [m], beyond a tenth of the wave length
  };
  struct State {
    std::vector<OfBody> bodies;
    std::vector<std::optional<Crossing>> spins; ///< rate of each mode
  };
  State state;
};

/// Limits for a scene. The database lacks the draught; displaced volume over waterplane, or the
/// cube root of the volume if less, replaces it. The wave length is the mean over all components,
/// weighted by energy.
LinearLimits linear_limits(const model::Scene& scene, const system::System& system);

/// Takes one sample: states of all bodies at time t.
void watch(LinearLimits& limits, double t, const std::vector<system::BodyState<double>>& states);

/// Note on each measure that exceeded its limit, with body, time and value.
std::vector<std::string> notes(const LinearLimits& limits);

} // namespace hydrodae::session
