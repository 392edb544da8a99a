#include "hydrodae/line/line.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/core/text.h"
#include "hydrodae/math/curve.h"

namespace hydrodae::line {

double Line::of_part(const std::vector<double>& values, std::size_t part, double otherwise) {
  return values.empty() ? otherwise : values[values.size() == 1 ? 0 : part];
}

bool Line::has_curve(std::size_t part) const {
  return !curve_strain.empty() &&
         (curve_parts.empty() || std::find(curve_parts.begin(), curve_parts.end(),
                                           static_cast<double>(part + 1)) != curve_parts.end());
}

double Line::stiffness_of(std::size_t part) const {
  return has_curve(part) ? curve_tension.back() / curve_strain.back() : of_part(stiffness, part);
}

int Line::n_segments() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < length.size(); ++i)
    sum += of_part(segments, i, 20.0);
  return static_cast<int>(sum);
}

std::size_t Line::shape() const {
  const bool bends = std::any_of(bending_stiffness.begin(), bending_stiffness.end(),
                                 [](double EI) { return EI > 0.0; });
  return 8 * static_cast<std::size_t>(n_segments()) + (breaks ? 4 : 0) + (bends ? 2 : 0) +
         (free_end ? 1 : 0);
}

namespace {

/// Checks the curve, and that each part has either a stiffness or the curve.
std::optional<Fault> fault_of_curve(const Line& of) {
  if (const std::string_view wrong = Curve::fault(of.curve_strain, of.curve_tension);
      !wrong.empty())
    return Fault{"curve_strain", "'curve_strain' " + std::string(wrong) + " 'curve_tension'"};
  const std::vector<double>& T = of.curve_tension;
  if (!T.empty() && (of.curve_strain[0] != 0.0 || T[0] != 0.0))
    return Fault{"curve_strain", "the curve begins at strain 0 and tension 0"};
  for (std::size_t i = 1; i < T.size(); ++i)
    if (!(T[i] > T[i - 1]))
      return Fault{"curve_tension",
                   "'curve_tension' must ascend: a line that stretches pulls more"};
  if (T.empty() && !of.curve_parts.empty())
    return Fault{"curve_parts", "parts of which curve? Write 'curve_strain' and 'curve_tension'"};
  for (const double part : of.curve_parts)
    if (!(part >= 1.0 && part <= static_cast<double>(of.length.size()) && part == std::floor(part)))
      return Fault{"curve_parts", "there is no part " + number_text(part) + "; parts count from 1"};
  bool all = true;
  for (std::size_t i = 0; i < of.length.size(); ++i) {
    const bool curved = of.has_curve(i), several = of.stiffness.size() > 1;
    all = all && curved;
    if (!curved && !(Line::of_part(of.stiffness, i) > 0.0))
      return Fault{"stiffness", "part " + std::to_string(i + 1) +
                                    " needs a stiffness above 0, or the curve ('curve_parts')"};
    if (curved && several && of.stiffness[i] != 0.0)
      return Fault{"stiffness",
                   "part " + std::to_string(i + 1) + " has a curve: write 0 as its stiffness"};
  }
  if (all && !of.stiffness.empty())
    return Fault{"stiffness", "the curve gives the tension of all parts: leave out 'stiffness'"};
  return {};
}

/// Checks lists with one number, or one for each part, or none.
std::optional<Fault> fault_of_parts(const Line& of) {
  const std::vector<std::pair<std::string, const std::vector<double>*>> all = {
      {"segments", &of.segments},
      {"mass", &of.mass},
      {"diameter", &of.diameter},
      {"stiffness", &of.stiffness},
      {"damping", &of.damping},
      {"damping_ratio", &of.damping_ratio},
      {"bending_stiffness", &of.bending_stiffness},
      {"drag", &of.drag},
      {"drag_axial", &of.drag_axial},
      {"added_mass", &of.added_mass},
      {"added_mass_axial", &of.added_mass_axial},
      {"breaking_load", &of.breaking_load},
      {"contact_diameter", &of.contact_diameter}};
  if (of.length.empty())
    return Fault{"length", "a line needs at least one part"};
  for (const auto& [key, values] : all)
    if (values->size() > 1 && values->size() != of.length.size())
      return Fault{key, "'" + key + "' takes one number, or as many as parts in 'length'"};
  if (of.mass.empty())
    return Fault{"mass", "a line needs one number at least"};
  if (std::optional<Fault> wrong = fault_of_curve(of))
    return wrong;
  for (const double n : of.segments)
    if (n != std::floor(n))
      return Fault{"segments", "a part has a whole number of segments"};
  if (!of.damping.empty() && !of.damping_ratio.empty())
    return Fault{"damping_ratio", "write either 'damping' or 'damping_ratio'"};
  if (of.n_segments() < 2)
    return Fault{"segments", "a line needs two segments at least: a single one is a rope"};
  if (of.n_segments() > 5000)
    return Fault{"segments", "a line takes 5000 segments at most"};
  return {};
}

std::optional<Fault> fault_of_attachments(const Line& of) {
  const std::vector<std::pair<std::string, const std::vector<double>*>> all = {
      {"attachment_mass", &of.attachment_mass},
      {"attachment_volume", &of.attachment_volume},
      {"attachment_drag_area", &of.attachment_drag_area},
      {"attachment_added_mass", &of.attachment_added_mass}};
  for (const auto& [key, values] : all)
    if (!values->empty() && values->size() != of.attachment_at.size())
      return Fault{key, "as many numbers are needed as in 'attachment_at'"};
  for (const double s : of.attachment_at) {
    double from = 0.0, nearest = INFINITY;
    for (std::size_t i = 0; i < of.length.size(); ++i) {
      const double l = of.length[i] / Line::of_part(of.segments, i, 20.0);
      const double k = std::clamp(std::round((s - from) / l), 0.0, of.length[i] / l);
      if (std::abs(from + k * l - s) < std::abs(nearest - s))
        nearest = from + k * l;
      from += of.length[i];
    }
    if (std::abs(nearest - s) > 1e-6 * from)
      return Fault{"attachment_at", "attachments are between segments: nothing ends at " +
                                        number_text(s) + " m; the nearest end is at " +
                                        number_text(nearest) + " m"};
    if (!of.free_end && s > (1.0 - 1e-6) * from)
      return Fault{"attachment_at", "what hangs at an end belongs to its body"};
    if (s < 1e-6 * from)
      return Fault{"attachment_at", "what hangs at an end belongs to its body"};
  }
  return {};
}

} // namespace

