#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hydrodae/core/field.h"

namespace hydrodae::force {

/// Dry friction along the free motion of a joint (Coulomb), with located sticking and slipping.
///
///   stick:  s' = 0          while the load that holds it is at most `static`
///   slip:   f = -kinetic sign(s')      [N], or [N m] if the motion is a rotation
///
/// Its power is never positive.
struct DryFriction {
  static constexpr std::string_view type = "dry_friction";
  static constexpr std::string_view doc =
      "Coulomb friction along a joint, with located sticking and slipping.";
  std::string name;
  std::string joint;
  double static_load = 0.0;
  std::optional<double> kinetic_load;

  /// While it slips; the direction changes at events only. Zero while it sticks.
  struct Law {
    double load = 0.0; ///< on the coordinate [N or N m]
    template <class S> S apply(const S&, const S&) const { return S(load); }
    std::pair<double, double> gradient(double, double) const { return {0.0, 0.0}; }
    double potential(double) const { return 0.0; }
  };

  static Fields<DryFriction> fields() {
    using D = DryFriction;
    return {
        {"name", &D::name, "-", "Name of this force in the results.", true},
        {"joint", &D::joint, "-", "Joint with one free motion (revolute or prismatic).", true},
        {"static", &D::static_load, "N or N m", "Largest load that sticking holds.", true,
         more_than(0)},
        {"kinetic", &D::kinetic_load, "N or N m", "Load while slipping; default: as `static`.",
         false, at_least(0)},
    };
  }
};

} // namespace hydrodae::force
