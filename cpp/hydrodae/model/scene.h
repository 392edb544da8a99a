#pragma once
/// Scene: the content of a case file as plain structs. The case reader builds it, `check` checks
/// it; afterwards it is immutable.

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/air/chamber.h"
#include "hydrodae/air/outlets.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/field.h"
#include "hydrodae/core/indirect.h"
#include "hydrodae/core/solver_options.h"
#include "hydrodae/hull/mesh.h"
#include "hydrodae/hydro/database.h"
#include "hydrodae/model/constraint.h"
#include "hydrodae/model/controller.h"
#include "hydrodae/model/input_file.h"
#include "hydrodae/model/mode.h"
#include "hydrodae/model/pose_table.h"
#include "hydrodae/model/radiation.h"
#include "hydrodae/model/seabed.h"
#include "hydrodae/model/second_order.h"
#include "hydrodae/sea/gauge.h"
#include "hydrodae/sea/wave.h"
#include "hydrodae/water/morison.h"

namespace hydrodae::model {

/// Table [environment].
struct Environment {
  static constexpr std::string_view doc =
      "Gravity, the water where no hydrodynamic database states it, and the air.";
  std::optional<double> gravity, water_density, water_depth, air_pressure, air_density;

  template <class E = Environment> static Fields<E> fields() {
    return {
        {"gravity", &E::gravity, "m/s2",
         "Acceleration of gravity, along -z; default: that of the database, without one 9.81.",
         false, at_least(0)},
        {"water_density", &E::water_density, "kg/m3",
         "Density of the water, where there is no hydrodynamic database.", false, more_than(0)},
        {"water_depth", &E::water_depth, "m",
         "Depth of the water, where there is no hydrodynamic database; infinite by default.", false,
         more_than(0)},
        {"air_pressure", &E::air_pressure, "Pa",
         "Pressure of the atmosphere around chambers, absolute; default: 101 325.", false,
         more_than(0)},
        {"air_density", &E::air_density, "kg/m3",
         "Density of the air around chambers; default: 1.225.", false, more_than(0)},
    };
  }
};

/// Table [hydro]: the database and the radiation model.
struct HydroOptions : water::RadiationKeys {
  static constexpr std::string_view doc =
      "The hydrodynamic database, and how the loads of the water are taken from it.";
  std::string database;
  std::string axes = "mean";
  std::string radiation = "exponential";

  RungReads reads() const { return reads_of(radiation); }
  water::HydroAxes axes_kind() const { return axes_of(axes); }

  template <class H = HydroOptions> static Fields<H> fields() {
    const Fields<H> own = {
        {"database", &H::database, "-", "Path of hydro.h5, relative to the case file.", true},
        {"axes", &H::axes, "-", axes_doc(), false, any_value, axes_choices()},
        {"radiation", &H::radiation, "-", radiation_doc(), false, any_value, radiation_words()},
    };
    return own + radiation_keys<H>();
  }
};

/// Start of a body, relative to its reference pose.
struct BodyInitial {
  static constexpr std::string_view doc = "Start of the body, relative to its reference pose.";
  Vector3 displacement = Vector3::Zero();
  Vector3 rotation = Vector3::Zero();
  std::optional<Vector3> velocity, angular_velocity;

  template <class B = BodyInitial> static Fields<B> fields() {
    return {
        {"displacement", &B::displacement, "m", "Of the centre of gravity, world axes."},
        {"rotation_deg", &B::rotation, "deg", "Rotation vector, world axes."},
        {"velocity", &B::velocity, "m/s",
         "Of the centre of gravity, world axes; what is not given follows from the constraints."},
        {"angular_velocity", &B::angular_velocity, "rad/s",
         "World axes; what is not given follows from the constraints."},
    };
  }
};

/// Origin of a body that is not in the case: a mode of another body, with translation along x as
/// its amplitude, or an attachment on it.
struct DeformablePart {
  bool mode = false;
  std::size_t entry = 0; ///< index in Scene::modes or Scene::attachments
  std::string body;      ///< body that deforms
};

/// Table [[body]].
struct Body {
  static constexpr std::string_view doc = "A rigid body.";
  std::string name;
  std::vector<std::string> motion = {"rigid"};
  ValueOrWord<double> mass = {0.0, {}};
  Vector3 center_of_gravity = Vector3::Zero();
  ValueOrWord<Vector3> inertia = {Vector3::Zero(), {}};
  std::optional<Vector3> radii_of_gyration;
  Vector3 products_of_inertia = Vector3::Zero();
  /// Rotation vector; `inertia` then holds the principal moments
  std::optional<Vector3> principal_axes;
  std::optional<std::string> hydro;
  double volume = 0.0; ///< 0: not given
  std::optional<Vector3> center_of_buoyancy;
  std::optional<std::string> mesh;
  Vector3 mesh_origin = Vector3::Zero();
  std::string hydrostatics = "linear", froude_krylov = "linear";
  bool hydrostatics_by_mesh() const { return hydrostatics == "mesh"; }
  bool is_point() const { return motion == std::vector<std::string>{"point"}; }
  bool waves_by_mesh() const { return froude_krylov == "mesh"; }
  std::shared_ptr<const hull::Mesh> hull; ///< read from `mesh`, about the centre of gravity
  BodyInitial initial;
  std::optional<DeformablePart> part; ///< origin of a body that is not in the case (deformation.h)
  bool is_mode() const { return part && part->mode; }

