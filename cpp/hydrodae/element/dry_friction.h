#pragma once
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "hydrodae/element/friction_loads.h"

namespace hydrodae::element {

/// Dry friction along the free motion of a joint (Coulomb), with located sticking and slipping.
///
///   stick:  s' = 0          while the reaction is at most F_s
///   slip:   f = -F_c sign(s')      [N], or [N m] if the motion is a rotation
///
/// Its power is never positive. F_s and F_c are given, or coefficients times N of a Bearing.
struct DryFriction : FrictionLoads {
  static constexpr std::string_view type = "dry_friction";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_signals = 1;
  static constexpr std::string_view doc =
      "Coulomb friction along a joint, with located sticking and slipping.";

  /// Law while slipping: the load is the signal, which changes only at events; zero while sticking.
  struct Law {
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      *out.load = S(*in.signals);
    }
    template <class J> void jacobian(const In<double>&, J& j) const { j.setZero(); }
    bool lost_at_rest() const { return true; }
  };
  Law law() const { return {}; }

  /// Law with a bearing: the signal is a coefficient.
  struct PressedLaw {
    Bearing bearing;
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      *out.load = S(*in.signals) * bearing.load(in.r);
    }
    void observe(const In<double>& in, const Out<const double>& out, double* values) const {
      values[0] = *out.load * *in.v;
      values[1] = bearing.across(in.r);
    }
    bool lost_at_rest() const { return true; }
  };
  PressedLaw pressed_law() const { return {bearing()}; }

  Stick sticks() const { return {stick(), slip()}; }

  static std::shared_ptr<const Elements> list(const std::vector<DryFriction>& forces) {
    return friction_list(forces);
  }

  template <class D = DryFriction> static Fields<D> fields() {
    return FrictionLoads::fields<D>(at_least(0));
  }
};

} // namespace hydrodae::element
