#include "hydrodae/sea/kinematics.h"

#include <algorithm>

#include "hydrodae/math/registers.h"
#include "hydrodae/sea/second_order.h"

namespace hydrodae::sea {

namespace {

/// Sums over the terms at a point, of motion alone or with its derivatives. Those of the velocity
/// u and the acceleration a are symmetric, and zz = -(xx + yy): the flow has neither rotation nor
/// divergence.
enum Sum {
  eta,
  u_x,
  u_y,
  u_z,
  a_x,
  a_y,
  a_z,
  motion_sums,
  u_xx = motion_sums,
  u_xy,
  u_yy,
  u_xz,
  u_yz,
  a_xx,
  a_xy,
  a_yy,
  a_xz,
  a_yz,
  eta_x,
  eta_y,
  all_sums
};

template <class R, bool gradient, bool finite>
HYDRODAE_PART void sum_terms(const std::vector<WaveTerms::Group>& groups, double t,
                             const Vector3& x, double* out) {
  constexpr int n = gradient ? all_sums : motion_sums;
  R sum[n] = {};
  const bool above = x[2] > 0.0;
  for (const WaveTerms::Group& g : groups)
    for (std::size_t j = 0; j < WaveTerms::lanes; j += simd::count<R>) {
      R w, k, angle, cb, sb, a, v, c, s;
      simd::load(g.omega + j, w);
      simd::load(g.wavenumber + j, k);
      simd::load(g.phase + j, angle);
      simd::load(g.cosine + j, cb);
      simd::load(g.sine + j, sb);
      simd::load(g.amplitude + j, a);
      simd::load(g.speed + j, v);
      angle = (w * t + angle) - ((k * cb) * x[0] + (k * sb) * x[1]);
      simd::cos_sin(angle, c, s);
      R C = v, D = v;
      if (!above) {
        R e;
        simd::exp(k * x[2], e);
        C = D = v * e;
      }
      if constexpr (finite) {
        R back;
        simd::load(g.reflection + j, back);
        if (!above) {
          R e;
          simd::exp(-k * x[2], e);
          back *= e;
        }
        C += v * back;
        D -= v * back;
      }
      const R u_h = C * c, a_h = w * C * s;
      const R a_v = w * D * c, u_v = D * s;
      sum[eta] += a * c;
      sum[u_x] += cb * u_h;
      sum[u_y] += sb * u_h;
      sum[u_z] -= u_v;
      sum[a_x] -= cb * a_h;
      sum[a_y] -= sb * a_h;
      sum[a_z] -= a_v;
      if constexpr (gradient) {
        // By th: d/dx = -k cos b d/dth, d/dy = -k sin b d/dth; by z: C' = k S, S' = k C.
        const R kx = k * cb, ky = k * sb, kw = k * w, turned = C * s, level = D * c;
        sum[u_xx] += kx * cb * turned;
        sum[u_xy] += kx * sb * turned;
        sum[u_yy] += ky * sb * turned;
        sum[u_xz] += kx * level;
        sum[u_yz] += ky * level;
        sum[a_xx] += kw * cb * cb * u_h;
        sum[a_xy] += kw * cb * sb * u_h;
        sum[a_yy] += kw * sb * sb * u_h;
        sum[a_xz] -= kw * cb * u_v;
        sum[a_yz] -= kw * sb * u_v;
        sum[eta_x] += kx * a * s;
        sum[eta_y] += ky * a * s;
      }
    }
  for (int i = 0; i < n; ++i)
    out[i] = simd::sum(sum[i]);
}

using Groups = std::vector<WaveTerms::Group>;
#define HYDRODAE_WAVES(set, R, target)                                                             \
  target void motion_##set(const Groups& g, bool finite, double t, const Vector3& x,               \
                           double* out) {                                                          \
    finite ? sum_terms<R, false, true>(g, t, x, out) : sum_terms<R, false, false>(g, t, x, out);   \
  }                                                                                                \
  target void gradient_##set(const Groups& g, bool finite, double t, const Vector3& x,             \
                             double* out) {                                                        \
    finite ? sum_terms<R, true, true>(g, t, x, out) : sum_terms<R, true, false>(g, t, x, out);     \
  }
HYDRODAE_FOR_EACH_SET(HYDRODAE_WAVES)

#ifndef HYDRODAE_X86
constexpr auto motion_avx2 = motion_plain, motion_avx512 = motion_plain,
               gradient_avx2 = gradient_plain, gradient_avx512 = gradient_plain;
