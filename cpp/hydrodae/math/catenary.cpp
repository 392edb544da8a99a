#include "hydrodae/math/catenary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/math/catenary_walk.h"

namespace hydrodae {

namespace {

double weight_of(const Catenary& line) {
  double sum = 0.0;
  for (const LinePart& part : line.parts)
    sum += part.weight * part.length;
  for (const LineLoad& load : line.loads)
    sum += load.weight;
  return sum;
}

/// Least vertical force at the fairlead of a line on a bed: buoyant parts may push it up.
double least_lift(const Catenary& line) {
  double sum = 0.0;
  for (const LinePart& part : line.parts)
    sum += std::min(part.weight * part.length, 0.0);
  for (const LineLoad& load : line.loads)
    sum += std::min(load.weight, 0.0);
  return sum;
}

/// A force that is next to nothing beside all that loads the line [N].
double speck(const Catenary& line) {
  double sum = 0.0, EA = INFINITY;
  for (const LinePart& part : line.parts) {
    sum += (std::abs(part.weight) + part.buoyancy) * part.length;
    EA = std::min(EA, part.stiffness);
  }
  for (const LineLoad& load : line.loads)
    sum += std::abs(load.weight) + load.buoyancy;
  return std::max(1e-14 * sum, 1e-20 * EA);
}

/// Root of an increasing function between `low` and `high` by Newton's method, halving the bracket
/// where that leaves it; f answers value and slope.
template <class Function> double root(Function&& f, double low, double high) {
  double x = 0.5 * (low + high);
  for (int k = 0; k < 200; ++k) {
    const auto [value, slope] = f(x);
    (value > 0.0 ? high : low) = x;
    double next = x - value / slope;
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (next == x || high - low <= 1e-16 * (std::abs(low) + std::abs(high)))
      break;
    x = next;
  }
  return x;
}

/// Vertical force V of a fairlead at height Z with the pull H: heights grow with V.
double vertical(const Catenary& line, double H, double Z, double above) {
  double low = line.bed ? least_lift(line) : std::min(0.0, weight_of(line)),
         high = std::max(0.0, weight_of(line));
  double EA = INFINITY;
  for (const LinePart& part : line.parts)
    EA = std::min(EA, part.stiffness);
  double width = std::max(high - low, 1e-6 * EA);
  for (; reach(line, H, high, above).Z < Z && std::isfinite(high); width *= 2.0)
    high += width;
  for (; !line.bed && reach(line, H, low, above).Z > Z && std::isfinite(low); width *= 2.0)
    low -= width;
  return root(
      [&](double V) {
        const CatenaryReach r = reach(line, H, V, above);
        return std::pair{r.Z - Z, r.Z_by[1]};
      },
      low, high);
}

/// Both by turns: V for each H, and X grows with H. Sure and slow.
void search(const Catenary& line, double X, double Z, double above, double& H, double& V) {
  double low = speck(line), high = std::max(1.0, 2.0 * low);
  while (reach(line, high, vertical(line, high, Z, above), above).X < X && std::isfinite(high))
    high *= 4.0;
  const double log_H = root(
      [&](double logarithm) {
        const double h = std::exp(logarithm), v = vertical(line, h, Z, above);
        const CatenaryReach r = reach(line, h, v, above);
        const double slope = r.X_by[0] - r.X_by[1] * r.Z_by[0] / r.Z_by[1];
        return std::pair{r.X - X, slope * h};
      },
      std::log(low), std::log(high));
  H = std::exp(log_H);
  V = vertical(line, H, Z, above);
}

/// Start of the iteration (Jonkman, equation 2-41 and after).
void guess(const Catenary& line, double X, double Z, double& H, double& V) {
  const double L = line.length(), W = weight_of(line), w = W / L;
  const double straight = std::hypot(X, Z);
  double slack = 0.2;
  if (L > straight)
    slack = X > 0.0 ? std::sqrt(3.0 * ((L * L - Z * Z) / (X * X) - 1.0)) : 1e6;
  H = std::max(std::abs(w * X / (2.0 * slack)), speck(line));
  V = 0.5 * (w * Z / std::tanh(slack) + W);
  if (line.bed)
    V = std::max(V, 1e-3 * std::abs(W));
}

/// Newton's method from (H, V), which it changes. @returns whether it ended at rounding
bool iterate(const Catenary& line, double X, double Z, double above, double& H, double& V) {
  const double size = std::max(line.length(), std::hypot(X, Z));
  CatenaryReach r = reach(line, H, V, above);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector2d miss(X - r.X, Z - r.Z);
    const double now = miss.norm();
    Eigen::Vector2d step = r.gradient().inverse() * miss;
    if (!step.allFinite())
      return false;
    constexpr double nearly = 1e-8; // its square is rounding
    const bool last = std::abs(step[0]) <= nearly * H &&
                      std::abs(step[1]) <= nearly * std::hypot(H, V) && now <= 1e-6 * size;
    constexpr double least = 0.2; // H stays positive
    if (H + step[0] < least * H)
      step *= (1.0 - least) * H / -step[0];
    for (int cut = 0;; ++cut) {
      r = reach(line, H + step[0], V + step[1], above);
      if (last || std::hypot(X - r.X, Z - r.Z) < now || now <= 1e-13 * size)
        break;
      if (cut == 10)
        return false;
      step *= 0.5;
    }
    H += step[0];
    V += step[1];
    if (last)
      return true;
    if (now <= 1e-13 * size)
      return true;
  }
  return false;
}

/// Returns whether buoyant parts, or those above them, sag to the bed.
bool sags_to_bed(const Catenary& line, double H, double V, double above) {
  if (!line.bed || may_lie(line) == line.parts.size())
    return false;
  CatenaryWalk walk{.line = line, .H = H, .V = V, .above = above};
  return walk.run().Z < walk.deepest || walk.pressed;
}

/// @param K  d(H, V) / d(X, Z) where the surface keeps its height over the fairlead
CatenaryHold describe(const CatenaryReach& r, double H, double V, const Eigen::Matrix2d& K,
                      double out_of_plane) {
  CatenaryHold out;
  out.horizontal = H;
  out.vertical = V;
  out.stiffness = K;
  out.stiffness.col(1) -= K * Eigen::Vector2d(r.X_by[2], r.Z_by[2]);
  out.by_anchor = K.col(1);
  out.anchor_stiffness = r.anchor_vertical_by.head<2>().dot(K.col(1));
  out.out_of_plane = out_of_plane;
  out.on_bed = r.on_bed;
  out.anchor_horizontal = r.anchor_horizontal;
  out.anchor_vertical = r.anchor_vertical;
  return out;
}

} // namespace

