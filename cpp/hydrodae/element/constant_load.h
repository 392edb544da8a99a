#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Constant force at the centre of gravity and constant moment, both in world axes.
struct ConstantLoad {
  static constexpr std::string_view type = "constant_load";
  static constexpr Port port = Port::on_body;
  static constexpr Work work = Work::lent;
  static constexpr int n_signals = 6;
  static constexpr std::string_view doc =
      "Constant force at the centre of gravity and constant moment, world axes.";
  std::string name;
  std::string body;
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();

  /// Law whose load equals its signals; its work is that of a potential.
  struct Law {
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      std::copy(in.signals, in.signals + 6, out.load);
    }
    template <class J> void jacobian(const In<double>&, J& j) const { j.setZero(); }
    double energy(const In<double>& in) const {
      return -Eigen::Map<const Vector6>(in.signals).dot(Eigen::Map<const Vector6>(in.x));
    }
  };
  Law law() const { return {}; }

  /// Inputs that a program may change during the run.
  static std::vector<Signal> inputs() {
    return {{"force.x", "N"},    {"force.y", "N"},    {"force.z", "N"},
            {"moment.x", "N m"}, {"moment.y", "N m"}, {"moment.z", "N m"}};
  }
  std::array<double, n_signals> start_signals() const {
    return {force[0], force[1], force[2], moment[0], moment[1], moment[2]};
  }

  template <class C = ConstantLoad> static Fields<C> fields() {
    return {
        {"name", &C::name, "-", "Name of this force in the results.", true},
        {"body", &C::body, "-", "Body that is loaded.", true},
        {"force", &C::force, "N", "Force at the centre of gravity, world axes."},
        {"moment", &C::moment, "N m", "Moment, world axes."},
    };
  }
};

} // namespace hydrodae::element
