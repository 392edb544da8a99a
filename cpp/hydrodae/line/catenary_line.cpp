#include "hydrodae/line/catenary_line.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/element/laws.h"
#include "hydrodae/line/breaking.h"

namespace hydrodae::line {

namespace {

/// Solution of a line, and the vertical plane in which it hangs.
struct Found {
  CatenaryHold hold;
  Eigen::Vector2d e; ///< horizontal, from A to B
  double X, Z;       ///< position of B relative to A [m]
};

/// @param x  places of A and B (6,) [m]
Found find(const CatenaryLine::Law& law, const double* x) {
  const Vector3 d = Eigen::Map<const Vector3>(x + 3) - Eigen::Map<const Vector3>(x);
  const double X = std::hypot(d[0], d[1]);
  const Eigen::Vector2d e = X > 0.0 ? Eigen::Vector2d(d.head<2>() / X) : Eigen::Vector2d(1, 0);
  return {hold(law.line, X, d[2], law.above(x)), e, X, d[2]};
}

void put_loads(const Found& at, double* load) {
  Eigen::Map<Vector6>(load) << at.hold.anchor_horizontal * at.e, at.hold.anchor_vertical,
      -at.hold.horizontal * at.e, -at.hold.vertical;
}

/// Derivatives of the end forces by the end places. The forces have a potential, so that the
/// derivatives by the heights of A and B are symmetric; the seabed and the surface do not move with
/// the ends.
Matrix6 slope(const Found& at) {
  const Eigen::Matrix2d& K = at.hold.stiffness;
  const Eigen::Matrix2d across =
      K(0, 0) * at.e * at.e.transpose() +
      at.hold.out_of_plane * (Eigen::Matrix2d::Identity() - at.e * at.e.transpose());
  const Eigen::Vector2d by_b = K(0, 1) * at.e, of_b = K(1, 0) * at.e,
                        by_a = at.hold.by_anchor[0] * at.e;
  Matrix6 out;
  out << -across, -by_a, across, by_b,              //
      -by_a.transpose(), -at.hold.anchor_stiffness, //
      by_a.transpose(), at.hold.by_anchor[1],       //
      across, by_a, -across, -by_b,                 //
      of_b.transpose(), at.hold.by_anchor[1], -of_b.transpose(), -K(1, 1);
  return out;
}

/// Weight of sea water [N/m3]: with the buoyancy it gives the size of a load at the surface.
constexpr double sea_water = 1025.0 * 9.81;

Catenary described(const CatenaryLine& of) {
  const auto buoyancy = [](const std::vector<double>& dry, std::size_t i, double wet) {
    return dry.empty() ? std::max(-wet, 0.0) : dry[i] - wet;
  };
  Catenary out;
  for (std::size_t i = 0; i < of.length.size(); ++i)
    out.parts.push_back(
        {of.length[i], of.weight[i], of.stiffness[i], buoyancy(of.dry_weight, i, of.weight[i])});
  for (std::size_t i = 0; i + 1 < of.length.size(); ++i) {
    const double weight = of.loads.empty() ? 0.0 : of.loads[i],
                 lift = buoyancy(of.dry_loads, i, weight);
    out.loads.push_back({weight, lift, std::cbrt(0.75 * lift / (pi * sea_water))});
  }
  out.bed = of.seabed;
  out.friction = of.friction;
  return out;
}

/// Line between its ends in the reference pose.
CatenaryHold in_place(const CatenaryLine& of, const Catenary& line) {
  const Vector3 d = of.point_b - of.point_a;
  return hold(line, std::hypot(d[0], d[1]), d[2], of.point_b[2] - of.surface);
}

double tension(const CatenaryLine& of, Catenary& line, double first) {
  line.parts[0].length = first;
  return in_place(of, line).tension();
}

/// Range of lengths of the first part in the search for a tension [m].
std::pair<double, double> lengths_to_try(const CatenaryLine& of) {
  return {1e-6 * of.length[0], of.length[0] + (of.point_b - of.point_a).norm()};
}

/// Finds the length of the first part that gives the requested tension, which falls as the line
/// gets longer.
void tighten(const CatenaryLine& of, Catenary& line) {
  auto [low, high] = lengths_to_try(of);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (tension(of, line, middle) > *of.pretension ? low : high) = middle;
  }
  line.parts[0].length = 0.5 * (low + high);
}

/// Fault in a line on the seabed, or nothing.
std::optional<Fault> fault_on_seabed(const CatenaryLine& of) {
  if (of.body_a != "ground")
    return Fault{"seabed", "the seabed is at the height of end A, so that must be on the ground; "
                           "write seabed = false for a line that hangs between two bodies"};
  if (of.point_b[2] < of.point_a[2])
    return Fault{"point_b", "end B is below the seabed, which is at the height of end A"};
  return {};
}

} // namespace

void CatenaryLine::Law::operator()(const element::In<double>& in,
                                   const element::Out<double>& out) const {
  put_loads(find(*this, in.x), out.load);
}