std::optional<Fault> Line::fault() const {
  if (std::optional<Fault> wrong = fault_of_parts(*this))
    return wrong;
  if (std::optional<Fault> wrong = fault_of_attachments(*this))
    return wrong;
  if (breaks && breaking_load.empty())
    return Fault{"breaks", "a line that breaks needs its 'breaking_load'"};
  if (free_end && pretension)
    return Fault{"pretension", "a line with a free end has no pretension"};
  return {};
}

std::optional<Fault> Line::fault(const element::Surroundings& around) const {
  const auto needs_water = [](const std::vector<double>& of) {
    return std::any_of(of.begin(), of.end(), [](double x) { return x > 0.0; });
  };
  if (water_density.value_or(around.density) == 0.0 &&
      (needs_water(diameter) || needs_water(attachment_volume)))
    return Fault{"diameter", "a line with a volume needs the density of the water: water_density "
                             "[kg/m3] of the line or in [environment], or a hydrodynamic database"};
  if (seabed && seabed_depth && around.seabed)
    return Fault{"seabed_depth", "the case has a [seabed] with depths of its own: leave one out"};
  if (seabed && seabed_depth && *seabed_depth > 1.001 * around.water.depth)
    return Fault{"seabed_depth",
                 "the water is only " + number_text(around.water.depth) + " m deep"};
  const auto all = ends();
  for (std::size_t k = 0; k < all.size() && seabed; ++k) {
    const Vector3& point = all[k].second;
    const double bed = around.seabed ? around.seabed->at(point[0], point[1]).value
                                     : -seabed_depth.value_or(around.water.depth);
    if (point[2] < bed - 1e-3 * std::abs(bed))
      return Fault{k == 0 ? "point_a" : "point_b",
                   "this end is below the seabed, which is at z = " + number_text(bed) + " m"};
  }
  return {};
}

