#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"
#include "hydrodae/math/catenary.h"

namespace hydrodae::element {

/// Quasi-static elastic mooring line between an anchor (end A) and a fairlead (end B), of parts
/// with clump weights or buoys between them, on a flat seabed at the height of the anchor or free
/// of it: at each instant as if at rest (math/catenary.h). No inertia, no drag.
///
///   force on B = -(H e + V z),   e: horizontal, from A to B
struct CatenaryLine {
  static constexpr std::string_view type = "catenary";
  static constexpr std::string_view doc =
      "Quasi-static elastic mooring line of one or more parts, with seabed, clumps and buoys.";
  static constexpr Port port = Port::points;
  static constexpr int n_points = 2;
  static constexpr Work work = Work::lent;
  std::string name;
  std::string body_a = "ground", body_b;
  Vector3 point_a = Vector3::Zero(), point_b = Vector3::Zero();
  std::vector<double> length, weight, stiffness, loads;
  std::optional<double> pretension;
  bool seabed = true;
  double friction = 0.0;

  /// What the port joins, by the names of the bodies.
  std::array<std::pair<std::string, Vector3>, 2> ends() const {
    return {{{body_a, point_a}, {body_b, point_b}}};
  }

  /// The law that the system evaluates.
  struct Law {
    Catenary line;

    struct Found {
      CatenaryHold hold;
      Eigen::Vector2d e;
      double X, Z;
    };
    Found find(const double* x) const {
      const Vector3 d = Eigen::Map<const Vector3>(x + 3) - Eigen::Map<const Vector3>(x);
      const double X = std::hypot(d[0], d[1]);
      const Eigen::Vector2d e = X > 0.0 ? Eigen::Vector2d(d.head<2>() / X) : Eigen::Vector2d(1, 0);
      return {hydrodae::hold(line, X, d[2]), e, X, d[2]};
    }
    void loads(const Found& at, double* load) const {
      Eigen::Map<Vector6>(load) << at.hold.anchor_horizontal * at.e, at.hold.anchor_vertical,
          -at.hold.horizontal * at.e, -at.hold.vertical;
    }
    /// d (force on B) / d (place of B); that on A is its opposite, but for what the seabed takes.
    Matrix3 gradient(const Found& at) const {
      const Eigen::Matrix2d& K = at.hold.stiffness;
      Matrix3 out;
      out.topLeftCorner<2, 2>() =
          K(0, 0) * at.e * at.e.transpose() +
          at.hold.out_of_plane * (Eigen::Matrix2d::Identity() - at.e * at.e.transpose());
      out.topRightCorner<2, 1>() = K(0, 1) * at.e;
      out.bottomLeftCorner<1, 2>() = K(1, 0) * at.e.transpose();
      out(2, 2) = K(1, 1);
      return -out;
    }

    void operator()(const In<double>& in, const Out<double>& out) const {
      loads(find(in.x), out.load);
    }
    void operator()(const In<Dual>& in, const Out<Dual>& out) const {
      std::array<double, 6> x, load;
      for (int i = 0; i < 6; ++i)
        x[i] = in.x[i].a;
      const Found at = find(x.data());
      loads(at, load.data());
      const Matrix3 K = gradient(at);
      for (int i = 0; i < 3; ++i) {
        double change = 0.0;
        for (int k = 0; k < 3; ++k)
          change += K(i, k) * (in.x[3 + k].b - in.x[k].b);
        out.load[i] = Dual(load[i], -change);
        out.load[3 + i] = Dual(load[3 + i], change);
      }
    }
    template <class J> void jacobian(const In<double>& in, J& j) const {
      const Matrix3 K = gradient(find(in.x));
      j.setZero();
      j.template block<3, 3>(0, 0) = j.template block<3, 3>(3, 3) = K;
      j.template block<3, 3>(0, 3) = j.template block<3, 3>(3, 0) = -K;
    }

    double energy(const In<double>& in) const {
      const Found at = find(in.x);
      return hydrodae::energy(line, at.hold, at.X, at.Z);
    }
    void observe(const In<double>& in, const Out<const double>&, double* values) const {
      const Found at = find(in.x);
      values[0] = at.hold.tension();
      values[1] = std::hypot(at.hold.anchor_horizontal, at.hold.anchor_vertical);
      values[2] = at.hold.on_bed;
    }
  };

  Law law() const {
    Law out;
    for (std::size_t i = 0; i < length.size(); ++i)
      out.line.parts.push_back({length[i], weight[i], stiffness[i]});
    out.line.loads = loads;
    out.line.loads.resize(length.size() - 1, 0.0);
    out.line.bed = seabed;
    out.line.friction = friction;
    if (pretension)
      tighten(out);
    return out;
  }

  static std::vector<Quantity> channels() {
    return {{"tension", "N", "Tension at end B."},
            {"tension_anchor", "N", "Tension at end A."},
            {"length_on_seabed", "m", "Unstretched length that lies."}};
  }

  /// What is wrong with it, if anything.
  std::optional<Fault> fault() const {
    const auto numbers = [](const std::string& key) {
      return Fault{key, "a line needs as many numbers in '" + key + "' as parts in 'length'"};
    };
    if (length.empty())
      return Fault{"length", "a line needs at least one part"};
    if (weight.size() != length.size())
      return numbers("weight");
    if (stiffness.size() != length.size())
      return numbers("stiffness");
    if (!loads.empty() && loads.size() + 1 != length.size())
      return Fault{"loads", "'loads' hang between the parts: one number less than 'length'"};
    for (const double w : weight)
      if (w == 0.0)
        return Fault{"weight", "a line without weight is a rope: use type 'rope'"};
    const Vector3 d = point_b - point_a;
    if (!seabed)
      return {};
    if (body_a != "ground")
      return Fault{"seabed", "the seabed is at the height of end A, so that must be on the ground; "
                             "write seabed = false for a line that hangs between two bodies"};
    for (const double w : weight)
      if (w < 0.0)
        return Fault{"weight",
                     "a buoyant part cannot be on the seabed; write seabed = false if the "
                     "line does not touch it"};
    if (point_b[2] < point_a[2])
      return Fault{"point_b", "end B is below the seabed, which is at the height of end A"};
    if (std::isnan(hydrodae::hold(law().line, std::hypot(d[0], d[1]), d[2]).vertical))
      return Fault{"loads", "in the reference pose a buoy between the parts is down on the seabed, "
                            "which this type does not know; make it hold the line up, or leave it "
                            "out"};
    return {};
  }

  static Fields<CatenaryLine> fields() {
    using C = CatenaryLine;
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
        {"pretension", &C::pretension, "N",
         "Tension at B in the reference pose; the length of the first part follows from it.", false,
         more_than(0)},
        {"seabed", &C::seabed, "-", "Whether a flat seabed at the height of A carries the line."},
        {"friction", &C::friction, "-", "Friction coefficient of the seabed.", false, at_least(0)},
    };
  }

private:
  /// The first part gets the length by which the tension is the one that was asked for: it falls as
  /// the line gets longer.
  void tighten(Law& law) const {
    const Vector3 d = point_b - point_a;
    const double X = std::hypot(d[0], d[1]);
    double low = 1e-6 * length[0], high = length[0] + d.norm();
    const auto tension = [&](double first) {
      law.line.parts[0].length = first;
      return hydrodae::hold(law.line, X, d[2]).tension();
    };
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (tension(middle) > *pretension ? low : high) = middle;
    }
    law.line.parts[0].length = 0.5 * (low + high);
  }
};

} // namespace hydrodae::element