Eigen::Matrix2d CatenaryReach::gradient() const {
  Eigen::Matrix2d out;
  out << X_by.head<2>().transpose(), Z_by.head<2>().transpose();
  return out;
}

double Catenary::length() const {
  double sum = 0.0;
  for (const LinePart& part : parts)
    sum += part.length;
  return sum;
}

std::size_t may_lie(const Catenary& line) {
  std::size_t n = 0;
  while (n < line.parts.size() && line.parts[n].weight > 0.0 &&
         (n == 0 || line.loads[n - 1].weight >= 0.0))
    ++n;
  return n;
}

CatenaryReach reach(const Catenary& line, double H, double V, double above) {
  return CatenaryWalk{.line = line, .H = H, .V = V, .above = above}.run();
}

CatenaryHold hold(const Catenary& line, double X, double Z, double above) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const CatenaryHold none = describe({}, nan, nan, Eigen::Matrix2d::Constant(nan), nan);
  if (!(X >= 0.0) || !std::isfinite(Z) || (line.bed && Z < 0.0))
    return none;
  const double size = std::max(line.length(), std::hypot(X, Z));
  // Almost no pull: the line hangs straight down, and the rest is slack.
  const double little = speck(line), V_slack = vertical(line, little, Z, above);
  const CatenaryReach slack = reach(line, little, V_slack, above);
  if (X <= slack.X) {
    if (sags_to_bed(line, little, V_slack, above) || !(std::abs(slack.Z - Z) <= 1e-9 * size))
      return none;
    Eigen::Matrix2d K = Eigen::Matrix2d::Zero();
    K(1, 1) = 1.0 / slack.Z_by[1];
    if (line.bed && slack.on_bed > 0.0)
      return describe(slack, 0.0, V_slack, K, 0.0);
    K(0, 0) = slack.X > 0.0 ? little / slack.X : 0.0;
    return describe(slack, K(0, 0) * X, V_slack, K, K(0, 0));
  }
  double H = 0.0, V = 0.0;
  guess(line, X, Z, H, V);
  if (!iterate(line, X, Z, above, H, V))
    search(line, X, Z, above, H, V);
  const CatenaryReach r = reach(line, H, V, above);
  if (!(std::hypot(X - r.X, Z - r.Z) <= 1e-9 * size) || sags_to_bed(line, H, V, above))
    return none;
  return describe(r, H, V, r.gradient().inverse(), H / X);
}

double energy(const Catenary& line, const CatenaryHold& found, double X, double Z, double above) {
  CatenaryWalk walk{.line = line,
                    .H = std::max(found.horizontal, speck(line)),
                    .V = found.vertical,
                    .above = above};
  walk.run();
  const double base = std::isfinite(above) ? walk.weight * (above - Z) : 0.0;
  return found.horizontal * X + found.vertical * Z + base - walk.phi;
}

LinePeak peak(const Catenary& line, const CatenaryHold& found, double above,
              std::span<const double> strength) {
  CatenaryWalk walk{.line = line,
                    .H = std::max(found.horizontal, speck(line)),
                    .V = found.vertical,
                    .above = above,
                    .strength = strength};
  walk.run();
  return walk.most;
}

std::vector<LinePoint> profile(const Catenary& line, const CatenaryHold& found, double X,
                               std::span<const double> s, double above) {
  const double H = std::max(found.horizontal, speck(line)), all = line.length();
  std::vector<LinePoint> out;
  for (const double at : s) {
    // The line above the point hangs as before; the walk over it alone ends at the point.
    Catenary upper = line;
    double left = std::max(0.0, all - at);
    std::size_t first = upper.parts.size();
    while (first > 0 && left > 0.0) {
      LinePart& part = upper.parts[--first];
      part.length = std::min(part.length, left);
      left -= part.length;
    }
    upper.bed = line.bed && first < may_lie(line);
    upper.parts.erase(upper.parts.begin(), upper.parts.begin() + static_cast<Index>(first));
    upper.loads.erase(upper.loads.begin(),
                      upper.loads.begin() + static_cast<Index>(std::min(first, line.loads.size())));
    const CatenaryReach r = reach(upper, H, found.vertical, above),
                        whole = reach(line, H, found.vertical, above);
    const double slack = found.horizontal > 0.0 ? 0.0 : whole.X - X; // heaped up at the foot
    LinePoint point;
    point.s = at;
    point.x = std::max(0.0, whole.X - r.X - (r.on_bed > 0.0 ? slack : 0.0));
    if (r.on_bed == 0.0)
      point.x = whole.X - r.X - slack;
    point.z = whole.Z - r.Z;
    point.tension = upper.parts.empty() ? std::hypot(found.horizontal, found.vertical)
                                        : std::hypot(r.anchor_horizontal, r.anchor_vertical);
    out.push_back(point);
  }
  return out;
}

} // namespace hydrodae