Fields<Line> Line::fields() {
  using L = Line;
  return {
      {"name", &L::name, "-", "Name of this force in the results.", true},
      {"body_a", &L::body_a, "-", "Body of end A, or ground."},
      {"body_b", &L::body_b, "-", "Body of end B, or ground."},
      {"point_a", &L::point_a, "m", "End A in the reference pose, world axes.", true},
      {"point_b", &L::point_b, "m",
       "End B in the reference pose, world axes; of a free end: towards where it lies on the "
       "seabed."},
      {"free_end", &L::free_end, "-", "Whether end B is free."},
      {"length", &L::length, "m", "Unstretched lengths of the parts, from A to B.", true,
       more_than(0)},
      {"segments", &L::segments, "-", "Segments of each part; 20 by default.", false,
       between(1, 5000)},
      {"mass", &L::mass, "kg/m", "Masses per unstretched length, dry.", true, more_than(0)},
      {"diameter", &L::diameter, "m",
       "Diameters D of cylinders of the same volume; 0, the default: no buoyancy, no drag and no "
       "added mass.",
       false, at_least(0)},
      {"stiffness", &L::stiffness, "N",
       "Axial stiffnesses EA of the parts; 0 for a part with the curve.", false, at_least(0)},
      {"curve_strain", &L::curve_strain, "-",
       "In place of `stiffness`: strains, ascending from 0, of `curve_tension`.", false,
       at_least(0)},
      {"curve_tension", &L::curve_tension, "N",
       "Tensions at these strains, ascending from 0; between them a smooth ascending curve, beyond "
       "the last one straight on.",
       false, at_least(0)},
      {"curve_parts", &L::curve_parts, "-", "Parts with the curve, counted from 1; default: all.",
       false, at_least(1)},
      {"damping", &L::damping, "N s", "Axial dampings C: tension C strain'.", false, at_least(0)},
      {"damping_ratio", &L::damping_ratio, "-",
       "In place of `damping`, C = ratio l sqrt(EA m): part of the critical damping of a segment.",
       false, at_least(0)},
      {"damps_slack", &L::damps_slack, "-",
       "Whether the axial damping acts in slack segments too, which then push and pull by it, as "
       "in "
       "MoorDyn; by default it fades where the tension does."},
      {"bending_stiffness", &L::bending_stiffness, "N m2",
       "Bending stiffnesses EI; ends turn "
       "freely.",
       false, at_least(0)},
      {"drag", &L::drag, "-", "C_d: drag across the line, over D.", false, at_least(0)},
      {"drag_axial", &L::drag_axial, "-", "C_dt: drag along the line, over pi D.", false,
       at_least(0)},
      {"added_mass", &L::added_mass, "-",
       "C_a across the line; the inertia force is rho V (1 + C_a).", false, at_least(0)},
      {"added_mass_axial", &L::added_mass_axial, "-", "C_at: added mass along the line.", false,
       at_least(0)},
      {"breaking_load", &L::breaking_load, "N",
       "Breaking loads of the parts; the summary reports where they are exceeded.", false,
       more_than(0)},
      {"breaks", &L::breaks, "-",
       "Whether the segment parts for good whose tension reaches `breaking_load`."},
      {"contact_diameter", &L::contact_diameter, "m",
       "Width of the parts where they lie on the seabed, their axes half of it above: links are "
       "wider than D; default: D, the axis on the seabed.",
       false, more_than(0)},
      {"pretension", &L::pretension, "N",
       "Tension at B in the reference pose; the length of the first part follows from it.", false,
       more_than(0)},
      {"attachment_at", &L::attachment_at, "m",
       "Unstretched lengths from A at which clumps and buoys hang, each between two segments.",
       false, at_least(0)},
      {"attachment_mass", &L::attachment_mass, "kg", "Their masses.", false, at_least(0)},
      {"attachment_volume", &L::attachment_volume, "m3", "Their volumes.", false, at_least(0)},
      {"attachment_drag_area", &L::attachment_drag_area, "m2", "Their drag areas C_d A.", false,
       at_least(0)},
      {"attachment_added_mass", &L::attachment_added_mass, "-",
       "Their added-mass coefficients C_a, over the volume.", false, at_least(0)},
      {"seabed", &L::seabed, "-", "Whether the seabed carries the line, where there is one."},
      {"seabed_depth", &L::seabed_depth, "m", "Depth of the seabed; default: that of the water.",
       false, more_than(0)},
      {"seabed_stiffness", &L::seabed_stiffness, "N/m3",
       "Normal stiffness of the seabed, over the width in contact; default: the line lies a tenth "
       "of D deep.",
       false, more_than(0)},
      {"seabed_damping", &L::seabed_damping, "N s/m3",
       "Normal damping of the seabed, over the same width, on the way down.", false, at_least(0)},
      {"seabed_damps_up", &L::seabed_damps_up, "-",
       "Whether that damping acts on the way up too, where the seabed may pull, as in MoorDyn."},
      {"seabed_friction", &L::seabed_friction, "-",
       "Friction coefficient of the seabed in motion, smooth within about 0.01 m/s; zero at rest.",
       false, at_least(0)},
      {"water_density", &L::water_density, "kg/m3",
       "Density of the water that buoyancy, drag and added mass of the line are by; default: that "
       "of the case. `check` prints where they differ.",
       false, more_than(0)},
      {"waves", &L::waves, "-", "Whether the line feels the waves; it always feels the current."},
  };
}

} // namespace hydrodae::line
