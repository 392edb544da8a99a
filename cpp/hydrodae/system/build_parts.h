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

/// Hydrostatics, added mass and radiation memory (build_hydro.cpp). Throws ModelError.
void add_hydro(const model::Scene& scene, System& system);

/// Takes the mean yaws of the hydrodynamic bodies from where they start, and turns the hydrostatics
/// with them (mean_yaw.cpp).
/// @returns whether any of them changed by more than rounding
bool take_mean_yaw(const model::Scene& scene, System& system);

/// Notes what the hydrodynamic axes and the places of the bodies leave out (mean_yaw.cpp).
void note_axes(const model::Scene& scene, System& system);

/// Buoyancy and linear hydrostatics in the axes of the database (build_hydro.cpp).
force::LinearWrench hydrostatic_law(const model::Scene& scene, int body);

/// Excitation of the sea where the bodies start (build_sea.cpp); needs `add_hydro`. Throws
/// ModelError.
void add_sea(const model::Scene& scene, System& system);

/// Morison elements and the water that they feel (build_morison.cpp). Throws ModelError.
void add_morison(const model::Scene& scene, System& system);

} // namespace hydrodae::system
