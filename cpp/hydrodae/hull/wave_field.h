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
///   none          s = z                       wet is what lies beneath z = 0: eta = 0 for the clip

#include <cmath>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/hull/wave_kernels.h"

namespace hydrodae::hull {

enum class Stretching { vertical, wheeler, extrapolated, none };

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

/// Destinations of results; a null gradient is not computed.
struct FieldLists {
  double* value = nullptr;                                  ///< [m] or [Pa]
  double *by_x = nullptr, *by_y = nullptr, *by_z = nullptr; ///< [-] or [Pa/m]
};

/// Sets of fields that are summed together.
enum Set { surface_set = 0, pressure_set, flow_set, flow_slope_set, set_count };

/// The waves at one instant, seen from one point, and scratch.
struct WaveView {
  double height = 0.0;            ///< height that the parts e^{+-ks} refer to [m]
  double most = 0.0, steep = 0.0; ///< sum |A| [m], sum |A| k [-]
  Amplitudes waves;
  std::array<Moments, set_count> moments;
  std::vector<double> scratch;
};

class WaveField {
public:
  /// @param reach largest distance [m] of a point from the origin of a view. The error of the sums
  /// grows beyond.
  WaveField(const Water& water, const std::vector<Wave>& waves, double reach);

  /// Field of still water.
  explicit WaveField(const Water& water) : WaveField(water, {}, INFINITY) {}

  const Water& water() const { return water_; }
  bool still() const { return basis_.waves.empty(); }
  double reach() const { return reach_; }

  /// Complex functions that are evaluated at each point (wave_basis.h).
  int terms() const { return basis_.terms(); }

  /// A view large enough for this field.
  WaveView make_view() const;

  /// Moves a view to another time and origin, in world axes; its gradients only with `gradients`.
  void look(const Instant& instant, const Vector3& origin, WaveView& view,
            bool gradients = true) const;

  /// Bound of |eta| at all points not farther than `radius` [m] from the origin of the view.
  double highest(const WaveView& view, double radius) const;

  /// eta and, unless they are null, d eta/dx and d eta/dy; z is not read.
  void elevation(const WaveView& view, const PointLists& points, const FieldLists& out) const;

  /// Dynamic pressure at points, and its gradient by the world coordinates of the points. The
  /// fields are continued through the bed.
  void pressure(const WaveView& view, const PointLists& points, const FieldLists& out) const;

private:
  template <bool gradient, bool bernoulli>
  void pressure_of_block(const WaveView& view, const PointLists& points, int first,
                         const FieldLists& out) const;
  Water water_;
  double reach_;
  bool finite_ = false; ///< true: the bed affects a wave
  double most_ = 0.0, steep_ = 0.0;
  WaveBasis basis_;
  WaveLists lists_;
  std::array<FieldSet, set_count> sets_;
};

} // namespace hydrodae::hull
