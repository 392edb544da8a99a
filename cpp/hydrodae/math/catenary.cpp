#include "hydrodae/math/catenary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/math/catenary_span.h"

namespace hydrodae {

namespace {

/// Walks down the line from the fairlead.
struct Walk {
  const Catenary& line;
  double H, V;          ///< at the fairlead
  double below = V;     ///< vertical force at the upper end of what comes next
  bool follows = true;  ///< V: nothing stands on the bed above
  bool lies = false;    ///< all that comes next, on the bed
  double pull = H;      ///< there
  double by_V = 0.0;    ///< d pull / dV: as V lifts the line off the bed, less friction acts
  double phi = 0.0;     ///< complementary energy [J]
  double deepest = 0.0; ///< how far parts above what floats sag below the fairlead [m]
  bool pressed = false; ///< does what is above press down on what floats, and that on the bed?
  CatenaryReach out = {};

  void add_span(const Span& a) {
    phi += a.phi;
    out.X += a.x;
    out.Z += a.z;
    out.gradient(0, 0) += a.x_H;
    out.gradient(1, 0) += a.x_V;
  }

  void hang_whole(const LinePart& part) {
    const double w = part.weight, top = below;
    below -= w * part.length;
    if (line.bed && below <= 0.0 && top > 0.0)
      deepest = std::max(deepest, out.Z + hang(H, 0.0, top / w, w, part.stiffness).z);
    const Span a = hang(H, below, part.length, part.weight, part.stiffness);
    add_span(a);
    out.gradient(0, 1) += a.x_V;
    out.gradient(1, 1) += a.z_V;
  }

  /// Hangs as far as the vertical force lasts; the rest lies.
  void touch_down(const LinePart& part) {
    pressed = pressed || below < 0.0;
    const double w = part.weight, EA = part.stiffness, hung = below / w;
    if (hung > 0.0) {
      add_span(hang(H, 0.0, hung, w, EA));
      const double T = std::hypot(H, below); // the length grows by dV / w at its upper end
      out.gradient(0, 1) += (H / T + H / EA) / w;
      out.gradient(1, 1) += (below / T + below / EA) / w;
    }
    if (follows) {
      out.gradient(0, 1) -= (1.0 + H / EA) / w;
      by_V = line.friction;
    }
    lies = true;
    lie(part, part.length - std::max(hung, 0.0));
    below = 0.0;
  }

  /// A length on the bed, where friction takes the pull.
  void lie(const LinePart& part, double length) {
    const double held = part.weight * line.friction;
    const double taut = held * length > pull ? pull / held : length;
    out.X += length + (pull - 0.5 * held * taut) * taut / part.stiffness;
    out.on_bed += length;
    phi += (pull + 0.5 * pull * pull / part.stiffness) * length; // without friction
    out.gradient(0, 0) += taut / part.stiffness;
    out.gradient(0, 1) += by_V * taut / part.stiffness;
    lose(held * taut);
  }

  void pass_load(double weight, bool over_bed) {
    double stands = weight; // of it, on the bed
    if (!lies) {
      const double top = below;
      below -= weight;
      if (line.bed && !over_bed && below <= 0.0 && top > 0.0)
        deepest = std::max(deepest, out.Z);
      pressed = pressed || (over_bed && top < 0.0 && weight > 0.0);
      if (!over_bed || below > 0.0 || weight <= 0.0)
        return;
      stands = -below;
      below = 0.0;
      if (follows)
        by_V = line.friction;
      follows = false;
    }
    lose(stands * line.friction);
  }

  void lose(double friction) {
    pull -= friction;
    if (pull <= 0.0)
      pull = by_V = 0.0;
  }

