#pragma once
/// A part of a catenary that hangs, by the forces at its lower end.

#include <algorithm>
#include <cmath>
#include <limits>

namespace hydrodae {

/// A length that hangs, in the plane of the line.
struct Span {
  double x = 0.0, z = 0.0;
  double x_H = 0.0, x_V = 0.0, z_V = 0.0; ///< derivatives at this length; z_H = x_V
  double phi = 0.0; ///< int (T + T^2 / 2 EA) ds: x and z are its derivatives by H and V
};

/// A length L of weight w whose vertical force is V at its lower end, V + w L at its upper end:
///
///   x = H / w [asinh(Vb / H) - asinh(Va / H)] + H L / EA
///   z = (Tb - Ta) / w + (Va + Vb) L / (2 EA)               T^2 = H^2 + V^2
///
/// without differences of nearly equal numbers, w = 0 included: turned so that w >= 0 and
/// Va + Vb >= 0.
inline Span hang(double H, double V, double L, double w, double EA) {
  constexpr double smallest = std::numeric_limits<double>::min();
  double sign = 1.0;
  if (w < 0.0) { // turned upside down
    V = -V;
    w = -w;
    sign = -1.0;
  }
  double a = V, b = V + w * L;
  if (a + b < 0.0) { // with its ends exchanged, too
    std::swap(a, b);
    a = -a;
    b = -b;
    sign = -sign;
  }
  const double Ta = std::hypot(H, a), Tb = std::hypot(H, b);
  const double rise = (a + b) / std::max(Ta + Tb, smallest); // (Tb - Ta) / (w L)
  // (Vb + Tb) / (Va + Ta) = 1 + w L grow
  const double grow = (1.0 + rise) / std::max(a >= 0.0 ? Ta + a : H * H / (Ta - a), smallest);
  const double turn = w * L * grow;
  const double arc = L * grow * (turn == 0.0 ? 1.0 : std::log1p(turn) / turn);
  const double cross = b * Ta + a * Tb;
  const double lean = a * b < 0.0    ? (b * Ta - a * Tb) / (w * Ta * Tb)
                      : cross == 0.0 ? L / std::max(Ta, smallest)
                                     : H * H * L * (a + b) / (cross * Ta * Tb);
  Span out; // lean = (Vb / Tb - Va / Ta) / w
  out.x = H * arc + H * L / EA;
  out.z = sign * (rise * L + 0.5 * (a + b) * L / EA);
  out.x_H = arc - lean + L / EA;
  out.x_V = -sign * H * L * rise / (Ta * Tb);
  out.z_V = lean + L / EA;
  out.phi = 0.25 * L * (Ta + Tb + (a + b) * rise) + 0.5 * H * H * arc +
            (H * H + (a * a + a * b + b * b) / 3.0) * L / (2.0 * EA);
  return out;
}

/// Length that hangs below a point with the vertical force V until it is d lower, on the way down
/// (V' >= 0) or up (V' <= 0); infinite if it never is.
///
///   L = (V - V') / w,   T' + V'^2 / (2 EA) = T + V^2 / (2 EA) - w d
inline double length_to_height(double H, double V, double w, double EA, double d, bool down) {
  const double T = std::hypot(H, V), soft = 1.0 + H / EA;
  const double q = V * V / (T + H) + 0.5 * V * V / EA - w * d;
  const double t = 2.0 * q / (soft + std::sqrt(soft * soft + 2.0 * q / EA)); // T' - H
  const double end = (down ? 1.0 : -1.0) * std::sqrt(t * (t + 2.0 * H));
  const double length =
      V * end > 0.0 ? d / ((1.0 / (T + H + t) + 0.5 / EA) * (V + end)) : (V - end) / w;
  return q >= 0.0 && length > 0.0 ? length : std::numeric_limits<double>::infinity();
}

} // namespace hydrodae
