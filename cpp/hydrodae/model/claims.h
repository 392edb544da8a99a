#pragma once
/// Which element models which effect of the water on which body. Drag, moorings and other forces
/// add up; these effects do not: two models of one of them count it twice.

#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

enum class Effect {
  buoyancy,
  froude_krylov,
  diffraction,
  added_mass,
  radiation,
  mean_drift,
  slow_drift,
  sum_force
};
std::string_view name_of(Effect effect); ///< as a message names it

/// An element models these effects on a body.
struct Claim {
  std::string body;
  std::vector<Effect> effects;
  std::string key;     ///< path of the key: "body.float.volume"
  std::string by;      ///< in a message: "its 'volume'"
  std::string instead; ///< what to write if another element models them already
  bool part = false;   ///< of the body only: such claims add up
};

/// All claims of a scene whose meshes are read. Of two on one effect the later one is refused.
std::vector<Claim> claims(const Scene& scene);

/// Does the whole element lie inside a mesh that has the load of the undisturbed waves? Then its
/// inertia force is rho V C_a (a_f - a_b).
bool leaves_waves_to_mesh(const Body& body, const water::Morison& element);

} // namespace hydrodae::model
