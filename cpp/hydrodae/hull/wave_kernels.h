#pragma once
/// Sums over waves and over the terms of a `WaveBasis`, compiled for several instruction sets; the
/// widest that the machine has is taken at run time.

#include <array>

#include "hydrodae/hull/wave_basis.h"

namespace hydrodae::hull {

inline constexpr int block_size = 64; ///< points at a time: all lists stay in the first cache
inline constexpr int set_size = 4;    ///< fields that are summed together

/// Constants of the waves, lists by place.
struct WaveLists {
  std::vector<double> omega, phase, k, kx, ky, amplitude;
  std::vector<double> whole;  ///< 1 / (1 + e^{-2kd})
  std::vector<double> mirror; ///< e^{-2kd}
};

/// The waves at one instant from one point: lists by place, real and imaginary parts.
struct Amplitudes {
  std::vector<double> surface, up, back; ///< (2, places): of e^{0}, e^{ks} and e^{-ks}
  double here = 0.0;                     ///< sum of the real parts at the surface [m]
};

/// Fields Re sum_j w_j (up_j e^{k_j c} + back_j ...), w_j = i^turn factor_j, turn -1, 0 or 1.
struct FieldSet {
  std::array<std::vector<double>, set_size> factor; ///< by place; empty: the field is zero
  std::array<int, set_size> turn{};
  std::array<bool, set_size> odd{}; ///< the parts that decay upwards count negative
};

/// Coefficients of the terms of a basis for the fields of a set: (terms, set_size, 2), for bands
/// with the parts of e^{ks} of all terms of a band before those of e^{-ks}.
using Moments = std::vector<double>;

/// Points relative to the origin of the view, padded to a block. Without `rise` it is zero.
struct PointBlock {
  int size = 0;
  const double *x = nullptr, *y = nullptr, *rise = nullptr;
};

/// @param height the height that the parts up and back refer to [m]
void find_amplitudes(const WaveLists& waves, double time, double growth, const Vector3& origin,
                     double height, bool finite, Amplitudes& out);

/// Scratch of `find_moments` has this many numbers.
inline int moment_scratch(const WaveBasis& basis) { return 8 * set_size * basis.places(); }
inline std::size_t moment_size(const WaveBasis& basis, bool finite) {
  return static_cast<std::size_t>(basis.terms()) * set_size * 2 *
         (finite && basis.harmonics.degree < 0 ? 2 : 1);
}

/// @param fields 1: only the first field, or `set_size`
/// @param back null: no parts decay upwards
void find_moments(const WaveBasis& basis, const FieldSet& set, int fields, const double* up,
                  const double* back, double* scratch, Moments& out);

/// Sums of the terms at the points: `fields` lists of `block_size` numbers.
void sum_fields(const WaveBasis& basis, const Moments& moments, bool finite, int fields,
                const PointBlock& points, double* out);

} // namespace hydrodae::hull
