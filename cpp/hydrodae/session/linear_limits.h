#pragma once
/// Where a run leaves what linear hydrodynamics are made for, small motion about the mean pose; and
/// what modes are made for, slow turns.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::session {

/// A measure of one body that grew beyond its limit.
struct Crossing {
  double time = 0.0, value = 0.0; ///< of the first sample beyond the limit [s], [rad] or [m]
  double largest = 0.0;           ///< of all samples
};

/// What is watched of one hydrodynamic body that moves, against its mean pose: the pose of the
/// database, turned by the mean yaw, at the place where the body starts.
struct LinearLimits {
  struct Body {
    int body = 0;
    std::string name;
    Matrix3 mean = Matrix3::Identity(); ///< turn by the mean yaw
    Vector3 place = Vector3::Zero();    ///< x, y of the start, z of the reference pose [m]
    bool free_yaw = false;              ///< the hydrodynamics follow the yaw: tilt alone counts
    double half_draught = INFINITY;     ///< [m]
  };
  /// A mode of a body that turns: its centrifugal loads are those of a stiffness -m w^2.
  struct Mode {
    int body = 0;
    std::string name;        ///< of the body, then of the mode
    double largest_rate = 0; ///< at which that is `softening` of its stiffness [rad/s]
  };
  static constexpr double softening = 0.01;
  static constexpr double largest_turn = 15.0 * pi / 180.0; ///< [rad]
  double tenth_wave = INFINITY; ///< tenth of the wave length, which matters where the phase of the
                                ///< waves does not follow the bodies [m]
  std::vector<Body> bodies;
  std::vector<Mode> modes;

  struct OfBody {
    std::optional<Crossing> turn;  ///< [rad], beyond `largest_turn`
    std::optional<Crossing> rise;  ///< vertical [m], beyond half the draught
    std::optional<Crossing> drift; ///< horizontal [m], beyond a tenth of the wave length
  };
  struct State {
    std::vector<OfBody> bodies;
    std::vector<std::optional<Crossing>> spins; ///< of each mode
  };
  State state;
};

/// What to watch in a scene. The draught is not in the database: displaced volume over waterplane,
/// or the cube root of the volume where that is less, stands for it. The wave length is the mean
/// over all components, weighted by energy.
LinearLimits linear_limits(const model::Scene& scene, const system::System& system);

/// Takes one sample: the states of all bodies at time t.
void watch(LinearLimits& limits, double t, const std::vector<system::BodyState<double>>& states);

/// A sentence for each measure that went beyond its limit, with body, time and value.
std::vector<std::string> notes(const LinearLimits& limits);

} // namespace hydrodae::session