void CatenaryLine::Law::operator()(const element::In<Dual>& in,
                                   const element::Out<Dual>& out) const {
  std::array<double, 6> x, load;
  for (std::size_t i = 0; i < 6; ++i)
    x[i] = in.x[i].a;
  const Found at = find(*this, x.data());
  put_loads(at, load.data());
  const Matrix6 K = slope(at);
  for (int i = 0; i < 6; ++i) {
    double change = 0.0;
    for (int k = 0; k < 6; ++k)
      change += K(i, k) * in.x[k].b;
    out.load[i] = Dual(load[static_cast<std::size_t>(i)], change);
  }
}

Matrix6 CatenaryLine::Law::gradient(const double* x) const { return slope(find(*this, x)); }

double CatenaryLine::Law::energy(const element::In<double>& in) const {
  const Found at = find(*this, in.x);
  return hydrodae::energy(line, at.hold, at.X, at.Z, above(in.x));
}

void CatenaryLine::Law::observe(const element::In<double>& in, const element::Out<const double>&,
                                double* values) const {
  const Found at = find(*this, in.x);
  values[0] = at.hold.tension();
  values[1] = std::hypot(at.hold.anchor_horizontal, at.hold.anchor_vertical);
  values[2] = at.hold.on_bed;
}

CatenaryLine::Law CatenaryLine::law() const {
  Law out{described(*this), surface};
  if (pretension)
    tighten(*this, out.line);
  return out;
}

std::shared_ptr<const element::Elements>
CatenaryLine::list(const std::vector<CatenaryLine>& lines) {
  if (lines.front().breaking_load.empty())
    return std::make_shared<const element::Laws<CatenaryLine>>(lines);
  std::vector<std::shared_ptr<const element::Elements>> whole;
  std::vector<Breaking::Bears> bears;
  for (const CatenaryLine& line : lines) {
    whole.push_back(
        std::make_shared<const element::Laws<CatenaryLine>>(std::vector<CatenaryLine>{line}));
    bears.emplace_back(
        [law = line.law(), strength = line.breaking_load](const double* in, const double*) {
          const LinePeak most = peak(law.line, find(law, in).hold, law.above(in), strength);
          return element::Overload{most.ratio, static_cast<int>(most.part) + 1};
        });
  }
  return std::make_shared<const Breaking>(whole, bears, lines.front().breaks);
}

std::optional<Fault> CatenaryLine::fault() const {
  const auto numbers = [](const std::string& key) {
    return Fault{key, "a line needs as many numbers in '" + key + "' as parts in 'length'"};
  };
  const auto lighter = [](const std::string& key, double dry, double wet, const char* unit) {
    return Fault{key, number_text(dry) + " " + unit + " out of the water, " + number_text(wet) +
                          " " + unit + " in it: water lifts, so write at least as much"};
  };
  if (length.empty())
    return Fault{"length", "a line needs at least one part"};
  if (weight.size() != length.size())
    return numbers("weight");
  if (stiffness.size() != length.size())
    return numbers("stiffness");
  if (!loads.empty() && loads.size() + 1 != length.size())
    return Fault{"loads", "'loads' hang between the parts: one number less than 'length'"};
  if (!dry_weight.empty() && dry_weight.size() != length.size())
    return numbers("dry_weight");
  if (!dry_loads.empty() && dry_loads.size() + 1 != length.size())
    return Fault{"dry_loads", "'dry_loads' hang between the parts: one number less than 'length'"};
  for (std::size_t i = 0; i < dry_weight.size(); ++i)
    if (dry_weight[i] < weight[i])
      return lighter("dry_weight", dry_weight[i], weight[i], "N/m");
  for (std::size_t i = 0; i < dry_loads.size(); ++i)
    if (const double wet = loads.empty() ? 0.0 : loads[i]; dry_loads[i] < wet)
      return lighter("dry_loads", dry_loads[i], wet, "N");
  if (breaking_load.size() > 1 && breaking_load.size() != length.size())
    return Fault{"breaking_load",
                 "'breaking_load' takes one number, or as many as parts in 'length'"};
  if (breaks && breaking_load.empty())
    return Fault{"breaks", "a line that breaks needs its 'breaking_load'"};
  for (const double w : weight)
    if (w == 0.0)
      return Fault{"weight", "a line without weight is a rope: use type 'rope'"};
  if (seabed)
    if (std::optional<Fault> wrong = fault_on_seabed(*this))
      return wrong;
  if (pretension) {
    Catenary line = described(*this);
    const auto [short_line, long_line] = lengths_to_try(*this);
    const double most = tension(*this, line, short_line), least = tension(*this, line, long_line);
    if (!(*pretension <= most && *pretension >= least))
      return Fault{"pretension", "no length of the first part gives this tension at B: between " +
                                     number_text(least) + " N and " + number_text(most) +
                                     " N can be had"};
  }
  if (std::isnan(in_place(*this, law().line).vertical)) {
    if (!seabed)
      return Fault{"weight", "in the reference pose a part that floats lies on the surface; this "
                             "type cannot compute that; use type 'line'"};
    return Fault{"seabed", "in the reference pose a buoy or a part that floats is down on the "
                           "seabed, or a part that floats lies on the surface; this type cannot "
                           "compute that; use type 'line', or seabed = false if there is no "
                           "seabed"};
  }
  return {};
}

} // namespace hydrodae::line
