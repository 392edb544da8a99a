#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"
#include "hydrodae/math/catenary.h"

namespace hydrodae::line {

/// Quasi-static elastic mooring line between an anchor (end A) and a fairlead (end B): parts with
/// clump weights or buoys between them. At each instant it is at rest, on a flat seabed at the
/// height of the anchor or free of it (math/catenary.h), without inertia and drag. Parts above z =
/// 0 have their dry weight; if that is unknown, the weight in water, or zero for floating parts.
///
///   force on B = -(H e + V z),   e: horizontal, from A to B
struct CatenaryLine {
  static constexpr std::string_view type = "catenary";
  static constexpr std::string_view doc =
      "Quasi-static elastic mooring line of one or more parts, with seabed, clumps and buoys.";
  static constexpr element::Port port = element::Port::points;
  static constexpr int n_points = 2;
  static constexpr element::Work work = element::Work::lent;
  std::string name;
  std::string body_a = "ground", body_b;
  Vector3 point_a = Vector3::Zero(), point_b = Vector3::Zero();
  std::vector<double> length, weight, stiffness, loads, dry_weight, dry_loads;
  double stiffness_of(std::size_t part) const { return stiffness[part]; } ///< EA [N]
  std::optional<double> pretension;
  bool seabed = true;
  double friction = 0.0;
  std::vector<double> breaking_load;
  bool breaks = false;
  double surface = 0.0; ///< height of the surface [m]; not a key

  /// Ends of the port, by the names of the bodies.
  std::array<std::pair<std::string, Vector3>, 2> ends() const {
    return {{{body_a, point_a}, {body_b, point_b}}};
  }

  /// Law with derived numbers.
  struct Law {
    Catenary line;
    double surface = 0.0;

    double above(const double* x) const { return x[5] - surface; }
    void operator()(const element::In<double>& in, const element::Out<double>& out) const;
    void operator()(const element::In<Dual>& in, const element::Out<Dual>& out) const;
    template <class J> void jacobian(const element::In<double>& in, J& j) const {
      j.setZero();
      j.template topLeftCorner<6, 6>() = gradient(in.x);
    }
    /// Derivatives of the forces on A and B by the places of A and B, without the load that the
    /// seabed takes at A.
    Matrix6 gradient(const double* x) const;
    double energy(const element::In<double>& in) const;
    void observe(const element::In<double>& in, const element::Out<const double>& out,
                 double* values) const;
  };

  Law law() const;

  /// Index of the list: in one list all lines have breaking loads, or all break, or none does.
  std::size_t shape() const { return breaks ? 2 : breaking_load.empty() ? 0 : 1; }
  static std::shared_ptr<const element::Elements> list(const std::vector<CatenaryLine>& lines);

  static std::vector<element::Quantity> channels() {
    return {{"tension", "N", "Tension at end B."},
            {"tension_anchor", "N", "Tension at end A."},
            {"length_on_seabed", "m", "Unstretched length that lies."}};
  }

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const;

  template <class C = CatenaryLine> static Fields<C> fields() {
    return {
        {"name", &C::name, "-", "Name of this force in the results.", true},
        {"body_a", &C::body_a, "-", "Body of end A, or ground: the anchor."},
        {"body_b", &C::body_b, "-", "Body of end B: the fairlead.", true},
        {"point_a", &C::point_a, "m", "End A in the reference pose, world axes.", true},
        {"point_b", &C::point_b, "m", "End B in the reference pose, world axes.", true},
        {"length", &C::length, "m", "Unstretched lengths of the parts, from A to B.", true,
         more_than(0)},
        {"weight", &C::weight, "N/m", "Weights in water per unstretched length of the parts.",
         true},
        {"stiffness", &C::stiffness, "N", "Axial stiffnesses EA of the parts.", true, more_than(0)},
        {"loads", &C::loads, "N",
         "Weights in water of what hangs between the parts: clumps; negative: buoys."},
        {"dry_weight", &C::dry_weight, "N/m",
         "Weights out of the water per unstretched length of the parts. Default: as in water, zero "
         "where they float.",
         false, at_least(0)},
        {"dry_loads", &C::dry_loads, "N",
         "Weights out of the water of what hangs between the parts, spheres at the surface. "
         "Default: as in water, zero where they float."},
        {"pretension", &C::pretension, "N",
         "Tension at B in the reference pose; the length of the first part follows from it.", false,
         more_than(0)},
        {"seabed", &C::seabed, "-", "Whether a flat seabed at the height of A carries the line."},
        {"friction", &C::friction, "-", "Friction coefficient of the seabed.", false, at_least(0)},
        {"breaking_load", &C::breaking_load, "N",
         "Tensions that the parts bear, one number or one each; the summary reports where they are "
         "exceeded.",
         false, more_than(0)},
        {"breaks", &C::breaks, "-",
         "Whether it parts for good where its tension reaches `breaking_load`."},
    };
  }
};

} // namespace hydrodae::line