  template <class B = Body> static Fields<B> fields() {
    return {
        {"name", &B::name, "-", "Name of the body.", true},
        {"motion",
         &B::motion,
         "-",
         "What the body can do: fixed, heave, planar (surge, heave, pitch), point (3 "
         "translations), rigid (6), or a list of free coordinates.",
         false,
         any_value,
         {"fixed", "planar", "point", "rigid", "surge", "sway", "heave", "roll", "pitch", "yaw"}},
        {"mass",
         &B::mass,
         "kg",
         "Mass, or that of the water displaced in the reference pose (equilibrium).",
         true,
         at_least(0),
         {"equilibrium"}},
        {"center_of_gravity", &B::center_of_gravity, "m",
         "Centre of gravity in the reference pose, world axes.", true},
        {"inertia",
         &B::inertia,
         "kg m2",
         "Moments of inertia Ixx, Iyy, Izz about the centre of gravity, or those of a uniform "
         "solid that fills `mesh`, about its own centroid (mesh).",
         false,
         at_least(0),
         {"mesh"}},
        {"radii_of_gyration", &B::radii_of_gyration, "m",
         "Radii r of gyration instead of `inertia`: the moments are m r^2.", false, at_least(0)},
        {"products_of_inertia", &B::products_of_inertia, "kg m2",
         "Ixy, Iyz, Izx as entries of the inertia tensor (Ixy = -sum m x y)."},
        {"principal_axes_deg", &B::principal_axes, "deg",
         "Rotation vector that turns the world axes into the principal axes of inertia in the "
         "reference pose; inertia then holds the principal moments."},
        {"hydro", &B::hydro, "-",
         "Name of this body in the hydrodynamic database; without it the body is dry."},
        {"volume", &B::volume, "m3",
         "Volume of a body without `hydro` that is and stays under water: it has the buoyancy "
         "rho g V. That of a point (motion) is a sphere, whose buoyancy ends at z = 0.",
         false, more_than(0)},
        {"center_of_buoyancy", &B::center_of_buoyancy, "m",
         "Centre of that volume in the reference pose, world axes; default: the centre of "
         "gravity."},
        {"mesh", &B::mesh, "-",
         "File (.stl or .obj, in metres, relative to the case file) of the closed surface of the "
         "body in the reference pose. World axes, normals outwards; it must reach above the "
         "highest water."},
        {"mesh_origin", &B::mesh_origin, "m",
         "Place of the origin of that file in the reference pose, world axes; for a mesh about the "
         "centre of gravity the place of that."},
        {"hydrostatics",
         &B::hydrostatics,
         "-",
         "Hydrostatics: the stiffness of the database about the reference pose (linear), or the "
         "pressure on the wetted part of `mesh` at each instant (mesh).",
         false,
         any_value,
         {"linear", "mesh"}},
        {"froude_krylov",
         &B::froude_krylov,
         "-",
         "Load of the undisturbed waves: that of the database about the mean pose (linear), or "
         "their pressure on the part of `mesh` beneath their surface (mesh). Diffraction and "
         "radiation stay those of the database.",
         false,
         any_value,
         {"linear", "mesh"}},
    };
  }
};

/// Start of a joint, in its own coordinate. Body B and everything attached to it moves.
struct JointInitial {
  static constexpr std::string_view doc =
      "Start of the joint in its own coordinate; body B, and what hangs on it, is moved.";
  std::optional<double> angle;
  std::optional<double> angle_rate;
  std::optional<double> displacement;
  std::optional<double> displacement_rate;

