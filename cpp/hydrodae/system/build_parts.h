#pragma once
/// The parts of `build` that live in files of their own.

#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::system {

/// Length scale and lever of each body, force scale of each joint (build_scales.cpp).
void set_body_scales(const model::Scene& scene, System& system);

/// Tolerance scales of all unknowns; needs the layout (build_scales.cpp).
void set_scales(System& system);

/// What a constraint row holds, for people: "gap along x".
std::string row_name(const joint::BasicRow& row);

/// Names of unknowns and rows; needs the layout (build_names.cpp).
void set_names(System& system);

/// Yaw of a body's x axis at the start [rad].
double start_yaw(const BodyData& body);

/// Hydrostatics, added mass and radiation memory (build_hydro.cpp). Throws ModelError.
void add_hydro(const model::Scene& scene, System& system);

/// Excitation of the sea (build_sea.cpp); needs `add_hydro`. Throws ModelError.
void add_sea(const model::Scene& scene, System& system);

/// Morison elements and the water that they feel (build_morison.cpp). Throws ModelError.
void add_morison(const model::Scene& scene, System& system);

} // namespace hydrodae::system
