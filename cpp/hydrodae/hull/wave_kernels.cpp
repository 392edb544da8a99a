#include "hydrodae/hull/wave_kernels.h"

#include <algorithm>

#include "hydrodae/math/registers.h"

namespace hydrodae::hull {
namespace {

template <class R, bool finite>
HYDRODAE_PART void amplitudes(const WaveLists& waves, double time, double growth,
                              const Vector3& origin, double height, Amplitudes& out) {
  const std::size_t n = waves.k.size();
  R here{};
  for (std::size_t j = 0; j < n; j += simd::count<R>) {
    R w, phase, k, kx, ky, a, whole, c, s, e;
    simd::load(&waves.omega[j], w);
    simd::load(&waves.phase[j], phase);
    simd::load(&waves.k[j], k);
    simd::load(&waves.kx[j], kx);
    simd::load(&waves.ky[j], ky);
    simd::load(&waves.amplitude[j], a);
    simd::load(&waves.whole[j], whole);
    const R angle = (w * time + phase) - (kx * origin[0] + ky * origin[1]);
    simd::cos_sin(angle, c, s);
    simd::exp(k * height, e);
    const R re = growth * a * c, im = growth * a * s, up = e * whole;
    simd::store(re, &out.surface[j]);
    simd::store(im, &out.surface[n + j]);
    const R up_re = up * re, up_im = up * im;
    simd::store(up_re, &out.up[j]);
    simd::store(up_im, &out.up[n + j]);
    here += re;
    if constexpr (finite) {
      R mirror;
      simd::load(&waves.mirror[j], mirror);
      simd::exp(-k * height, e);
      const R back = mirror * e * whole, back_re = back * re, back_im = back * im;
      simd::store(back_re, &out.back[j]);
      simd::store(back_im, &out.back[n + j]);
    }
  }
  out.here = simd::sum(here);
}

/// out = sum_j weight_j a_j of each of the lists a.
template <class R, int lists>
HYDRODAE_PART void weigh(const double* weight, const double* a, int stride, int n, double* out) {
  R sum[lists] = {};
  for (int j = 0; j < n; j += simd::count<R>) {
    R w, x;
    simd::load(weight + j, w);
    for (int l = 0; l < lists; ++l) {
      simd::load(a + l * stride + j, x);
      sum[l] += w * x;
    }
  }
  for (int l = 0; l < lists; ++l)
    out[l] = simd::sum(sum[l]);
}

/// Coefficients of one direction of a band: lists are real and imaginary parts by field.
template <class R, int fields>
HYDRODAE_PART void band_moments(const WaveBasis& basis, const Band& band, const double* a,
                                double* out) {
  for (int m = 0; m < band.terms; ++m, out += 2 * set_size)
    weigh<R, 2 * fields>(
        &basis.weights[static_cast<std::size_t>(band.first_weight + m * band.places)],
        a + band.first, basis.places(), band.places, out);
}

/// Coefficients of the harmonics. The lists `a` are as above, of both directions.
template <class R, int fields>
HYDRODAE_PART void harmonic_moments(const WaveBasis& basis, const double* up, const double* back,
                                    double* scratch, double* out) {
  const int n = basis.places(), degree = basis.harmonics.degree;
  std::size_t at = 0;
  for (int m = 0; m <= degree; ++m) {
    // Re(a (-i)^m) is Re a, Im a, -Re a, -Im a; lists for even and odd n + m, by field cos and sin.
    const double sign = m % 4 < 2 ? 1.0 : -1.0;
    const double* turn = &basis.harmonics.turns[static_cast<std::size_t>(m * n)];
    const double* sine = turn + (degree + 1) * n;
    for (int l = 0; l < fields; ++l) {
      const double *u = up + (2 * l + m % 2) * n, *b = back + (2 * l + m % 2) * n;
      double *even = scratch + 2 * l * n, *odd = even + 2 * fields * n;
      for (int j = 0; j < n; j += simd::count<R>) {
        R c, s, x, y{};
        simd::load(turn + j, c);
        simd::load(sine + j, s);
        simd::load(u + j, x);
        if (back)
          simd::load(b + j, y);
        const R plus = sign * (x + y), minus = sign * (x - y);
        const R ec = plus * c, es = plus * s, oc = minus * c, os = minus * s;
        simd::store(ec, even + j);
        simd::store(es, even + n + j);
        simd::store(oc, odd + j);
        simd::store(os, odd + n + j);
      }
    }
    for (int d = m; d <= degree; ++d, ++at) {
      double* to = out + at * 2 * set_size;
      weigh<R, 2 * fields>(&basis.harmonics.powers[static_cast<std::size_t>(d * n)],
                           scratch + (d - m) % 2 * 2 * fields * n, n, n, to);
      for (int l = 0; l < 2 * fields; ++l)
        to[l] *= basis.harmonics.scale[at];
    }
  }
}

constexpr int together = 2; ///< registers of points at a time: their chains of operations overlap

template <class R, int fields>
HYDRODAE_PART void sum_band(const WaveBasis& basis, const Band& band, const double* moments,
                            double direction, const PointBlock& points, double* out) {
  constexpr int step = together * simd::count<R>;
  for (int first = 0; first < points.size; first += step) {
    R c_re[together], c_im[together], re[together], im[together], sum[fields][together];
    for (int p = 0; p < together; ++p) {
      const int at = first + p * simd::count<R>;
      R x, y, e, c, s;
      simd::load(points.x + at, x);
      simd::load(points.y + at, y);
      const R along = -(x * band.cosine + y * band.sine), angle = along * band.k;
      simd::cos_sin(angle, c, s);
      c_im[p] = along * (1.0 / basis.length);
      re[p] = c;
      im[p] = s;
      c_re[p] = R{};
      if (points.rise) {
        R rise;
        simd::load(points.rise + at, rise);
        rise *= direction;
        simd::exp(rise * band.k, e);
        c_re[p] = rise * (1.0 / basis.length);
        re[p] = e * c;
        im[p] = e * s;
      }
      for (int l = 0; l < fields; ++l)
        simd::load(out + l * block_size + at, sum[l][p]);
    }
    const double* a = moments;
    for (int m = 0; m < band.terms; ++m, a += 2 * set_size)
      for (int p = 0; p < together; ++p) {
        for (int l = 0; l < fields; ++l)
          sum[l][p] += a[2 * l] * re[p] - a[2 * l + 1] * im[p];
        const R next = re[p] * c_re[p] - im[p] * c_im[p];
        im[p] = re[p] * c_im[p] + im[p] * c_re[p];
        re[p] = next;
      }
    for (int p = 0; p < together; ++p)
      for (int l = 0; l < fields; ++l)
        simd::store(sum[l][p], out + l * block_size + first + p * simd::count<R>);
  }
}

template <class R, int fields>
HYDRODAE_PART void sum_harmonics(const WaveBasis& basis, const double* moments,
                                 const PointBlock& points, double* out) {
  constexpr int step = together * simd::count<R>;
  const double scale = 1.0 / basis.length;
  for (int first = 0; first < points.size; first += step) {
    R x[together], y[together], z[together], r2[together], re[together], im[together];
    R sum[fields][together];
    for (int p = 0; p < together; ++p) {
      const int at = first + p * simd::count<R>;
      simd::load(points.x + at, x[p]);
      simd::load(points.y + at, y[p]);
      x[p] *= scale;
      y[p] *= scale;
      z[p] = R{};
      if (points.rise) {
        simd::load(points.rise + at, z[p]);
        z[p] *= scale;
      }
      r2[p] = x[p] * x[p] + y[p] * y[p] + z[p] * z[p];
      re[p] = R{} + 1.0;
      im[p] = R{};
      for (int l = 0; l < fields; ++l)
        sum[l][p] = R{};
    }
    const double *a = moments, *b = basis.harmonics.recurrence.data();
    for (int m = 0; m <= basis.harmonics.degree; ++m) {
      R q[together], before[together], even[fields][together], odd[fields][together];
      for (int p = 0; p < together; ++p) {
        q[p] = R{} + 1.0;
        before[p] = R{};
        for (int l = 0; l < fields; ++l)
          even[l][p] = odd[l][p] = R{};
      }
      for (int n = m; n <= basis.harmonics.degree; ++n, a += 2 * set_size)
        for (int p = 0; p < together; ++p) {
          for (int l = 0; l < fields; ++l) {
            even[l][p] += a[2 * l] * q[p];
            odd[l][p] += a[2 * l + 1] * q[p];
          }
          // b of the next degree, 0 behind the last
          const double next_b = n < basis.harmonics.degree ? b[n - m + 1] : 0.0;
          const R next = z[p] * q[p] - (next_b * r2[p]) * before[p];
          before[p] = q[p];
          q[p] = next;
        }
      b += basis.harmonics.degree - m + 1;
      for (int p = 0; p < together; ++p) {
        for (int l = 0; l < fields; ++l)
          sum[l][p] += re[p] * even[l][p] + im[p] * odd[l][p];
        const R next = re[p] * x[p] - im[p] * y[p];
        im[p] = re[p] * y[p] + im[p] * x[p];
        re[p] = next;
      }
    }
    for (int p = 0; p < together; ++p)
      for (int l = 0; l < fields; ++l)
        simd::store(sum[l][p], out + l * block_size + first + p * simd::count<R>);
  }
}

/// Amplitudes w_j a_j of the fields of a set: real and imaginary parts by field.
template <int fields>
HYDRODAE_PART void turn_amplitudes(const FieldSet& set, const double* a, int n, bool back,
                                   double* out) {
  for (int l = 0; l < fields; ++l) {
    const auto at = static_cast<std::size_t>(l);
    double *re = out + 2 * l * n, *im = re + n;
    if (set.factor[at].empty()) {
      std::fill_n(re, 2 * n, 0.0);
      continue;
    }
    const double* factor = set.factor[at].data();
    const double sign = back && set.odd[at] ? -1.0 : 1.0;
    for (int j = 0; j < n; ++j) {
      const double f = sign * factor[j];
      switch (set.turn[at]) {
      case 0:
        re[j] = f * a[j];
        im[j] = f * a[n + j];
        break;
      case 1: // i
        re[j] = -f * a[n + j];
        im[j] = f * a[j];
        break;
      default: // -1: -i
        re[j] = f * a[n + j];
        im[j] = -f * a[j];
      }
    }
  }
}

template <class R, int fields>
HYDRODAE_PART void moments(const WaveBasis& basis, const FieldSet& set, const double* up,
                           const double* back, double* scratch, double* out) {
  const int n = basis.places();
  double *turned = scratch, *turned_back = scratch + 2 * set_size * n;
  turn_amplitudes<fields>(set, up, n, false, turned);
  if (back)
    turn_amplitudes<fields>(set, back, n, true, turned_back);
  if (basis.harmonics.degree >= 0) {
    harmonic_moments<R, fields>(basis, turned, back ? turned_back : nullptr,
                                scratch + 4 * set_size * n, out);
    return;
  }
  for (const Band& band : basis.bands)
    for (const double* from : {turned, turned_back}) {
      if (from == turned_back && !back)
        continue;
      band_moments<R, fields>(basis, band, from, out);
      out += band.terms * 2 * set_size;
    }
}

template <class R, int fields>
HYDRODAE_PART void all_terms(const WaveBasis& basis, const double* moments, bool finite,
                             const PointBlock& points, double* out) {
  if (basis.harmonics.degree >= 0) {
    sum_harmonics<R, fields>(basis, moments, points, out);
    return;
  }
  std::fill_n(out, fields * block_size, 0.0);
  for (const Band& band : basis.bands)
    for (const double direction : {1.0, -1.0}) {
      if (direction < 0.0 && !finite)
        continue;
      sum_band<R, fields>(basis, band, moments, direction, points, out);
      moments += band.terms * 2 * set_size;
    }
}

#define HYDRODAE_HULL(set, R, target)                                                              \
  target void amplitudes_##set(const WaveLists& waves, double time, double growth,                 \
                               const Vector3& origin, double height, bool finite,                  \
                               Amplitudes& out) {                                                  \
    finite ? amplitudes<R, true>(waves, time, growth, origin, height, out)                         \
           : amplitudes<R, false>(waves, time, growth, origin, height, out);                       \
  }                                                                                                \
  target void moments_##set(const WaveBasis& basis, const FieldSet& fields, int n,                 \
                            const double* up, const double* back, double* scratch, double* out) {  \
    n == 1 ? moments<R, 1>(basis, fields, up, back, scratch, out)                                  \
           : moments<R, set_size>(basis, fields, up, back, scratch, out);                          \
  }                                                                                                \
  target void fields_##set(const WaveBasis& basis, const double* moments, bool finite, int n,      \
                           const PointBlock& points, double* out) {                                \
    n == 1 ? all_terms<R, 1>(basis, moments, finite, points, out)                                  \
           : all_terms<R, set_size>(basis, moments, finite, points, out);                          \
  }
