/// Meaning and checks of the keys of a rope.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/line/rope_model.h"

namespace hydrodae::line {

bool Rope::is_plain() const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (has_sheave(i))
      return false;
  return true;
}

double Rope::friction_at(std::size_t point) const {
  if (friction.empty() || point == 0 || point + 1 == points.size())
    return 0.0;
  return friction.size() == 1 ? friction.front() : friction[point];
}

bool Rope::has_friction() const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (friction_at(i) > 0.0)
      return true;
  return false;
}

std::vector<std::pair<std::string, Vector3>> Rope::ends() const {
  std::vector<std::pair<std::string, Vector3>> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    out.emplace_back(bodies[i], points[i]);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (has_sheave(i))
      out.emplace_back(bodies[i], points[i] + radii[i] * axes[i].normalized());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (has_sheave(i) && friction_at(i) > 0.0)
      out.emplace_back(bodies[i], points[i] + radii[i] * axes[i].unitOrthogonal());
  return out;
}

namespace {

/// Path in the reference pose.
RopePath<double> reference_path(const Rope& rope) {
  std::array<RopeNode<double>, most_rope_nodes> nodes;
  for (std::size_t i = 0; i < rope.points.size(); ++i) {
    nodes[i].place = rope.points[i];
    if (!rope.has_sheave(i))
      continue;
    nodes[i].radius = rope.radii[i];
    nodes[i].axis = rope.axes[i].normalized();
  }
  RopePath<double> path;
  lay_rope<double>(nodes.data(), static_cast<int>(rope.points.size()), path);
  return path;
}

} // namespace

double Rope::distance() const {
  double sum = 0.0;
  if (is_plain()) {
    for (std::size_t i = 1; i < points.size(); ++i)
      sum += (points[i] - points[i - 1]).norm();
    return sum;
  }
  const RopePath<double> path = reference_path(*this);
  for (int k = 0; k < path.n_spans; ++k)
    sum += path.spans[static_cast<std::size_t>(k)].length;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += has_sheave(i) ? radii[i] * path.wrap[i] : 0.0;
  return sum;
}

double Rope::free_length() const {
  if (length)
    return *length;
  return pretension ? distance() / (1.0 + *pretension / stiffness) : distance();
}

bool Rope::has_point_twice() const {
  return std::adjacent_find(points.begin(), points.end()) != points.end();
}

std::size_t Rope::shape() const {
  std::size_t sheaves = 0, places = 0, spun = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool rubs = friction_at(i) > 0.0;
    sheaves += has_sheave(i) ? 1 : 0;
    places += rubs ? 1 : 0;
    spun += rubs && has_sheave(i) ? 1 : 0;
  }
  const std::size_t bears = breaks ? 2 : breaking_load ? 1 : 0;
  return points.size() + 128 * (sheaves + 128 * (places + 128 * (spun + 128 * bears)));
}

namespace {

constexpr double largest_fleet_angle = pi / 12.0;
constexpr double largest_friction = 5.0;

std::optional<Fault> fault_of_friction(const Rope& rope) {
  const std::vector<double>& all = rope.friction;
  if (!all.empty() && rope.points.size() == 2)
    return Fault{"friction", "a rope over two points rubs nowhere: 'friction' goes with points "
                             "between its ends"};
  if (all.size() > 1 && all.size() != rope.points.size())
    return Fault{"friction", "'friction' takes one entry for each of the points, ends included, or "
                             "one for all between the ends"};
  if (all.size() > 1 && (all.front() > 0.0 || all.back() > 0.0))
    return Fault{"friction", "the ends of a rope are held: their friction is 0"};
  for (const double mu : all)
    if (mu > largest_friction)
      return Fault{"friction",
                   "a coefficient of friction is 5 at most: what holds better is an end"};
  return {};
}

/// Checks keys with one entry for each point.
std::optional<Fault> fault_of_lists(const Rope& rope) {
  const std::vector<std::pair<std::string, std::size_t>> all = {{"radii", rope.radii.size()},
                                                                {"axes", rope.axes.size()}};
  for (const auto& [key, size] : all)
    if (size > 0 && size != rope.points.size())
      return Fault{key, "'" + key + "' takes one entry for each of the points, ends included"};
  for (const std::size_t end : {std::size_t(0), rope.points.size() - 1})
    if (rope.has_sheave(end))
      return Fault{"radii", "the ends of a rope are points: their radius is 0"};
  if (const std::optional<Fault> wrong = fault_of_friction(rope))
    return wrong;
  for (std::size_t i = 0; i < rope.points.size(); ++i)
    if (rope.has_sheave(i) && (rope.axes.empty() || rope.axes[i].norm() == 0.0))
      return Fault{"axes", "a sheave needs the direction of its axis in 'axes'"};
  return {};
}

/// Checks the path in the reference pose.
std::optional<Fault> fault_of_path(const Rope& rope) {
  const RopePath<double> path = reference_path(rope);
  const auto label = [](int i) { return " (point " + std::to_string(i + 1) + ")"; };
  for (int k = 0; k < path.n_spans; ++k) {
    const RopeSpan<double>& s = path.spans[static_cast<std::size_t>(k)];
    if (!(s.length > 0.0))
      return Fault{"radii", "no straight part touches the sheaves between points " +
                                std::to_string(s.from + 1) + " and " + std::to_string(s.to + 1) +
                                " in the reference pose: one is inside the other's radius"};
    for (const int end : {s.from, s.to}) {
      const auto i = static_cast<std::size_t>(end);
      if (!rope.has_sheave(i))
        continue;
      const double fleet = std::asin(std::min(1.0, std::abs(s.e.dot(rope.axes[i].normalized()))));
      if (fleet > largest_fleet_angle)
        return Fault{"axes", "in the reference pose the rope leaves the plane of a sheave" +
                                 label(end) + " by " + rounded_text(fleet * 180.0 / pi, 3) +
                                 " deg; at most 15 deg are taken, as it would come off"};
    }
  }
  return {};
}

} // namespace

std::optional<Fault> Rope::fault() const {
  if (points.size() < 2)
    return Fault{"points", "a rope needs two points or more"};
  if (points.size() > most_points)
    return Fault{"points", "a rope takes 100 points at most: each feels all others"};
  if (bodies.size() != points.size())
    return Fault{"bodies", "a rope needs as many names in 'bodies' as 'points'"};
  if (breaks && !breaking_load)
    return Fault{"breaks", "a rope that breaks needs its 'breaking_load'"};
  if (length && pretension)
    return Fault{"pretension", "write either 'length' or 'pretension'"};
  if (const std::string_view wrong = Curve::fault(winch_time, winch_length); !wrong.empty())
    return Fault{"winch_time", "'winch_time' " + std::string(wrong) + " 'winch_length'"};
  if (!winch_time.empty() && (length || pretension))
    return Fault{"winch_length", "the winch sets the length; take 'length' and 'pretension' out"};
  if (const std::optional<Fault> wrong = fault_of_lists(*this))
    return wrong;
  if (has_point_twice() && !(is_plain() && !has_friction() && length && *length > distance()))
    return Fault{"points", "two points in a row are at one place in the reference pose: the rope "
                           "has no direction between them, unless it is slack there (of points "
                           "without radii and friction, 'length' above their distance)"};
  if (is_plain() && !has_friction())
    return {};
  if (points.size() > most_with_sheaves)
    return Fault{"points", "a rope with sheaves or friction takes 20 points at most"};
  return fault_of_path(*this);
}

} // namespace hydrodae::line