#endif

} // namespace

std::size_t WaveTerms::size() const {
  std::size_t n = lanes * groups_.size();
  while (n % lanes != 1 && n > 0 && groups_.back().cosine[(n - 1) % lanes] == 0.0 &&
         groups_.back().sine[(n - 1) % lanes] == 0.0)
    --n;
  return n;
}

WaveTerms::Term WaveTerms::operator[](std::size_t i) const {
  const Group& g = groups_[i / lanes];
  const std::size_t k = i % lanes;
  return {g.omega[k], g.wavenumber[k], g.phase[k],      g.cosine[k],
          g.sine[k],  g.amplitude[k],  g.reflection[k], g.speed[k]};
}

void WaveTerms::push_back(const Term& term) {
  const std::size_t k = size() % lanes;
  if (k == 0)
    groups_.emplace_back();
  Group& g = groups_.back();
  g.omega[k] = term.omega;
  g.wavenumber[k] = term.wavenumber;
  g.phase[k] = term.phase;
  g.cosine[k] = term.cosine;
  g.sine[k] = term.sine;
  g.amplitude[k] = term.amplitude;
  g.reflection[k] = term.reflection;
  g.speed[k] = term.speed;
}

void WaveTerms::append(const std::vector<Term>& terms) {
  for (const Term& term : terms)
    push_back(term);
}

void WaveTerms::keep(std::size_t size) {
  const WaveTerms all = std::move(*this);
  groups_.clear();
  for (std::size_t i = 0; i < std::min(size, all.size()); ++i)
    push_back(all[i]);
}

void WaveTerms::set_phase(std::size_t i, double phase) {
  groups_[i / lanes].phase[i % lanes] = phase;
}

WaveField::WaveField(const std::vector<Component>& components, double water_depth, double ramp_time,
                     const Vector3& flow)
    : depth(water_depth), ramp(ramp_time), current(flow) {
  for (const Component& c : components) {
    const double kh = c.wavenumber * depth;
    // Beyond, e^{-kh} is less than what rounding leaves.
    const double reflection = kh < 40.0 ? std::exp(-2.0 * kh) : 0.0;
    const double whole = kh < 40.0 ? -std::expm1(-2.0 * kh) : 1.0;
    terms.push_back({c.omega, c.wavenumber, c.phase, std::cos(c.heading), std::sin(c.heading),
                     c.amplitude, reflection, c.amplitude * c.omega / whole});
  }
}

double elevation(const WaveField& field, double t, double x, double y) {
  FluidPoint<double> water{Vector3::Zero(), Vector3::Zero(), 0.0};
  add_waves<double>(field, t, {x, y, 0.0}, water, nullptr);
  return field.second ? water.elevation + ramp(t, field.ramp) * field.second->elevation(t, x, y)
                      : water.elevation;
}

template <>
void add_waves<double>(const WaveField& field, double t, const Vector3& x, FluidPoint<double>& out,
                       FluidGradient* gradient) {
  static const auto motion = simd::widest(motion_avx512, motion_avx2, motion_plain);
  static const auto with_gradient = simd::widest(gradient_avx512, gradient_avx2, gradient_plain);
  const double growth = ramp(t, field.ramp);
  if (growth == 0.0)
    return;
  double sum[all_sums];
  (gradient ? with_gradient : motion)(field.terms.groups(), std::isfinite(field.depth), t, x, sum);
  for (int i = 0; i < (gradient ? all_sums : motion_sums); ++i)
    sum[i] *= growth;
  out.elevation += sum[eta];
  out.velocity += Vector3(sum[u_x], sum[u_y], sum[u_z]);
  out.acceleration += Vector3(sum[a_x], sum[a_y], sum[a_z]);
  if (!gradient)
    return;
  const auto symmetric = [&](const double* part) {
    Matrix3 m;
    m << part[0], part[1], part[3], //
        part[1], part[2], part[4],  //
        part[3], part[4], -(part[0] + part[2]);
    if (x[2] > 0.0) // the values of z = 0
      m.col(2).setZero();
    return m;
  };
  gradient->velocity += symmetric(sum + u_xx);
  gradient->acceleration += symmetric(sum + a_xx);
  gradient->elevation += Vector3(sum[eta_x], sum[eta_y], 0.0);
}

} // namespace hydrodae::sea
