#include "hydrodae/hull/wave_field.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/hull/cos_sin.h"

namespace hydrodae::hull {
namespace {

constexpr int block_size = 64; ///< points at a time: all sums stay in the first cache
using Block = Eigen::Array<double, block_size, 1>;

/// A block of a list, its end filled with the last point.
Block read(const double* list, int first, int size) {
  const int n = std::min(block_size, size - first);
  Block out;
  std::copy_n(list + first, n, out.data());
  std::fill(out.data() + n, out.data() + block_size, list[size - 1]);
  return out;
}

void write(const Block& values, int first, int size, double* list) {
  std::copy_n(values.data(), std::min(block_size, size - first), list + first);
}

/// eta and its slopes.
struct Surface {
  Block eta = Block::Zero(), by_x = Block::Zero(), by_y = Block::Zero();
};

/// The height s at which the fields are taken, and its derivatives by x, y, z.
struct Height {
  Block s, by_x, by_y, by_z;
};

Height height(const Water& water, const Surface& surface, const Block& z) {
  switch (water.stretching) {
  case Stretching::vertical:
    return {z.min(0.0), Block::Zero(), Block::Zero(), (z < 0.0).cast<double>()};
  case Stretching::extrapolated:
    return {z, Block::Zero(), Block::Zero(), Block::Ones()};
  case Stretching::wheeler:
    break;
  }
  if (!std::isfinite(water.depth))
    return {z - surface.eta, -surface.by_x, -surface.by_y, Block::Ones()};
  const Block shrink = water.depth / (water.depth + surface.eta);
  const Block by_eta = -shrink * (water.depth + z) / (water.depth + surface.eta);
  return {(z - surface.eta) * shrink, by_eta * surface.by_x, by_eta * surface.by_y, shrink};
}

/// Sums over the components: q = sum A f cos th, the potential's first and second derivatives.
struct Sums {
  Block q = Block::Zero(), q_x = Block::Zero(), q_y = Block::Zero(), q_s = Block::Zero();
  Block u = Block::Zero(), v = Block::Zero(), w = Block::Zero();
  Block xx = Block::Zero(), xy = Block::Zero(), yy = Block::Zero();
  Block xs = Block::Zero(), ys = Block::Zero(), ss = Block::Zero();
};

} // namespace

WaveField::WaveField(const Water& water, const std::vector<Wave>& waves) : water_(water) {
  for (const Wave& w : waves) {
    if (!(w.omega > 0.0 && w.wavenumber > 0.0))
      throw Error("a wave needs a frequency and a wavenumber above zero");
    const double kd = w.wavenumber * water.depth;
    // Beyond, e^{-kd} is less than what rounding leaves.
    const double reflection = kd < 40.0 ? std::exp(-2.0 * kd) : 0.0;
    terms_.push_back({w.omega, w.phase, w.amplitude, w.wavenumber,
                      w.wavenumber * std::cos(w.heading), w.wavenumber * std::sin(w.heading),
                      reflection, water.gravity / w.omega});
  }
}

WaveView WaveField::make_view() const {
  const std::size_t n = terms_.size(), block = water_.stretching == Stretching::wheeler
                                                   ? static_cast<std::size_t>(block_size)
                                                   : 0;
  return {std::vector<double>(n), std::vector<double>(n), std::vector<double>(n * block),
          std::vector<double>(n * block)};
}

void WaveField::look(const Instant& instant, double x, double y, WaveView& view) const {
  for (std::size_t j = 0; j < terms_.size(); ++j) {
    const Term& term = terms_[j];
    view.phases[j] =
        std::remainder(term.omega * instant.time + term.phase - term.kx * x - term.ky * y, 2 * pi);
    view.amplitudes[j] = term.amplitude * instant.growth;
  }
}

double WaveField::highest(const WaveView& view, double radius) const {
  double most = 0.0, here = 0.0, slope = 0.0;
  for (std::size_t j = 0; j < terms_.size(); ++j) {
    const double a = std::abs(view.amplitudes[j]);
    most += a;
    slope += a * terms_[j].k;
    here += view.amplitudes[j] * std::cos(view.phases[j]);
  }
  return std::min(most, std::abs(here) + slope * radius);
}

void WaveField::elevation(const WaveView& view, const PointLists& points,
                          const FieldLists& out) const {
  for (int first = 0; first < points.size; first += block_size) {
    const Block x = read(points.x, first, points.size), y = read(points.y, first, points.size);
    Surface surface;
    Block c, s;
    for (std::size_t j = 0; j < terms_.size(); ++j) {
      const Term& term = terms_[j];
      const double a = view.amplitudes[j];
      const Block angle = view.phases[j] - term.kx * x - term.ky * y;
      cos_sin(angle, c, s);
      surface.eta += a * c;
      surface.by_x += (a * term.kx) * s;
      surface.by_y += (a * term.ky) * s;
    }
    write(surface.eta, first, points.size, out.value);
    write(surface.by_x, first, points.size, out.by_x);
    write(surface.by_y, first, points.size, out.by_y);
  }
}

template <bool gradient, bool bernoulli>
void WaveField::pressure_of_block(WaveView& view, const PointLists& points, int first,
                                  const FieldLists& out) const {
  const Block x = read(points.x, first, points.size), y = read(points.y, first, points.size);
  const bool wheeler = water_.stretching == Stretching::wheeler;
  Block c, s;
  Surface surface;
  if (wheeler) // the height s needs the elevation first
    for (std::size_t j = 0; j < terms_.size(); ++j) {
      const Term& term = terms_[j];
      const Block angle = view.phases[j] - term.kx * x - term.ky * y;
      cos_sin(angle, c, s);
      Block::Map(view.cosines.data() + j * block_size) = c;
      Block::Map(view.sines.data() + j * block_size) = s;
      surface.eta += view.amplitudes[j] * c;
      surface.by_x += (view.amplitudes[j] * term.kx) * s;
      surface.by_y += (view.amplitudes[j] * term.ky) * s;
    }
  const Height at = height(water_, surface, read(points.z, first, points.size));
  Sums sum;
  for (std::size_t j = 0; j < terms_.size(); ++j) {
    const Term& term = terms_[j];
    const double k = term.k, kx = term.kx, ky = term.ky, h = term.mobility;
    if (wheeler) {
      c = Block::Map(view.cosines.data() + j * block_size);
      s = Block::Map(view.sines.data() + j * block_size);
    } else {
      const Block angle = view.phases[j] - kx * x - ky * y;
      cos_sin(angle, c, s);
    }
    // a = A f, b = A f' = A df/ds
    Block a = (k * at.s).exp(), b;
    if (term.reflection > 0.0) {
      const double A = view.amplitudes[j] / (1.0 + term.reflection);
      const Block back = term.reflection / a;
      b = (A * k) * (a - back);
      a = A * (a + back);
    } else {
      a *= view.amplitudes[j];
      b = k * a;
    }
    const Block ac = a * c;
    sum.q += ac;
    if constexpr (bernoulli) {
      sum.u += (h * kx) * ac;
      sum.v += (h * ky) * ac;
      sum.w -= h * b * s;
    }
    if constexpr (gradient) {
      const Block as = a * s, bc = b * c;
      sum.q_x += kx * as;
      sum.q_y += ky * as;
      sum.q_s += bc;
      if constexpr (bernoulli) {
        sum.xx += (h * kx * kx) * as;
        sum.xy += (h * kx * ky) * as;
        sum.yy += (h * ky * ky) * as;
        sum.xs += (h * kx) * bc;
        sum.ys += (h * ky) * bc;
        sum.ss -= (h * k * k) * as;
      }
    }
  }
  const double rho = water_.density, weight = rho * water_.gravity;
  Block p = weight * sum.q;
  if constexpr (bernoulli)
    p -= (0.5 * rho) * (sum.u.square() + sum.v.square() + sum.w.square());
  write(p, first, points.size, out.value);
  if constexpr (gradient) {
    Block p_x = weight * sum.q_x, p_y = weight * sum.q_y, p_s = weight * sum.q_s;
    if constexpr (bernoulli) {
      p_x -= rho * (sum.u * sum.xx + sum.v * sum.xy + sum.w * sum.xs);
      p_y -= rho * (sum.u * sum.xy + sum.v * sum.yy + sum.w * sum.ys);
      p_s -= rho * (sum.u * sum.xs + sum.v * sum.ys + sum.w * sum.ss);
    }
    write(p_x + p_s * at.by_x, first, points.size, out.by_x);
    write(p_y + p_s * at.by_y, first, points.size, out.by_y);
    write(p_s * at.by_z, first, points.size, out.by_z);
  }
}

void WaveField::pressure(WaveView& view, const PointLists& points, const FieldLists& out) const {
  const auto block = [&]() {
    if (out.by_x)
      return water_.bernoulli ? &WaveField::pressure_of_block<true, true>
                              : &WaveField::pressure_of_block<true, false>;
    return water_.bernoulli ? &WaveField::pressure_of_block<false, true>
                            : &WaveField::pressure_of_block<false, false>;
  }();
  for (int first = 0; first < points.size; first += block_size)
    (this->*block)(view, points, first, out);
}

} // namespace hydrodae::hull
