#pragma once
/// Elevation and pressure of undisturbed linear waves at many points, with exact gradients.
///
///   eta = sum A cos th,   th = w t + phase - k (x cos b + y sin b)
///   phi = -sum (g A / w) f(s) sin th,   f(s) = cosh k(s + d) / cosh kd,  e^{ks} in deep water
///   p   = -rho phi_t - 1/2 rho |grad phi|^2 (if `bernoulli`),   phi_t, grad phi taken at s
///
/// p is the dynamic pressure: the whole pressure is p - rho g z. Linear theory ends at z = 0. The
/// height s at which its fields are taken continues them to the crest:
///
///   vertical      s = min(z, 0)               p = rho g (eta - z) in all above z = 0
///   wheeler       s = (z - eta) d / (d + eta) z - eta in deep water (Wheeler, OTC 1006 (1969))
///   extrapolated  s = z                       the whole pressure does not vanish at z = eta

#include <cmath>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::hull {

/// eta = amplitude cos(omega t - wavenumber (x cos heading + y sin heading) + phase)
struct Wave {
  double omega = 0.0;      ///< [rad/s], > 0
  double wavenumber = 0.0; ///< [rad/m], > 0
  double heading = 0.0;    ///< direction of travel [rad]
  double amplitude = 0.0;  ///< [m]
  double phase = 0.0;      ///< [rad]
};

enum class Stretching { vertical, wheeler, extrapolated };

struct Water {
  double density = 1025.0; ///< [kg/m3]
  double gravity = 9.81;   ///< [m/s2]
  double depth = INFINITY; ///< d [m]
  Stretching stretching = Stretching::vertical;
  bool bernoulli = false; ///< the term -1/2 rho |u|^2
};

/// Time [s] and the factor of all amplitudes (a ramp at the start).
struct Instant {
  double time = 0.0, growth = 1.0;
};

/// Points are given as three lists: x and y [m] relative to `origin`, z above still water [m].
struct PointLists {
  int size = 0;
  const double *x = nullptr, *y = nullptr, *z = nullptr;
};

/// Where results go; a null gradient is not computed.
struct FieldLists {
  double* value = nullptr;                                   ///< [m] or [Pa]
  double *by_x = nullptr, *by_y = nullptr, *by_z = nullptr; ///< [-] or [Pa/m]
};

/// The waves at one instant, seen from one point of the water plane, and scratch.
struct WaveView {
  std::vector<double> phases, amplitudes; ///< th at the origin, in [-pi, pi]; with the growth
  std::vector<double> cosines, sines;     ///< of a block of points, by component
};

class WaveField {
public:
  /// Without waves: still water.
  WaveField(const Water& water, const std::vector<Wave>& waves);

  const Water& water() const { return water_; }
  bool still() const { return terms_.empty(); }

  /// A view large enough for this field.
  WaveView make_view() const;

  /// Moves a view; `x`, `y` are the world coordinates of its origin.
  void look(const Instant& instant, double x, double y, WaveView& view) const;

  /// Bound of |eta| at all points not farther than `radius` [m] from the origin of the view.
  double highest(const WaveView& view, double radius) const;

  /// eta, d eta/dx, d eta/dy; z is not read.
  void elevation(const WaveView& view, const PointLists& points, const FieldLists& out) const;

  /// Dynamic pressure at points, and its gradient by the world coordinates of the points. The
  /// fields are continued through the bed.
  void pressure(WaveView& view, const PointLists& points, const FieldLists& out) const;

private:
  struct Term {
    double omega, phase, amplitude;
    double k, kx, ky;  ///< wavenumber and its parts along x and y [rad/m]
    double reflection; ///< e^{-2kd}; 0 in deep water
    double mobility;   ///< g / w: velocity potential over elevation [m/s]
  };
  template <bool gradient, bool bernoulli>
  void pressure_of_block(WaveView& view, const PointLists& points, int first,
                         const FieldLists& out) const;
  Water water_;
  std::vector<Term> terms_;
};

} // namespace hydrodae::hull
