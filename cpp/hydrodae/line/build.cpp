/// Line model from the keys of a line.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/line/line_list.h"
#include "hydrodae/line/line_statics.h"

namespace hydrodae::line {

namespace {

constexpr double lies_deep = 0.1;  ///< depth of a line on a bed without stiffness, as part of D
constexpr double thin_line = 0.01; ///< depth of a line without a diameter [m]

/// Part of a line.
struct Part {
  double l, mass, diameter, EA, damping, EI, strength;
  const Line& of;
  std::size_t index;
};

Part part_of(const Line& of, std::size_t i, double length) {
  const auto get = [&](const std::vector<double>& values, double otherwise = 0.0) {
    return Line::of_part(values, i, otherwise);
  };
  const double l = length / get(of.segments, 20.0), m = get(of.mass), EA = of.stiffness_of(i);
  const double C =
      of.damping_ratio.empty() ? get(of.damping) : get(of.damping_ratio) * l * std::sqrt(EA * m);
  return {
      l,  m, get(of.diameter), EA, C, get(of.bending_stiffness), get(of.breaking_load, INFINITY),
      of, i};
}

/// Curve of tension over the secant EA; null without a curve.
std::shared_ptr<const Curve> curve_of(const Line& of) {
  if (of.curve_strain.empty())
    return nullptr;
  std::vector<double> pulled = of.curve_tension;
  for (double& T : pulled)
    T *= of.curve_strain.back() / of.curve_tension.back();
  return std::make_shared<const Curve>(of.curve_strain, std::move(pulled));
}

/// Strain at a tension over EA.
double strain_at(const Curve* curve, double pulled) {
  if (!curve)
    return pulled;
  double low = 0.0, high = 1.0;
  while ((*curve)(high) < pulled)
    high *= 2.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    ((*curve)(middle) < pulled ? low : high) = middle;
  }
  return high;
}

/// Adds half a segment to a node.
void add_half(const Part& p, const element::Surroundings& around, double bed, LineNode& node) {
  const auto get = [&](const std::vector<double>& values) {
    return Line::of_part(values, p.index);
  };
  const double half = 0.5 * p.l, D = p.diameter, rho = around.density;
  const double volume = 0.25 * pi * D * D * half;
  node.mass += p.mass * half;
  node.lift += rho * around.gravity * volume;
  node.displaced += rho * volume;
  water::MorisonSegment& m = node.line;
  m.radius = std::max(m.radius, 0.5 * D);
  m.half_length += 0.5 * half;
  m.drag += 0.5 * rho * get(p.of.drag) * D * half;
  m.drag_axial += 0.5 * rho * get(p.of.drag_axial) * pi * D * half;
  m.mass_fluid += rho * volume * (1.0 + get(p.of.added_mass));
  m.mass_body += rho * volume * get(p.of.added_mass);
  m.mass_axial += rho * volume * get(p.of.added_mass_axial);
  if (!std::isfinite(bed))
    return;
  const double weight = p.mass * around.gravity - rho * around.gravity * volume / half;
  const double carried = weight > 0.0 ? weight : p.mass * around.gravity;
  const double contact = get(p.of.contact_diameter);
  const double width = contact > 0.0 ? contact : D > 0.0 ? D : thin_line;
  const double k = p.of.seabed_stiffness ? *p.of.seabed_stiffness * width
                                         : carried / (D > 0.0 ? lies_deep * D : thin_line);
  node.bed_stiffness += k * half;
  node.bed_damping += p.of.seabed_damping * width * half;
  node.bed_width = std::max(node.bed_width, carried / k);
  node.friction = p.of.seabed_friction;
  node.axis_height = std::max(node.axis_height, 0.5 * contact);
}

/// Adds clumps and buoys, as spheres of their volume.
void attach(const Line& of, const element::Surroundings& around, double stretched, LineModel& m) {
  for (std::size_t k = 0; k < of.attachment_at.size(); ++k) {
    const double at = of.attachment_at[k] + stretched;
    const auto node =
        std::min_element(m.nodes.begin(), m.nodes.end(), [&](const LineNode& a, const LineNode& b) {
          return std::abs(a.at - at) < std::abs(b.at - at);
        });
    const auto get = [&](const std::vector<double>& values) {
      return values.empty() ? 0.0 : values[k];
    };
    const double V = get(of.attachment_volume), rho = around.density,
                 area = get(of.attachment_drag_area);
    node->mass += get(of.attachment_mass);
    node->body_lift += rho * around.gravity * V;
    const double radius = V > 0.0 ? std::cbrt(0.75 * V / pi) : std::sqrt(area / pi);
    node->body.radius = std::max(node->body.radius, radius);
    node->body.drag += 0.5 * rho * area;
    node->body.mass_fluid += rho * V * (1.0 + get(of.attachment_added_mass));
    node->body.mass_body += rho * V * get(of.attachment_added_mass);
  }
}

} // namespace

