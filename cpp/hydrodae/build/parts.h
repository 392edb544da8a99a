#pragma once
/// The parts of `build` that live in files of their own.

#include "hydrodae/build/sea.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::build {

/// Length scale and lever of each body, force scale of each joint (scales.cpp).
void set_body_scales(const model::Scene& scene, system::System& system);

/// BodyData::scale_mass, once the groups are known.
void set_scale_masses(system::System& system);

/// Hydrostatics, added mass and radiation memory (hydro.cpp). Throws ModelError.
void add_hydro(const model::Scene& scene, system::System& system);

/// Added mass and radiation of the bodies that are wet in `scene`, by its database, into `s.hydro`
/// (radiation.cpp). Throws ModelError.
void add_radiation(const model::Scene& scene, system::System& s);

/// Mass and added mass together must be positive (hydro.cpp). Throws ModelError.
void check_mass(const system::System& s);

/// The same where tables follow the poses of bodies (pose_tables.cpp). Throws ModelError.
void add_pose_tables(const model::Scene& scene, system::System& s);

/// "float.heave" of coordinate c of a body in the water, as in databases; and where a label stands,
/// -1: nowhere (radiation.cpp).
std::string hydro_label(const model::Scene& scene, const system::HydroBody& body, int c);
int label_index(const std::vector<std::string>& labels, const std::string& label);

/// Takes the mean yaws of the hydrodynamic bodies from where they start, and turns the hydrostatics
/// with them (mean_yaw.cpp).
/// @returns whether any of them changed by more than rounding
bool take_mean_yaw(const model::Scene& scene, system::System& system);

/// Notes what the hydrodynamic axes and the places of the bodies leave out (mean_yaw.cpp).
void note_axes(const model::Scene& scene, system::System& system);

/// A marker at a point of a body, both in the reference pose, world axes.
joint::Marker make_marker(const model::Scene& scene, const std::string& body, const Vector3& point,
                          const Matrix3& axes);

/// Adds a joint and its motions (joints.cpp).
system::JointData& add_joint(system::System& system, system::JointData joint);
void add_joint(const model::Scene& scene, const model::Joint& joint, system::System& system);

/// Adds the motion that stands for one coordinate of a body (joints.cpp).
int body_motion(const model::Scene& scene, const std::string& body, const std::string& coordinate,
                system::System& system);

/// The motion of a joint by name, its first one without; -1 if absent (joints.cpp).
int joint_motion(const system::System& system, const std::string& joint,
                 const std::optional<std::string>& coordinate);

/// Keeps the rows that restrict a free coordinate; those left over must hold as they are
/// (joints.cpp). Throws ModelError.
void select_rows(system::System& system);

/// The conditions that hold attachments to their bodies (deformation.cpp).
void add_attachments(const model::Scene& scene, system::System& system);

/// Stiffness and damping of modes, and their hydrostatics (deformation.cpp); made again by each
/// call.
void set_mode_loads(const model::Scene& scene, system::System& system);

/// Notes modes of held bodies that the weight should load and does not (deformation.cpp).
void note_weights(const model::Scene& scene, system::System& system);

/// Couplers, drives, stops and one-sided distances (couplers.cpp). Throws ModelError.
void add_constraints(const model::Scene& scene, system::System& system);

/// Adds the coupler of a switch, open at first (couplers.cpp).
void add_switch(const std::string& name, system::SwitchData element, system::System& system);

/// Couplers hold what they find at the start (couplers.cpp).
void set_coupler_offsets(system::System& system);

/// The forces of the case with their ports (elements.cpp).
void add_elements(const model::Scene& scene, const Sea& sea, system::System& system);

/// The reactions of joints that laws feel, once it is known which rows are kept (reactions.cpp).
/// Throws ModelError where a joint has no single reaction that presses.
void find_reactions(system::System& system);
/// Chambers of air with their pistons and outlets (chambers.cpp).
void add_chambers(const model::Scene& scene, system::System& system);

/// States of laws that start at rest, where the bodies start (elements.cpp). Throws
/// ModelError.
void start_laws(system::System& system);

/// Buoyancy and linear hydrostatics of all wet bodies, turned by their mean yaws
/// (elements.cpp); made again by each call.
void set_hydrostatics(const model::Scene& scene, system::System& system);

/// Excitation of the sea where the bodies start (sea.cpp); needs `add_hydro`. Throws
/// ModelError.
void add_sea(const model::Scene& scene, const Sea& sea, system::System& system);

/// Loads of pairs of waves (second_order.cpp); needs `add_hydro`. Throws ModelError.
void add_second_order(const model::Scene& scene, const Sea& sea, system::System& system);

/// Gauges of the elevation, and the waves that they see (gauges.cpp); behind the markers.
void add_gauges(const model::Scene& scene, const Sea& sea, system::System& system);

/// Bodies whose wetted surface is that of a mesh (hulls.cpp).
/// @param with_waves else in still water
void add_hulls(const model::Scene& scene, const Sea& sea, bool with_waves, system::System& system);

/// Morison elements and the water that they feel (morison.cpp). Throws ModelError.
void add_morison(const model::Scene& scene, const Sea& sea, system::System& system);

} // namespace hydrodae::build
