#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/core/types.h"

namespace hydrodae::model {

/// Start of a mode.
struct ModeInitial {
  static constexpr std::string_view doc = "Start of the mode.";
  double amplitude = 0.0;
  std::optional<double> rate;

  template <class M = ModeInitial> static Fields<M> fields() {
    return {
        {"amplitude", &M::amplitude, "m", "Amplitude of the mode."},
        {"rate", &M::rate, "m/s", "Its rate; if it is not given, it follows from the constraints."},
    };
  }
};

/// Table [[mode]]: shape in which a body deforms, with an amplitude q as an additional coordinate
/// of the body (Newman, Applied Ocean Research 16 (1994) 47-59). Of normal modes of the dry body
/// neither another mode nor a rigid motion shares the kinetic energy; others give that mass.
///
///   m q'' + c q' + k q = loads of the water and of attached parts on the shape, and the weight
///                         -g e_z.R w on it, w = integral of the shape over the mass
struct Mode {
  static constexpr std::string_view doc =
      "A shape in which a body deforms. Its amplitude is a further coordinate of the body.";
  std::string name;
  std::string body;
  double mass = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  std::optional<Vector3> participation;
  std::vector<double> mass_with_modes, mass_with_motions;
  std::optional<std::string> hydro;
  ModeInitial initial;
  const std::string& label() const { return hydro ? *hydro : name; } ///< label in the database

  template <class M = Mode> static Fields<M> fields() {
    return {
        {"name", &M::name, "-", "Name of the mode in the results.", true},
        {"body", &M::body, "-", "Body that deforms.", true},
        {"mass", &M::mass, "kg", "Modal mass of the dry body, in the scale of its shape.", true,
         more_than(0)},
        {"stiffness", &M::stiffness, "N/m",
         "Modal stiffness of the structure. That of the water comes from the database.", false,
         at_least(0)},
        {"damping", &M::damping, "N s/m", "Modal damping of the structure.", false, at_least(0)},
        {"participation", &M::participation, "kg",
         "Participation factors of finite-element programs: the shape, summed over the mass of the "
         "body, along its axes. By these the weight loads the mode. Default: zero, as of normal "
         "modes of a free body."},
        {"mass_with_modes", &M::mass_with_modes, "kg",
         "Mass that this mode shares with each mode of the body before it, in their order in the "
         "case: the product of the shapes, summed over the mass. Default: zero, as of normal "
         "modes."},
        {"mass_with_motions", &M::mass_with_motions, "-",
         "Mass that this mode shares with surge to yaw of the body: the shape [kg] and its moment "
         "about the centre of gravity [kg m], summed over the mass, along body axes. Default: "
         "zero, as of normal modes of a free body."},
        {"hydro", &M::hydro, "-",
         "Name of this mode in the hydrodynamic database, without the body; default: the name."},
    };
  }
};

/// Table [[attachment]]: place on a body that moves with its modes. Joints, forces and markers use
/// its name like the name of a body.
///
///   place r + R (s + sum_k phi_k q_k), turned by sum_k psi_k q_k against the body (small)
struct Attachment {
  static constexpr std::string_view doc = "A place on a body that moves with the modes of that "
                                          "body. Joints, forces and markers name it "
                                          "as a body.";
  std::string name;
  std::string body;
  Vector3 point = Vector3::Zero();
  std::vector<Vector3> displacement, rotation;

  template <class A = Attachment> static Fields<A> fields() {
    return {
        {"name", &A::name, "-", "Name of the attachment, and of the body that it is for others.",
         true},
        {"body", &A::body, "-", "Body that deforms.", true},
        {"point", &A::point, "m", "Where it is in the reference pose, world axes.", true},
        {"displacement", &A::displacement, "m/m",
         "Displacement of this point by each mode of the body: a vector of body axes for each "
         "mode, in their order in the case, per unit of amplitude.",
         true},
        {"rotation", &A::rotation, "rad/m",
         "Rotation there by each mode: a vector of body axes for each mode, per unit of "
         "amplitude; default: none."},
    };
  }
};

} // namespace hydrodae::model
