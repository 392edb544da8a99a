#pragma once
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::element {

/// Constant force at the centre of gravity and constant moment, both in world axes.
struct ConstantLoad {
  static constexpr std::string_view type = "constant_load";
  static constexpr Port port = Port::on_body;
  static constexpr std::string_view doc =
      "Constant force at the centre of gravity and constant moment, world axes.";
  std::string name;
  std::string body;
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();

  /// The law that the system evaluates.
  LinearWrench law() const {
    LinearWrench w;
    w.constant << force, moment;
    return w;
  }

  static Fields<ConstantLoad> fields() {
    using C = ConstantLoad;
    return {
        {"name", &C::name, "-", "Name of this force in the results.", true},
        {"body", &C::body, "-", "Body that is loaded.", true},
        {"force", &C::force, "N", "Force at the centre of gravity, world axes."},
        {"moment", &C::moment, "N m", "Moment, world axes."},
    };
  }
};

} // namespace hydrodae::element
