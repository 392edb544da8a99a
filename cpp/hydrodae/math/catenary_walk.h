#pragma once
/// Forces and places along a catenary, from the fairlead down.

#include <algorithm>
#include <cmath>

#include "hydrodae/math/catenary.h"
#include "hydrodae/math/catenary_span.h"

namespace hydrodae {

/// Walks down the line from the fairlead.
struct CatenaryWalk {
  using Row = CatenaryReach::Row; ///< derivatives by H, V and `above`

  const Catenary& line;
  double H, V;  ///< forces at the fairlead
  double above; ///< height of the fairlead over the surface
  std::span<const double> strength = {};

  double below = V;     ///< vertical force at the upper end of what comes next
  bool lies = false;    ///< true: all following parts lie on the bed
  double pull = H;      ///< pull at that point
  double phi = 0.0;     ///< complementary energy, less what the heights of loads add [J]
  double weight = 0.0;  ///< weight of everything passed [N]
  double deepest = 0.0; ///< how far parts above what floats sag below the fairlead [m]
  bool pressed = false; ///< does what is above press down on what floats, and that on the bed?
  Row below_by = Row::UnitY(), pull_by = Row::UnitX();
  CatenaryReach out = {};
  LinePeak most = {};

  double height() const { return above - out.Z; }
  Row height_by() const { return Row::UnitZ() - out.Z_by; }

  /// A length of weight w whose lower end has the vertical force `low`.
  void add_span(const LinePart& part, double w, double low, double length, const Row& length_by) {
    const Span a = hang(H, low, length, w, part.stiffness);
    const double T = std::hypot(H, low);
    phi += a.phi;
    weight += w * length;
    out.X += a.x;
    out.Z += a.z;
    out.X_by += a.x_H * Row::UnitX() + a.x_V * below_by + (H / T + H / part.stiffness) * length_by;
    out.Z_by +=
        a.x_V * Row::UnitX() + a.z_V * below_by + (low / T + low / part.stiffness) * length_by;
    below = low;
    below_by -= w * length_by;
  }

  /// A part, or what is left of it: to the surface, to the bed, or to its end.
  void pass_part(std::size_t i, bool may_touch) {
    const LinePart& part = line.parts[i];
    double left = part.length;
    Row left_by = Row::Zero();
    bool dry = height() > 0.0 || (height() == 0.0 && below < 0.0);
    while (left > 0.0) {
      const double w = part.weight + (dry ? part.buoyancy : 0.0), EA = part.stiffness;
      bear(i, below);
      if (lies) {
        lie(w, EA, left, left_by);
        return;
      }
      const bool touches = may_touch && below <= w * left;
      const double crosses = part.buoyancy > 0.0 && std::isfinite(above)
                                 ? length_to_height(H, below, w, EA, height(), dry)
                                 : INFINITY;
      if (crosses < (touches ? std::max(below, 0.0) / w : left)) {
        cross(part, w, crosses, left_by);
        left -= crosses;
        dry = !dry;
        continue;
      }
      if (touches) {
        touch_down(part, w, left, left_by);
      } else {
        const double top = below, low = below - w * left;
        if (line.bed && low <= 0.0 && top > 0.0)
          deepest = std::max(deepest, out.Z + hang(H, 0.0, top / w, w, EA).z);
        add_span(part, w, low, left, left_by);
      }
      bear(i, below);
      return;
    }
  }

  /// Down, or up, to the surface, which stands still; the rest of the part is shorter by as much.
  void cross(const LinePart& part, double w, double length, Row& left_by) {
    const double low = below - w * length;
    const Span a = hang(H, low, length, w, part.stiffness);
    const double slope = low / std::hypot(H, low) + low / part.stiffness;
    const Row length_by = (height_by() - a.x_V * Row::UnitX() - a.z_V * below_by) / slope;
    add_span(part, w, low, length, length_by);
    left_by -= length_by;
  }

  /// Hangs as far as the vertical force lasts; the rest lies.
  void touch_down(const LinePart& part, double w, double left, Row left_by) {
    pressed = pressed || below < 0.0;
    if (const double hung = below / w; hung > 0.0) {
      const Row hung_by = below_by / w;
      add_span(part, w, 0.0, hung, hung_by);
      left -= hung;
      left_by -= hung_by;
    }
    below = 0.0;
    below_by.setZero();
    lies = true;
    lie(w, part.stiffness, left, left_by);
  }

  /// A length on the bed, where friction takes the pull.
  void lie(double w, double EA, double length, const Row& length_by) {
    const double held = w * line.friction;
    const bool slips = held * length <= pull;
    const double taut = slips ? length : pull / held;
    phi += (pull + 0.5 * pull * pull / EA) * length; // without friction
    weight += w * length;
    out.X += length + (pull - 0.5 * held * taut) * taut / EA;
    out.X_by += length_by + (taut * pull_by + (pull - held * taut) * length_by) / EA;
    out.on_bed += length;
    lose(slips ? held * taut : pull, held * length_by);
  }

  void pass_load(const LineLoad& load, bool over_bed) {
    double w = load.weight, stands = w; // of it, on the bed
    Row w_by = Row::Zero();
    if (load.buoyancy > 0.0 && height() > -load.radius) {
      // wet part x^2 (3 - 2 x), x = 1/2 - height / 2R; its dry part over the height
      const double R2 = 2.0 * load.radius, x = std::clamp(0.5 - height() / R2, 0.0, 1.0);
      const double lifted =
          R2 * (0.5 - x * (1.0 - x * x * (1.0 - 0.5 * x))) + std::max(height() - load.radius, 0.0);
      const double dry = load.buoyancy * (1.0 - x * x * (3.0 - 2.0 * x));
      w += dry;
      w_by = load.buoyancy * 6.0 * x * (1.0 - x) / R2 * height_by();
      phi -= load.buoyancy * lifted - dry * height();
    }
    weight += w;
    if (!lies) {
      const double top = below;
      below -= w;
      below_by -= w_by;
      if (line.bed && !over_bed && below <= 0.0 && top > 0.0)
        deepest = std::max(deepest, out.Z);
      pressed = pressed || (over_bed && top < 0.0 && w > 0.0);
      if (!over_bed || below > 0.0 || w <= 0.0)
        return;
      stands = -below;
      w_by = -below_by;
      below = 0.0;
      below_by.setZero();
    }
    lose(stands * line.friction, w_by * line.friction);
  }

  void lose(double friction, const Row& friction_by) {
    pull -= friction;
    pull_by -= friction_by;
    if (pull <= 0.0) {
      pull = 0.0;
      pull_by.setZero();
    }
  }

  void bear(std::size_t i, double vertical) {
    if (strength.empty())
      return;
    const double ratio = std::hypot(H, vertical) / strength[strength.size() == 1 ? 0 : i];
    if (ratio > most.ratio)
      most = {ratio, i};
  }

  CatenaryReach run() {
    const std::size_t low = may_lie(line);
    for (std::size_t i = line.parts.size(); i-- > 0;) {
      pass_part(i, line.bed && i < low);
      if (i > 0)
        pass_load(line.loads[i - 1], line.bed && i <= low);
    }
    out.anchor_horizontal = lies ? pull : H;
    out.anchor_vertical = below;
    out.anchor_vertical_by = below_by;
    return out;
  }
};

} // namespace hydrodae
