#pragma once
/// Claims: the element that models an effect of the water on a body. Drag, moorings and other
/// forces add up; for these effects two models would count twice.

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

/// Claim of an element to model these effects on a body.
struct Claim {
  std::string body;
  std::vector<Effect> effects;
  std::string key;     ///< path of the key: "body.float.volume"
  std::string by;      ///< subject of a message: "its 'volume'"
  std::string instead; ///< advice if another element already models them
  bool part = false;   ///< true: for part of the body only; such claims add up
};

/// Claims of a scene with loaded meshes. Of two claims on one effect the later one is refused.
std::vector<Claim> claims(const Scene& scene);

/// Returns whether the whole element lies inside a mesh with the load of the undisturbed waves. Its
/// inertia force is then rho V C_a (a_f - a_b).
bool leaves_waves_to_mesh(const Body& body, const water::Morison& element);

} // namespace hydrodae::model
