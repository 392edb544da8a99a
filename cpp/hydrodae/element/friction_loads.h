#pragma once
/// Common part of friction laws along a joint: loads of sticking and slipping, given directly or as
/// coefficients of the load on the joint's bearing.

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/laws.h"

namespace hydrodae::element {

/// Two bearings on the axis of a joint, half of `length` before and behind the point of body B,
/// which share the reaction (F, M) on B [N, N m], z along the axis:
///
///   F_1,2 = (F_x, F_y) / 2 +- (M_y, -M_x) / length        on the bearings, across the axis
///   N = preload + |F_1| + |F_2| (+ |M_z| / radius)        on a displacement [N]
///   N = radius (preload + |F_1| + |F_2|) + radius_axial |F_z|        on an angle [N m]
///
/// |x| = sqrt(x.x + small^2) on the bearings and sqrt(x^2 + small^2) - small for single loads:
/// smooth at zero load. A radius or length of zero: the joint takes no such moment.
struct Bearing {
  bool turns = false;
  double preload = 0.0, length = 0.0, radius = 0.0, radius_axial = 0.0, small = 0.0;
  double slip = 0.0; ///< coefficient of slip

  template <class S> S size(const S& x, const S& y) const {
    using std::sqrt;
    return sqrt(x * x + y * y + S(small * small));
  }

  /// Smooth absolute value of a single load, zero at zero.
  template <class S> S single(const S& x) const { return size<S>(x, S(0)) - S(small); }

  /// Preload and forces across the axis on both bearings [N]. @param r  (6,) reaction on B
  template <class S> S across(const S* r) const {
    const S x = S(0.5) * r[0], y = S(0.5) * r[1];
    const S per_length = S(length > 0.0 ? 1.0 / length : 0.0);
    const S a = per_length * r[4], b = -per_length * r[3];
    return S(preload) + size<S>(x + a, y + b) + size<S>(x - a, y - b);
  }

  /// Normal load N, which friction coefficients multiply [N, N m].
  template <class S> S load(const S* r) const {
    S sum = turns ? S(radius) * across(r) : across(r);
    if (turns && radius_axial > 0.0)
      sum += S(radius_axial) * single<S>(r[2]);
    if (!turns && radius > 0.0)
      sum += single<S>(r[5] / S(radius));
    return sum;
  }
};

struct FrictionLoads {
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  std::optional<double> static_load, kinetic_load;
  std::optional<double> static_coefficient, kinetic_coefficient;
  double preload = 0.0;
  std::optional<double> length, radius, radius_axial, small_force;

  // From the scene:
  bool turns = false;  ///< the coordinate is an angle
  double weight = 0.0; ///< weight of the lighter moving body [N]

  /// Returns whether friction depends on the joint reaction.
  bool pressed() const { return static_coefficient.has_value(); }
  std::size_t shape() const { return pressed() ? 1 : 0; } ///< index of its list

  /// Load of sticking, or its coefficient.
  double stick() const { return static_coefficient.value_or(static_load.value_or(0.0)); }
  double slip() const {
    return pressed() ? kinetic_coefficient.value_or(stick()) : kinetic_load.value_or(stick());
  }

  Bearing bearing() const {
    constexpr double little = 1e-5; // part of the weight
    return {turns,
            preload,
            length.value_or(0.0),
            radius.value_or(0.0),
            radius_axial.value_or(0.0),
            small_force.value_or(little * weight),
            slip()};
  }

  /// Typical load of sticking in the scene [N or N m].
  double usual_load() const {
    const double lever = turns ? radius.value_or(1.0) : 1.0;
    return pressed() ? stick() * lever * (preload + weight) : stick();
  }

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const {
    if (pressed() == static_load.has_value())
      return Fault{"static", "write either 'static', the load itself, or 'static_coefficient', "
                             "which the reaction of the joint is multiplied by"};
    if (pressed() && kinetic_load)
      return Fault{"kinetic", "write 'kinetic_coefficient', as 'static_coefficient' is given"};
    if (!pressed() &&
        (kinetic_coefficient || preload > 0.0 || length || radius || radius_axial || small_force))
      return Fault{"static_coefficient", "'kinetic_coefficient', 'preload', 'length', 'radius', "
                                         "'radius_axial' and 'small_force' go with "
                                         "'static_coefficient'"};
    if (slip() > stick())
      return Fault{pressed() ? "kinetic_coefficient" : "kinetic",
                   "the kinetic friction must not be above the static one"};
    return {};
  }

  /// @param kinetic  range of the load and the coefficient of slip
  template <class F> static Fields<F> fields(Range kinetic) {
    return {
        {"name", &F::name, "-", "Name of this force in the results.", true},
        {"joint", &F::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &F::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"static", &F::static_load, "N or N m",
         "Largest load F_s of sticking, without the viscous part; or `static_coefficient`.", false,
         more_than(0)},
        {"kinetic", &F::kinetic_load, "N or N m",
         "Load F_c of slip, without the viscous part; default: as `static`.", false, kinetic},
        {"static_coefficient", &F::static_coefficient, "-",
         "In place of `static`: F_s over what the reaction of the joint presses with.", false,
         more_than(0)},
        {"kinetic_coefficient", &F::kinetic_coefficient, "-",
         "In place of `kinetic`: F_c over the same; default: as `static_coefficient`.", false,
         kinetic},
        {"preload", &F::preload, "N", "Force by which the bearing is pressed beside the reaction.",
         false, at_least(0)},
        {"length", &F::length, "m",
         "Distance along the axis of the two bearings, about the joint's point on body B, which "
         "share the moment across the axis.",
         false, more_than(0)},
        {"radius", &F::radius, "m",
         "Of an angle: at which the bearing rubs. Of a displacement: at which it holds the moment "
         "about the axis.",
         false, more_than(0)},
        {"radius_axial", &F::radius_axial, "m",
         "Of an angle: at which the thrust along the axis rubs; 0: it does not.", false,
         at_least(0)},
        {"small_force", &F::small_force, "N",
         "Smallest size of the force on a bearing, so that friction stays smooth at zero; default: "
         "1e-5 of the weight of the lighter body that moves.",
         false, more_than(0)},
    };
  }
};

inline constexpr Quantity friction_power{
    "power", "W", "Load times rate: what it gives to the motion, negative where it takes."};

/// Friction F with a bearing, in the form that laws.h needs.
template <class F> struct Pressed : F {
  static constexpr int n_reaction = 6;
  explicit Pressed(const F& force) : F(force) {}
  auto law() const { return F::pressed_law(); }
  static std::vector<Quantity> channels() {
    return {friction_power,
            {"normal_force", "N",
             "What presses across the axis: preload, and sizes of the forces on both bearings."}};
  }
};

template <class F> std::shared_ptr<const Elements> friction_list(const std::vector<F>& forces) {
  if (!forces.front().pressed())
    return std::make_shared<const Laws<F>>(forces);
  return std::make_shared<const Laws<Pressed<F>>>(
      std::vector<Pressed<F>>(forces.begin(), forces.end()));
}

/// Steady friction as a function of slip rate, g = F_c + (F_s - F_c) exp(-(s' / s'_s)^2), and
/// viscous damping.
struct SteadyFriction {
  double stick, slip, rate, viscous;

  template <class S> S dry(const S& v) const {
    using std::exp;
    const S x = v / S(rate);
    return S(slip) + S(stick - slip) * exp(-(x * x));
  }
};

} // namespace hydrodae::element
