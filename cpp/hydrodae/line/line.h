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
#include "hydrodae/element/surroundings.h"

namespace hydrodae::line {

/// Dynamic mooring line: lumped masses at the ends of elastic segments, with weight, buoyancy, drag
/// and inertia of the water, bending, and a seabed (equations in line_model.h). It has one or
/// more parts, with clumps and buoys between segments.
struct Line {
  static constexpr std::string_view type = "line";
  static constexpr std::string_view doc =
      "Dynamic mooring line: masses on elastic segments in the water, with a seabed.";
  static constexpr element::Port port = element::Port::points;
  std::string name;
  std::string body_a = "ground", body_b = "ground";
  Vector3 point_a = Vector3::Zero(), point_b = Vector3::Zero();
  bool free_end = false;
  std::vector<double> length, segments, mass, diameter, stiffness;
  std::vector<double> curve_strain, curve_tension, curve_parts;
  std::vector<double> damping, damping_ratio, bending_stiffness;
  std::vector<double> drag, drag_axial, added_mass, added_mass_axial, breaking_load,
      contact_diameter;
  std::optional<double> pretension;
  std::vector<double> attachment_at, attachment_mass, attachment_volume, attachment_drag_area,
      attachment_added_mass;
  bool breaks = false;
  bool damps_slack = false, seabed_damps_up = false;
  bool seabed = true;
  std::optional<double> seabed_depth, seabed_stiffness, water_density;
  double seabed_damping = 0.0, seabed_friction = 0.0;
  bool waves = true;

  /// Ends of the port, by the names of the bodies.
  std::vector<std::pair<std::string, Vector3>> ends() const {
    std::vector<std::pair<std::string, Vector3>> out = {{body_a, point_a}};
    if (!free_end)
      out.emplace_back(body_b, point_b);
    return out;
  }

  int n_segments() const;
  /// Value of part `part`; a list has one entry for all parts or one for each.
  static double of_part(const std::vector<double>& values, std::size_t part, double otherwise = 0);

  /// Returns whether the curve is that of part `part`, counted from 0.
  bool has_curve(std::size_t part) const;
  /// EA of part `part` [N]; of the curve the secant at its last point.
  double stiffness_of(std::size_t part) const;

  /// Index of the list: lines in one list have the same number of segments and kinds of entries,
  /// and all break or none does.
  std::size_t shape() const;

  static std::shared_ptr<const element::Elements> list(const std::vector<Line>& lines,
                                                       const element::Surroundings& around);

  /// Fault in the parameters, alone or with the surroundings; or nothing.
  std::optional<Fault> fault() const;
  std::optional<Fault> fault(const element::Surroundings& around) const;

  static Fields<Line> fields();
};

} // namespace hydrodae::line