  CatenaryReach run() {
    const std::size_t low = may_lie(line);
    for (std::size_t i = line.parts.size(); i-- > 0;) {
      const LinePart& part = line.parts[i];
      if (lies)
        lie(part, part.length);
      else if (line.bed && i < low && below <= part.weight * part.length)
        touch_down(part);
      else
        hang_whole(part);
      if (i > 0)
        pass_load(line.loads[i - 1], line.bed && i <= low);
    }
    out.anchor_horizontal = lies ? pull : H;
    out.anchor_vertical = lies ? 0.0 : below;
    return out;
  }
};

double weight_of(const Catenary& line) {
  double sum = 0.0;
  for (const LinePart& part : line.parts)
    sum += part.weight * part.length;
  for (const double load : line.loads)
    sum += load;
  return sum;
}

/// Least vertical force at the fairlead of a line on a bed: what floats may push it up.
double least_lift(const Catenary& line) {
  double sum = 0.0;
  for (const LinePart& part : line.parts)
    sum += std::min(part.weight * part.length, 0.0);
  for (const double load : line.loads)
    sum += std::min(load, 0.0);
  return sum;
}

/// A force that is next to nothing beside all that loads the line [N].
double speck(const Catenary& line) {
  double sum = 0.0, EA = INFINITY;
  for (const LinePart& part : line.parts) {
    sum += std::abs(part.weight) * part.length;
    EA = std::min(EA, part.stiffness);
  }
  for (const double load : line.loads)
    sum += std::abs(load);
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

/// V of a fairlead at height Z that pulls with H: heights grow with V.
double vertical(const Catenary& line, double H, double Z) {
  double low = line.bed ? least_lift(line) : std::min(0.0, weight_of(line)),
         high = std::max(0.0, weight_of(line));
  double EA = INFINITY;
  for (const LinePart& part : line.parts)
    EA = std::min(EA, part.stiffness);
  double width = std::max(high - low, 1e-6 * EA);
  for (; reach(line, H, high).Z < Z && std::isfinite(high); width *= 2.0)
    high += width;
  for (; !line.bed && reach(line, H, low).Z > Z && std::isfinite(low); width *= 2.0)
    low -= width;
  return root(
      [&](double V) {
        const CatenaryReach r = reach(line, H, V);
        return std::pair{r.Z - Z, r.gradient(1, 1)};
      },
      low, high);
}

/// Both by turns: V for each H, and X grows with H. Sure and slow.
void search(const Catenary& line, double X, double Z, double& H, double& V) {
  double low = speck(line), high = std::max(1.0, 2.0 * low);
  while (reach(line, high, vertical(line, high, Z)).X < X && std::isfinite(high))
    high *= 4.0;
  const double log_H = root(
      [&](double logarithm) {
        const double h = std::exp(logarithm), v = vertical(line, h, Z);
        const CatenaryReach r = reach(line, h, v);
        const double slope =
            r.gradient(0, 0) - r.gradient(0, 1) * r.gradient(1, 0) / r.gradient(1, 1);
        return std::pair{r.X - X, slope * h};
      },
      std::log(low), std::log(high));
  H = std::exp(log_H);
  V = vertical(line, H, Z);
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
bool iterate(const Catenary& line, double X, double Z, double& H, double& V) {
  const double size = std::max(line.length(), std::hypot(X, Z));
  CatenaryReach r = reach(line, H, V);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector2d miss(X - r.X, Z - r.Z);
    const double now = miss.norm();
    Eigen::Vector2d step = r.gradient.inverse() * miss;
    if (!step.allFinite())
      return false;
    constexpr double nearly = 1e-8; // its square is rounding
    const bool last = std::abs(step[0]) <= nearly * H &&
                      std::abs(step[1]) <= nearly * std::hypot(H, V) && now <= 1e-6 * size;
    constexpr double least = 0.2; // H stays positive
    if (H + step[0] < least * H)
      step *= (1.0 - least) * H / -step[0];
    for (int cut = 0;; ++cut) {
      r = reach(line, H + step[0], V + step[1]);
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

/// Do parts that float, or those above them, come down to the bed?
bool sags_to_bed(const Catenary& line, double H, double V) {
  if (!line.bed || may_lie(line) == line.parts.size())
    return false;
  Walk walk{.line = line, .H = H, .V = V};
  return walk.run().Z < walk.deepest || walk.pressed;
}

CatenaryHold describe(const CatenaryReach& r, double H, double V, const Eigen::Matrix2d& stiffness,
                      double out_of_plane) {
  CatenaryHold out;
  out.horizontal = H;
  out.vertical = V;
  out.stiffness = stiffness;
  out.out_of_plane = out_of_plane;
  out.on_bed = r.on_bed;
  out.anchor_horizontal = r.anchor_horizontal;
  out.anchor_vertical = r.anchor_vertical;
  return out;
}

} // namespace

double Catenary::length() const {
  double sum = 0.0;
  for (const LinePart& part : parts)
    sum += part.length;
  return sum;
}

std::size_t may_lie(const Catenary& line) {
  std::size_t n = 0;
  while (n < line.parts.size() && line.parts[n].weight > 0.0 &&
         (n == 0 || line.loads[n - 1] >= 0.0))
    ++n;
  return n;
}

CatenaryReach reach(const Catenary& line, double H, double V) {
  return Walk{.line = line, .H = H, .V = V}.run();
}

CatenaryHold hold(const Catenary& line, double X, double Z) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!(X >= 0.0) || !std::isfinite(Z) || (line.bed && Z < 0.0))
    return describe({}, nan, nan, Eigen::Matrix2d::Constant(nan), nan);
  // Next to no pull: the line hangs straight down, and the rest is slack.
  const double little = speck(line), V_slack = vertical(line, little, Z);
  const CatenaryReach slack = reach(line, little, V_slack);
  if (X <= slack.X) {
    if (sags_to_bed(line, little, V_slack))
      return describe({}, nan, nan, Eigen::Matrix2d::Constant(nan), nan);
    Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();
    stiffness(1, 1) = 1.0 / slack.gradient(1, 1);
    if (line.bed && slack.on_bed > 0.0)
      return describe(slack, 0.0, V_slack, stiffness, 0.0);
    const double k = slack.X > 0.0 ? little / slack.X : 0.0;
    stiffness(0, 0) = k;
    return describe(slack, k * X, V_slack, stiffness, k);
  }
  double H = 0.0, V = 0.0;
  guess(line, X, Z, H, V);
  if (!iterate(line, X, Z, H, V))
    search(line, X, Z, H, V);
  const CatenaryReach r = reach(line, H, V);
  if (!(std::hypot(X - r.X, Z - r.Z) <= 1e-9 * std::max(line.length(), std::hypot(X, Z))) ||
      sags_to_bed(line, H, V))
    return describe(r, nan, nan, Eigen::Matrix2d::Constant(nan), nan);
  return describe(r, H, V, r.gradient.inverse(), H / X);
}

double energy(const Catenary& line, const CatenaryHold& found, double X, double Z) {
  Walk walk{.line = line, .H = std::max(found.horizontal, speck(line)), .V = found.vertical};
  walk.run();
  return found.horizontal * X + found.vertical * Z - walk.phi;
}

std::vector<LinePoint> profile(const Catenary& line, const CatenaryHold& found, double X,
                               std::span<const double> s) {
  const double H = std::max(found.horizontal, speck(line)), all = line.length();
  std::vector<LinePoint> out;
  for (const double at : s) {
    // What is above the point hangs as it does; the walk over it alone ends at the point.
    Catenary above = line;
    double left = std::max(0.0, all - at);
    std::size_t first = above.parts.size();
    while (first > 0 && left > 0.0) {
      LinePart& part = above.parts[--first];
      part.length = std::min(part.length, left);
      left -= part.length;
    }
    above.bed = line.bed && first < may_lie(line);
    above.parts.erase(above.parts.begin(), above.parts.begin() + static_cast<Index>(first));
    above.loads.erase(above.loads.begin(),
                      above.loads.begin() + static_cast<Index>(std::min(first, line.loads.size())));
    const CatenaryReach r = reach(above, H, found.vertical), whole = reach(line, H, found.vertical);
    const double slack = found.horizontal > 0.0 ? 0.0 : whole.X - X; // heaped up at the foot
    LinePoint point;
    point.s = at;
    point.x = std::max(0.0, whole.X - r.X - (r.on_bed > 0.0 ? slack : 0.0));
    if (r.on_bed == 0.0)
      point.x = whole.X - r.X - slack;
    point.z = whole.Z - r.Z;
    point.tension = above.parts.empty() ? std::hypot(found.horizontal, found.vertical)
                                        : std::hypot(r.anchor_horizontal, r.anchor_vertical);
    out.push_back(point);
  }
  return out;
}

} // namespace hydrodae