HYDRODAE_FOR_EACH_SET(HYDRODAE_HULL)

#ifndef HYDRODAE_X86
constexpr auto amplitudes_avx2 = amplitudes_plain, amplitudes_avx512 = amplitudes_plain;
constexpr auto moments_avx2 = moments_plain, moments_avx512 = moments_plain;
constexpr auto fields_avx2 = fields_plain, fields_avx512 = fields_plain;
#endif

} // namespace

void find_amplitudes(const WaveLists& waves, double time, double growth, const Vector3& origin,
                     double height, bool finite, Amplitudes& out) {
  static const auto of = simd::widest(amplitudes_avx512, amplitudes_avx2, amplitudes_plain);
  of(waves, time, growth, origin, height, finite, out);
}

void find_moments(const WaveBasis& basis, const FieldSet& set, int fields, const double* up,
                  const double* back, double* scratch, Moments& out) {
  static const auto of = simd::widest(moments_avx512, moments_avx2, moments_plain);
  of(basis, set, fields, up, back, scratch, out.data());
}

void sum_fields(const WaveBasis& basis, const Moments& moments, bool finite, int fields,
                const PointBlock& points, double* out) {
  static const auto of = simd::widest(fields_avx512, fields_avx2, fields_plain);
  of(basis, moments.data(), finite, fields, points, out);
}

} // namespace hydrodae::hull