  template <class J = JointInitial> static Fields<J> fields() {
    return {
        {"angle_deg", &J::angle, "deg", "Angle of a joint that turns."},
        {"angle_rate", &J::angle_rate, "rad/s", "Rate of the angle."},
        {"displacement", &J::displacement, "m", "Displacement of a joint that slides."},
        {"displacement_rate", &J::displacement_rate, "m/s", "Rate of the displacement."},
    };
  }
};

/// Table [[joint]]. Its markers follow from `point`, `axis` (their z) and `axis_x` in the reference
/// pose of both bodies.
struct Joint {
  static constexpr std::string_view doc =
      "A joint that carries body B on body A, or on the ground.";
  std::string name;
  std::string type;
  std::string body_a;
  std::string body_b;
  Vector3 point = Vector3::Zero();
  std::optional<Vector3> axis;
  std::optional<Vector3> axis_x;
  std::optional<Vector3> point_b;
  std::optional<double> length;
  double pitch = 0.0; ///< 0: not given
  std::vector<Vector3> path;
  bool one_sided = false;
  std::optional<double> restitution, contact_time;
  JointInitial initial;

  /// Defined in scene.cpp: the choices of `type` come from the joint table
  static Fields<Joint> fields();
};

/// Table [[marker]]: point of a body whose motion is reported.
struct Marker {
  static constexpr std::string_view doc = "A point of a body whose motion is reported.";
  std::string name;
  std::string body;
  Vector3 point = Vector3::Zero();
  std::string axes = "world";

  template <class M = Marker> static Fields<M> fields() {
    return {
        {"name", &M::name, "-", "Name of the marker in the results.", true},
        {"body", &M::body, "-", "Body that carries it.", true},
        {"point", &M::point, "m", "Where it is in the reference pose, world axes.", true},
        {"axes",
         &M::axes,
         "-",
         "Axes of the velocity and acceleration that are reported: of the world, or carried by the "
         "body. The position is in world axes.",
         false,
         any_value,
         {"world", "body"}},
    };
  }
};

/// Table [output].
struct OutputOptions {
  static constexpr std::string_view doc = "What the results file holds.";
  double step = 0.1;

  template <class O = OutputOptions> static Fields<O> fields() {
    return {{"step", &O::step, "s", "Time between two samples of the results.", false,
             more_than(0, longest_time)}};
  }
};

struct Forces;

struct Scene {
  // Defined once in scene.cpp, because every list of forces is copied and freed there.
  Scene();
  ~Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;

  std::string title;
  std::vector<std::string> missing; ///< parts of the modelled device that the case lacks
  Environment environment;
  std::optional<HydroOptions> hydro;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Constraint> constraints;
  std::vector<Mode> modes;
  std::vector<Attachment> attachments;
  std::vector<Marker> markers;
  Indirect<Forces> forces; ///< lists by type (model/forces.h)
  std::vector<water::Morison> morison;
  std::vector<air::Chamber> chambers;
  std::vector<air::Piston> pistons;
  std::vector<air::AnyOutlet> outlets;
  sea::Sea sea;
  std::vector<sea::Wave> waves;
  SolverOptions solver;
  OutputOptions output;
  std::vector<PoseTable> pose_tables;
  std::shared_ptr<const hydro::Database> database; ///< null without [hydro]

  std::string text;                        ///< case file as read, followed by the applied overrides
  std::string path;                        ///< path; "" if it was parsed from a string
  std::vector<InputFile> files;            ///< files that it reads, in the order of reading
  std::vector<std::string> overrides;      ///< "key = value" as given on the command line
  std::map<std::string, FilePlace> places; ///< places of all given keys, by their path
  std::vector<Controller> controllers;
  std::vector<sea::Gauge> gauges;
  std::optional<SecondOrder> second_order;
  std::optional<Seabed> seabed;
};

/// Forces of one type, and the names of all. A file that needs no other type includes the header of
/// this one; model/forces.h lists all types.
template <class Force> const std::vector<Force>& forces_of(const Scene& scene);
std::vector<std::string> force_names(const Scene& scene);

/// Checks that involve several entries: names exist and are unique, masses and inertias are
/// physical, the database covers the scene. Throws ModelError with the path of the faulty key.
void check(const Scene& scene);

/// Water of a checked scene, from its database or from [environment].
struct Water {
  double density = 0.0;    ///< [kg/m3]
  double depth = INFINITY; ///< [m]
  double gravity = 9.81;   ///< [m/s2]
};
Water water(const Scene& scene);

/// Summary of the scene as a short tree.
std::string summary(const Scene& scene);

/// Error with the place of its key in the case file, or of the entry that lacks it.
CaseError located(const Scene& scene, const ModelError& error);

} // namespace hydrodae::model