LineModel line_model(const Line& of, const element::Surroundings& of_case, double first) {
  element::Surroundings around = of_case;
  around.density = of.water_density.value_or(of_case.density);
  LineModel m;
  m.damps_slack = of.damps_slack;
  m.bed_damps_up = of.seabed_damps_up;
  m.gravity = around.gravity;
  m.wet = around.density > 0.0;
  m.free_end = of.free_end;
  m.bends = (of.shape() & 2) != 0;
  const double depth = of.seabed_depth.value_or(around.water.depth);
  if (of.seabed && around.seabed) {
    m.surface = around.seabed;
    m.bed = m.surface->top();
  } else if (of.seabed && std::isfinite(depth)) {
    m.bed = -depth;
  }
  m.nodes.emplace_back();
  const std::shared_ptr<const Curve> curve = curve_of(of);
  for (std::size_t i = 0; i < of.length.size(); ++i) {
    const Part p = part_of(of, i, i == 0 ? first : of.length[i]);
    const auto n = static_cast<int>(Line::of_part(of.segments, i, 20.0));
    const double weight =
        std::abs(p.mass * around.gravity -
                 around.density * around.gravity * 0.25 * pi * p.diameter * p.diameter);
    const std::shared_ptr<const Curve> own = of.has_curve(i) ? curve : nullptr;
    const double slack = std::max(strain_at(own.get(), weight * p.l / p.EA), 1e-6);
    for (int k = 0; k < n; ++k) {
      m.segments.push_back({p.l, p.EA, p.damping, slack, p.strength, own});
      add_half(p, around, m.bed, m.nodes.back());
      LineNode next;
      next.at = m.nodes.back().at + p.l;
      m.nodes.push_back(next);
      add_half(p, around, m.bed, m.nodes.back());
    }
    for (std::size_t node = m.nodes.size() - static_cast<std::size_t>(n); node < m.nodes.size();
         ++node)
      m.nodes[node].bending = p.EI / p.l;
  }
  // Bending stiffness between two parts: two halves in series.
  for (std::size_t k = 1; k + 1 < m.nodes.size(); ++k) {
    const auto EI_of = [&](std::size_t node) { return m.nodes[node].bending; };
    const double before = EI_of(k), after = EI_of(k + 1);
    if (m.segments[k - 1].length != m.segments[k].length || before != after)
      m.nodes[k].bending = before > 0.0 && after > 0.0 ? 2.0 / (1.0 / before + 1.0 / after) : 0.0;
  }
  m.nodes.back().bending = 0.0;
  attach(of, around, first - of.length[0], m);
  return m;
}

