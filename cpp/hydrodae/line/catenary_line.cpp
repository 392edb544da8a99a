#include "hydrodae/line/catenary_line.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/element/laws.h"
#include "hydrodae/line/breaking.h"

namespace hydrodae::line {

namespace {

/// The hold of a line, and the vertical plane in which it hangs.
struct Found {
  CatenaryHold hold;
  Eigen::Vector2d e; ///< horizontal, from A to B
  double X, Z;       ///< of B from A [m]
};

/// @param x  places of A and B (6,) [m]
Found find(const Catenary& line, const double* x) {
  const Vector3 d = Eigen::Map<const Vector3>(x + 3) - Eigen::Map<const Vector3>(x);
  const double X = std::hypot(d[0], d[1]);
  const Eigen::Vector2d e = X > 0.0 ? Eigen::Vector2d(d.head<2>() / X) : Eigen::Vector2d(1, 0);
  return {hold(line, X, d[2]), e, X, d[2]};
}

void put_loads(const Found& at, double* load) {
  Eigen::Map<Vector6>(load) << at.hold.anchor_horizontal * at.e, at.hold.anchor_vertical,
      -at.hold.horizontal * at.e, -at.hold.vertical;
}

Matrix3 slope(const Found& at) {
  const Eigen::Matrix2d& K = at.hold.stiffness;
  Matrix3 out;
  out.topLeftCorner<2, 2>() =
      K(0, 0) * at.e * at.e.transpose() +
      at.hold.out_of_plane * (Eigen::Matrix2d::Identity() - at.e * at.e.transpose());
  out.topRightCorner<2, 1>() = K(0, 1) * at.e;
  out.bottomLeftCorner<1, 2>() = K(1, 0) * at.e.transpose();
  out(2, 2) = K(1, 1);
  return -out;
}

Catenary described(const CatenaryLine& of) {
  Catenary out;
  for (std::size_t i = 0; i < of.length.size(); ++i)
    out.parts.push_back({of.length[i], of.weight[i], of.stiffness[i]});
  out.loads = of.loads;
  out.loads.resize(of.length.size() - 1, 0.0);
  out.bed = of.seabed;
  out.friction = of.friction;
  return out;
}

double tension(const CatenaryLine& of, Catenary& line, double first) {
  const Vector3 d = of.point_b - of.point_a;
  line.parts[0].length = first;
  return hold(line, std::hypot(d[0], d[1]), d[2]).tension();
}

/// Lengths of the first part between which a tension is looked for [m].
std::pair<double, double> lengths_to_try(const CatenaryLine& of) {
  return {1e-6 * of.length[0], of.length[0] + (of.point_b - of.point_a).norm()};
}

/// The first part gets the length by which the tension is the one that was asked for: it falls as
/// the line gets longer.
void tighten(const CatenaryLine& of, Catenary& line) {
  auto [low, high] = lengths_to_try(of);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (tension(of, line, middle) > *of.pretension ? low : high) = middle;
  }
  line.parts[0].length = 0.5 * (low + high);
}

/// What is wrong with a line on the seabed, if anything.
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
  put_loads(find(line, in.x), out.load);
}

void CatenaryLine::Law::operator()(const element::In<Dual>& in,
                                   const element::Out<Dual>& out) const {
  std::array<double, 6> x, load;
  for (std::size_t i = 0; i < 6; ++i)
    x[i] = in.x[i].a;
  const Found at = find(line, x.data());
  put_loads(at, load.data());
  const Matrix3 K = slope(at);
  for (int i = 0; i < 3; ++i) {
    double change = 0.0;
    for (int k = 0; k < 3; ++k)
      change += K(i, k) * (in.x[3 + k].b - in.x[k].b);
    const auto at_a = static_cast<std::size_t>(i);
    out.load[i] = Dual(load[at_a], -change);
    out.load[3 + i] = Dual(load[3 + at_a], change);
  }
}

Matrix3 CatenaryLine::Law::gradient(const double* x) const { return slope(find(line, x)); }

double CatenaryLine::Law::energy(const element::In<double>& in) const {
  const Found at = find(line, in.x);
  return hydrodae::energy(line, at.hold, at.X, at.Z);
}

void CatenaryLine::Law::observe(const element::In<double>& in, const element::Out<const double>&,
                                double* values) const {
  const Found at = find(line, in.x);
  values[0] = at.hold.tension();
  values[1] = std::hypot(at.hold.anchor_horizontal, at.hold.anchor_vertical);
  values[2] = at.hold.on_bed;
}

CatenaryLine::Law CatenaryLine::law() const {
  Law out{described(*this)};
  if (pretension)
    tighten(*this, out.line);
  return out;
}

namespace {

/// The part that bears most: along each the tension is largest at one of its ends.
element::Overload heaviest(const Catenary& line, const std::vector<double>& breaking_load,
                           const double* x) {
  const CatenaryHold hold = find(line, x).hold;
  element::Overload out;
  double V = hold.vertical; // at the upper end of the part
  const std::size_t low = line.bed ? may_lie(line) : 0;
  for (std::size_t i = line.parts.size(); i-- > 0;) {
    const double below = V - line.parts[i].weight * line.parts[i].length;
    const double lower = i < low ? std::max(below, 0.0) : below; // the bed carries the rest
    const double T = std::hypot(hold.horizontal, std::max(std::abs(V), std::abs(lower)));
    const double ratio = T / breaking_load[breaking_load.size() == 1 ? 0 : i];
    if (ratio > out.ratio)
      out = {ratio, static_cast<int>(i) + 1};
    if (i > 0)
      V = lower - line.loads[i - 1];
  }
  return out;
}

} // namespace

std::shared_ptr<const element::Elements>
CatenaryLine::list(const std::vector<CatenaryLine>& lines) {
  if (lines.front().breaking_load.empty())
    return std::make_shared<const element::Laws<CatenaryLine>>(lines);
  std::vector<std::shared_ptr<const element::Elements>> whole;
  std::vector<Breaking::Bears> bears;
  for (const CatenaryLine& line : lines) {
    whole.push_back(
        std::make_shared<const element::Laws<CatenaryLine>>(std::vector<CatenaryLine>{line}));
    bears.emplace_back([hung = line.law().line, line](const double* in, const double*) {
      return heaviest(hung, line.breaking_load, in);
    });
  }
  return std::make_shared<const Breaking>(whole, bears, lines.front().breaks);
}

std::optional<Fault> CatenaryLine::fault() const {
  const auto numbers = [](const std::string& key) {
    return Fault{key, "a line needs as many numbers in '" + key + "' as parts in 'length'"};
  };
  if (length.empty())
    return Fault{"length", "a line needs at least one part"};
  if (weight.size() != length.size())
    return numbers("weight");
  if (stiffness.size() != length.size())
    return numbers("stiffness");
  if (!loads.empty() && loads.size() + 1 != length.size())
    return Fault{"loads", "'loads' hang between the parts: one number less than 'length'"};
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
  const Vector3 d = point_b - point_a;
  if (std::isnan(hold(law().line, std::hypot(d[0], d[1]), d[2]).vertical))
    return Fault{"seabed", "in the reference pose a buoy, a part that floats, or what is above "
                           "one, is down on the seabed; this type cannot compute that; use type "
                           "'line', or seabed = false if there is no seabed"};
  return {};
}

} // namespace hydrodae::line
