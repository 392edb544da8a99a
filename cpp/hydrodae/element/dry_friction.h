#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Dry friction along the free motion of a joint (Coulomb), with located sticking and slipping.
///
///   stick:  s' = 0          while the load that holds it is at most `static`
///   slip:   f = -kinetic sign(s')      [N], or [N m] if the motion is a rotation
///
/// Its power is never positive.
struct DryFriction {
  static constexpr std::string_view type = "dry_friction";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_signals = 1;
  static constexpr std::string_view doc =
      "Coulomb friction along a joint, with located sticking and slipping.";
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double static_load = 0.0;
  std::optional<double> kinetic_load;

  /// While it slips its load is the signal, which changes at events only; zero while it sticks.
  struct Law {
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      *out.load = S(*in.signals);
    }
    template <class J> void jacobian(const In<double>&, J& j) const { j.setZero(); }
    bool lost_at_rest() const { return true; }
  };
  Law law() const { return {}; }

  /// What is wrong with it, if anything.
  std::optional<Fault> fault() const {
    if (kinetic_load && *kinetic_load > static_load)
      return Fault{"kinetic", "the kinetic friction must not be above the static one"};
    return {};
  }

  template <class D = DryFriction> static Fields<D> fields() {
    return {
        {"name", &D::name, "-", "Name of this force in the results.", true},
        {"joint", &D::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &D::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"static", &D::static_load, "N or N m", "Largest load that sticking holds.", true,
         more_than(0)},
        {"kinetic", &D::kinetic_load, "N or N m", "Load while slipping; default: as `static`.",
         false, at_least(0)},
    };
  }
};

} // namespace hydrodae::element
