#pragma once
/// Few functions of the place that stand for many waves near a point.
///
/// Waves of one direction b add a_j e^{k_j c}, c = s - i (x cos b + y sin b), complex a_j. Over a
/// range k_0 +- h of wavenumbers
///
///   sum_j a_j e^{k_j c} = e^{k_0 c} sum_m p_m c^m,   p_m = sum_j a_j (k_j - k_0)^m / m!
///
/// up to (h |c|)^M / M! e^{2 h |c|} of |a_j e^{k_j c}| for M terms. Less than 30 terms stand for
/// hundreds of waves to 1e-13. Parts that decay upwards have -s in place of s.
///
/// Where the directions are many, all waves together are a sum of regular solid harmonics
/// (E. W. Hobson, The theory of spherical and ellipsoidal harmonics (1931), art. 89):
///
///   e^{k c} = sum_n k^n sum_{m <= n} (2 - [m = 0]) (-i)^m Re(R_nm e^{-i m b}),
///   R_nm = r^n P_nm(cos theta) e^{i m phi} / (n + m)! = (x + i y)^m g_nm q_nm(s, r^2),
///   q_mm = 1,   q_nm = s q_{n-1,m} - b_nm r^2 q_{n-2,m},   R_nm(-s) = (-1)^{n+m} R_nm(s)
///
/// up to (k r)^{N+1} / (N+1)! of |a_j| for the degrees 0 .. N, and rounding of e^{k r}.

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

/// Lists of numbers by wave are padded to whole groups of so many; those behind the last are zero.
inline constexpr int lanes = 8;
/// Waves of one direction and their first place in the lists by wave.
struct Band {
  int first = 0, places = 0;       ///< a multiple of `lanes`
  int terms = 0;                   ///< M
  double k = 0.0;                  ///< k_0 [rad/m]
  double cosine = 1.0, sine = 0.0; ///< of the direction
  int first_weight = 0;            ///< of (M, places) numbers ((k_j - k_0) L)^m / m!
};

/// Solid harmonics of the degrees 0 .. N.
struct Harmonics {
  int degree = -1;                ///< N; -1: none, the bands are used
  std::vector<double> recurrence; ///< b_nm in the order of `harmonic`
  std::vector<double> scale;      ///< (2 - [m = 0]) g_nm
  std::vector<double> powers;     ///< (N + 1, places): (k_j L)^n
  std::vector<double> turns;      ///< (2, N + 1, places): cos m b_j, then sin m b_j
};

struct WaveBasis {
  std::vector<Wave> waves; ///< by place; amplitude 0 where padded
  double length = 1.0;     ///< L, a scale of places [m]
  std::vector<Band> bands;
  std::vector<double> weights; ///< of all bands
  Harmonics harmonics;

  int places() const { return static_cast<int>(waves.size()); }
  /// Complex functions of the place.
  int terms() const;
};

/// @param reach largest |c| at which the sums are taken [m]
/// @param finite waves have parts that decay upwards
WaveBasis make_basis(const std::vector<Wave>& waves, double reach, bool finite);

} // namespace hydrodae::hull
