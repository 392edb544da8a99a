#include "hydrodae/sea/second_order.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace hydrodae::sea {
namespace {

/// tanh kd, 1 in deep water.
double tanh_kd(double wavenumber, double depth) {
  return std::isfinite(depth) ? std::tanh(wavenumber * depth) : 1.0;
}

/// F_i: (phi_tt + g phi_z)_z of a component of 1 m, zero in deep water [m/s3].
double steepening(const Component& c, double depth, double gravity) {
  const double t = tanh_kd(c.wavenumber, depth), k = gravity * c.wavenumber;
  return -k * k * (1.0 - t * t) / c.omega;
}

/// One bound wave with the amplitudes and phases of its components.
WaveField::Term term_of(const BoundWave& wave, double phase, double scale, double depth) {
  const double K = std::hypot(wave.kx, wave.ky), kd = K * depth;
  WaveField::Term out;
  out.omega = wave.omega;
  out.wavenumber = K;
  out.phase = phase;
  out.cosine = K > 0.0 ? wave.kx / K : 1.0;
  out.sine = K > 0.0 ? wave.ky / K : 0.0;
  out.amplitude = scale * wave.elevation;
  out.reflection = kd < 40.0 ? std::exp(-2.0 * kd) : 0.0; // as of linear waves
  out.speed = -scale * wave.potential * K / (1.0 + out.reflection);
  return out;
}

/// Largest horizontal velocity of a term at z = 0 [m/s].
double surface_speed(const WaveField::Term& term) { return term.speed * (1.0 + term.reflection); }

} // namespace

BoundWave bound_wave(const Component& first, const Component& second, int sign, double depth,
                     double gravity) {
  const double s = sign, g = gravity, w1 = first.omega, w2 = second.omega;
  const double k1 = first.wavenumber, k2 = second.wavenumber;
  const double x1 = k1 * std::cos(first.heading), y1 = k1 * std::sin(first.heading);
  const double x2 = k2 * std::cos(second.heading), y2 = k2 * std::sin(second.heading);
  BoundWave out;
  out.omega = w1 + s * w2;
  out.kx = x1 + s * x2;
  out.ky = y1 + s * y2;
  const double W = out.omega, K = std::hypot(out.kx, out.ky);
  const double Q = g * g *
                   (x1 * x2 + y1 * y2 - s * k1 * k2 * tanh_kd(k1, depth) * tanh_kd(k2, depth)) /
                   (w1 * w2);
  const double F = steepening(first, depth, g) + s * steepening(second, depth, g);
  // Waves of one frequency make a steady pattern without flow; in one direction 0 / 0 up to
  // rounding.
  if (std::abs(W) > 1e-12 * (w1 + w2))
    out.potential = (W * Q - 0.5 * F) / (g * K * tanh_kd(K, depth) - W * W);
  out.elevation = -(W * out.potential + 0.5 * Q - 0.5 * (w1 * w1 + w2 * w2)) / g;
  return out;
}

BoundWaves bound_waves(const std::vector<Component>& components, double depth, double gravity,
                       std::size_t most) {
  struct Weighed {
    double weight = 0.0;
    std::size_t first = 0, second = 0;
    int sign = 1;
  };
  const auto make = [&](const Weighed& pair) {
    const Component& a = components[pair.first];
    const Component& b = components[pair.second];
    const bool swapped = pair.sign < 0 && a.omega < b.omega; // frequencies are not negative
    const Component &high = swapped ? b : a, &low = swapped ? a : b;
    const double scale = (pair.first == pair.second ? 0.5 : 1.0) * a.amplitude * b.amplitude;
    return term_of(bound_wave(high, low, pair.sign, depth, gravity),
                   high.phase + pair.sign * low.phase, scale, depth);
  };
  std::vector<Weighed> pairs;
  double down = 0.0, eta2 = 0.0, u2 = 0.0;
  const auto visit = [&](const auto& each) {
    for (std::size_t i = 0; i < components.size(); ++i)
      for (std::size_t j = i; j < components.size(); ++j)
        for (const int sign : {1, -1})
          each(Weighed{0.0, i, j, sign});
  };
  visit([&](const Weighed& pair) {
    const WaveField::Term term = make(pair);
    if (pair.first == pair.second && pair.sign < 0) {
      down += term.amplitude;
      return;
    }
    eta2 += term.amplitude * term.amplitude;
    u2 += std::pow(surface_speed(term), 2);
  });
  visit([&](Weighed pair) {
    if (pair.first == pair.second && pair.sign < 0)
      return;
    const WaveField::Term term = make(pair);
    const double u = surface_speed(term);
    pair.weight = std::max(eta2 > 0.0 ? term.amplitude * term.amplitude / eta2 : 0.0,
                           u2 > 0.0 ? u * u / u2 : 0.0);
    if (pair.weight > 0.0)
      pairs.push_back(pair);
  });
  BoundWaves out;
  out.all = pairs.size();
  const std::size_t kept = std::min(most, pairs.size());
  const auto larger = [](const Weighed& a, const Weighed& b) {
    return std::tie(b.weight, a.first, a.second, a.sign) <
           std::tie(a.weight, b.first, b.second, b.sign);
  };
  std::partial_sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(kept), pairs.end(),
                    larger);
  double own_eta2 = 0.0, own_u2 = 0.0;
  for (std::size_t i = 0; i < kept; ++i) {
    const WaveField::Term& term = out.terms.emplace_back(make(pairs[i]));
    own_eta2 += term.amplitude * term.amplitude;
    own_u2 += std::pow(surface_speed(term), 2);
  }
  out.elevation = eta2 > 0.0 ? std::sqrt(std::min(own_eta2 / eta2, 1.0)) : 1.0;
  out.speed = u2 > 0.0 ? std::sqrt(std::min(own_u2 / u2, 1.0)) : 1.0;
  if (down != 0.0) {
    WaveField::Term& term = out.terms.emplace_back();
    term.amplitude = down;
  }
  return out;
}

SecondOrder::SecondOrder(std::vector<Component> components, double depth, double gravity)
    : components_(std::move(components)) {
  const auto n = static_cast<Index>(components_.size());
  cosines_.resize(n, n);
  sines_.resize(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = i; j < n; ++j) {
      const Component& a = components_[static_cast<std::size_t>(i)];
      const Component& b = components_[static_cast<std::size_t>(j)];
      const double scale = 0.5 * a.amplitude * b.amplitude;
      const double sum = scale * bound_wave(a, b, 1, depth, gravity).elevation;
      const double difference = scale * bound_wave(a, b, -1, depth, gravity).elevation;
      cosines_(i, j) = cosines_(j, i) = difference + sum;
      sines_(i, j) = sines_(j, i) = difference - sum;
    }
}

double SecondOrder::elevation(double t, double x, double y) const {
  const auto n = static_cast<Index>(components_.size());
  VectorX c(n), s(n);
  for (Index i = 0; i < n; ++i) {
    const Component& w = components_[static_cast<std::size_t>(i)];
    const double along = x * std::cos(w.heading) + y * std::sin(w.heading);
    const double angle = w.omega * t - w.wavenumber * along + w.phase;
    c[i] = std::cos(angle);
    s[i] = std::sin(angle);
  }
  return c.dot(cosines_ * c) + s.dot(sines_ * s);
}

} // namespace hydrodae::sea
