#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::line {

/// Elastic rope without mass, straight between points of bodies or of the ground, over which it
/// runs without friction: one tension in all parts.
///
///   T = max(0, EA (l - L0) + D (l' - L0')) / L0     where l > L0, else 0 [N]
///   force on point i = T (e_i - e_(i-1)),  e_i: direction from point i to point i + 1
///
/// l: sum of the distances [m]. A winch that changes L0 gives the power -T L0'. For sheaves see
/// rope_path.h, for friction rope_capstan.h.
struct Rope {
  static constexpr std::string_view type = "rope";
  static constexpr std::string_view doc = "Elastic rope without mass over points and sheaves of "
                                          "bodies, which pulls only; with a winch if wanted.";
  static constexpr element::Port port = element::Port::points;
  static constexpr std::size_t most_points = 100, most_with_sheaves = 20;
  std::string name;
  std::vector<std::string> bodies;
  std::vector<Vector3> points;
  double stiffness = 0.0;
  double damping = 0.0;
  std::optional<double> length, pretension;
  std::vector<double> winch_time, winch_length;
  std::vector<double> radii; ///< radius at each point; empty: zeros
  std::vector<Vector3> axes;
  /// Friction coefficient of each point, or one for all between the ends
  std::vector<double> friction;
  std::optional<double> breaking_load;
  bool breaks = false;

  bool has_sheave(std::size_t point) const { return !radii.empty() && radii[point] > 0.0; }
  bool is_plain() const; ///< true without sheaves
  double friction_at(std::size_t point) const;
  bool has_friction() const; ///< true if any point has friction

  /// Points of the port, by the names of the bodies: the points of the rope, then for each sheave
  /// one at its radius along its axis, then for each sheave with friction one at its radius across.
  std::vector<std::pair<std::string, Vector3>> ends() const;

  /// Length along its points and sheaves in the reference pose [m].
  double distance() const;
  /// Unstretched length without the change by a winch [m].
  double free_length() const;
  /// Returns whether two successive points coincide in the reference pose.
  bool has_point_twice() const;

  /// Index of the list: ropes in one list have equal numbers of points, sheaves and places with
  /// friction. All have breaking loads, or all break, or none does.
  std::size_t shape() const;

  static std::shared_ptr<const element::Elements> list(const std::vector<Rope>& ropes);

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const;

  template <class R = Rope> static Fields<R> fields() {
    return {
        {"name", &R::name, "-", "Name of this force in the results.", true},
        {"bodies", &R::bodies, "-", "Bodies, or ground, that the points belong to, one each.",
         true},
        {"points", &R::points, "m",
         "Points along the rope in the reference pose, world axes; it runs freely over those "
         "between the ends.",
         true},
        {"stiffness", &R::stiffness, "N", "Axial stiffness EA.", true, more_than(0)},
        {"damping", &R::damping, "N s", "Axial damping D.", false, at_least(0)},
        {"length", &R::length, "m",
         "Unstretched length L0; default: the rope is just straight in the reference pose.", false,
         more_than(0)},
        {"pretension", &R::pretension, "N", "Tension in the reference pose, in place of `length`.",
         false, more_than(0)},
        {"winch_time", &R::winch_time, "s", "Times, ascending, of `winch_length`."},
        {"winch_length", &R::winch_length, "m", "Unstretched lengths at these times.", false,
         more_than(0)},
        {"radii", &R::radii, "m",
         "Radii of the sheaves, one for each point, which is the centre; 0: a point, as the ends.",
         false, at_least(0)},
        {"axes", &R::axes, "-",
         "Axes of the sheaves, one for each point (any value for a point without a sheave), world "
         "axes: from first to last point the rope runs round them by the right-hand rule."},
        {"friction", &R::friction, "-",
         "Coefficients of friction of the points and sheaves, one for each point (0 at the ends), "
         "or one for all between the ends; a sheave with friction does not turn on its body.",
         false, at_least(0)},
        {"breaking_load", &R::breaking_load, "N",
         "Tension that it bears; the summary reports where it is exceeded.", false, more_than(0)},
        {"breaks", &R::breaks, "-",
         "Whether it parts for good where its tension reaches `breaking_load`."},
    };
  }
};

} // namespace hydrodae::line