namespace {

/// Length of the first part that gives the requested tension at B.
double tightened(const Line& of, const element::Surroundings& around) {
  Eigen::Matrix<double, 6, 1> x;
  x << of.point_a, of.point_b;
  sea::WaveField still = around.water;
  still.terms.clear();
  const auto tension = [&](double first) {
    return line_at_rest(line_model(of, around, first), still, x.data(), of.point_b, of.name, false)
        .load.tail<3>()
        .norm();
  };
  double chord = (of.point_b - of.point_a).norm(), others = 0.0;
  for (std::size_t i = 1; i < of.length.size(); ++i)
    others += of.length[i];
  double low = std::max(0.5 * (chord - others), 1e-3 * of.length[0]), high = of.length[0] + chord;
  const double most = tension(low), least = tension(high);
  if (!(*of.pretension <= most && *of.pretension >= least))
    throw ModelError("force." + of.name + ".pretension",
                     "force " + in_quotes(of.name) +
                         ": no length of the first part gives this tension at B: between " +
                         number_text(least) + " N and " + number_text(most) + " N can be had");
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (tension(middle) > *of.pretension ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace

std::shared_ptr<const element::Elements> Line::list(const std::vector<Line>& lines,
                                                    const element::Surroundings& around) {
  return std::make_shared<const LineList>(lines, around);
}

LineList::LineList(const std::vector<Line>& lines, const element::Surroundings& around)
    : breaks_(lines.front().breaks), water_(around.water), still_(around.water) {
  still_.terms.clear();
  for (const Line& line : lines) {
    if (const std::optional<Fault> wrong = line.fault(around))
      throw ModelError("force." + line.name + "." + wrong->key,
                       "force " + in_quotes(line.name) + ": " + wrong->message);
    models_.push_back(
        line_model(line, around, line.pretension ? tightened(line, around) : line.length[0]));
    tables_.emplace_back(models_.back());
    names.push_back(line.name);
    waves_.push_back(line.waves);
    free_ends_.push_back(line.point_b);
  }
  const LineModel& m = models_.front();
  type = Line::type;
  shape = {element::Port::points, 3 * m.n_points(), 6 * m.n_unknown(),
           breaks_ ? element::Parting::n_signals : 0};
  inputs.resize(static_cast<std::size_t>(shape.n_signals));
  signals.assign(lines.size() * inputs.size(), 0.0);
  sparsity = line_sparsity(m);
  tells_unknowns = false;
  lost = "the linear model has no loads of waves on dynamic lines; of their drag it has only the "
         "slope that the current gives";
  channels = {
      {"tension", "N", "Tension at end B: size of the load on it; 0 of a free end."},
      {"tension_anchor", "N", "Tension at end A: size of the load on it."},
      {"tension_max", "N", "Largest tension along the line."},
      {"tension_ratio", "-", "Largest tension over breaking load along the line."},
      {"energy", "J",
       "Of the line: kinetic, stretch, bending, in the seabed, height by the weight in water."},
      {"power_water", "W", "Power that the water takes, buoyancy apart."},
      {"power_damping", "W", "Power that the internal damping takes."},
      {"power_seabed", "W", "Power that damping and friction of the seabed take."},
      {"position", "m", "Places of the nodes from A to B, (x, y, z) each.", 3 * (m.n() + 1)},
      {"tension_along", "N", "Tensions of the segments from A to B.", m.n()}};
  if (breaks_) {
    channels.push_back({"parted", "-", "Segment that has parted, counted from A on; 0: none."});
    channels.push_back({"parted_at", "s", "When it has parted; 0 while the line is whole."});
  }
  for (const LineModel& line : models_)
    for (int i = 1; i <= line.n_unknown(); ++i)
      for (const char* what : {"position", "velocity"})
        for (const char* c : {"_x", "_y", "_z"}) {
          element::Unknown u;
          u.name = "node_" + std::to_string(i) + "_" + what + c;
          u.unit = what[0] == 'p' ? "m" : "m/s";
          u.absolute = true;
          u.length = line.segments[static_cast<std::size_t>(i - 1)].length;
          unknowns.push_back(u);
        }
}

} // namespace hydrodae::line
