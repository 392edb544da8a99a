#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Quadratic damper along the free motion of a joint, as an orifice in a cylinder.
///
///   f = -c |s'| s'     [N], or [N m] if the motion is a rotation
struct PtoQuadratic {
  static constexpr std::string_view type = "pto_quadratic";
  static constexpr std::string_view doc = "Quadratic damper along a joint: f = -c |s'| s'.";
  static constexpr Port port = Port::along_joint; // sees s and s', acts along s
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double damping = 0.0;

  const PtoQuadratic& law() const { return *this; }

  template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
    using std::abs;
    *out.load = -S(damping) * abs(*in.v) * *in.v;
  }

  /// A channel of the results, forces/NAME/throttled_power.
  static std::vector<Quantity> channels() {
    return {{"throttled_power", "W", "Power lost in the orifice, -f s'."}};
  }
  void observe(const In<double>& in, const Out<const double>& out, double* values) const {
    values[0] = -*out.load * *in.v;
  }

  template <class P = PtoQuadratic> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of this force in the results.", true},
        {"joint", &P::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"damping", &P::damping, "N s2/m2 or N m s2/rad2", "Damping c.", true, at_least(0)},
    };
  }
};

} // namespace hydrodae::element
