#include "hydrodae/hull/wave_field.h"

#include <algorithm>
#include <array>

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

/// Elevation eta and its slopes.
struct Surface {
  Block eta = Block::Zero(), by_x = Block::Zero(), by_y = Block::Zero();
};

/// Height s of the fields, and its derivatives by x, y, z.
struct Height {
  Block s, by_x, by_y, by_z;
};

Height height(const Water& water, const Surface& surface, const Block& z) {
  switch (water.stretching) {
  case Stretching::vertical:
  case Stretching::none:
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

/// Columns of complex amplitudes, real and imaginary part: of the elevation; of e^{ks} and e^{-ks}
/// in q; of both in the potential.
enum Part {
  elevation_part = 0,
  up_part = 2,
  back_part = 4,
  up_flow = 6,
  back_flow = 8,
  parts = 10
};

/// Re and Im of a e^{-i angle}; Im is the derivative of Re by the angle.
struct Turned {
  Block re, im;
};
Turned turned(const WaveView& view, std::size_t node, int part, const Block& c, const Block& s) {
  const auto j = static_cast<Eigen::Index>(node);
  const double re = view.nodes(j, part), im = view.nodes(j, part + 1);
  return {re * c + im * s, im * c - re * s};
}

void add(const WaveView& view, const Node& node, std::size_t j, const Block& c, const Block& s,
         Surface& surface) {
  const Turned wave = turned(view, j, elevation_part, c, s);
  surface.eta += wave.re;
  surface.by_x += node.kx * wave.im;
  surface.by_y += node.ky * wave.im;
}

} // namespace

WaveField::WaveField(const Water& water, const std::vector<Wave>& waves, double reach)
    : water_(water), reach_(reach) {
  double most = 0.0, square = 0.0;
  for (const Wave& w : waves) {
    if (!(w.omega > 0.0 && w.wavenumber > 0.0))
      throw Error("a wave needs a frequency and a wavenumber above zero");
    most += std::abs(w.amplitude);
    square += w.amplitude * w.amplitude;
    // Beyond that, e^{-kd} is below the rounding error.
    finite_ |= w.wavenumber * water.depth < 40.0;
  }
  // Wheeler's heights are farther from the origin by the elevation: of irregular waves less than 8
  // standard deviations.
  const double crest =
      water.stretching == Stretching::wheeler ? std::min(most, 8.0 * std::sqrt(0.5 * square)) : 0.0;
  waves_ = make_nodes(waves, reach + crest);
}

WaveView WaveField::make_view() const {
  const auto n = static_cast<Eigen::Index>(waves_.waves.size());
  const auto m = static_cast<Eigen::Index>(waves_.nodes.size());
  const std::size_t stored = water_.stretching == Stretching::wheeler
                                 ? waves_.nodes.size() * static_cast<std::size_t>(block_size)
                                 : 0;
  WaveView view;
  view.waves.setZero(n, parts);
  view.nodes.setZero(m, parts);
  const Eigen::Index padded = (n + block_size - 1) / block_size * block_size;
  view.angle.setZero(padded);
  view.cosine.resize(padded);
  view.sine.resize(padded);
  view.cosines.resize(stored);
  view.sines.resize(stored);
  return view;
}

void WaveField::look(const Instant& instant, const Vector3& origin, WaveView& view) const {
  const bool below =
      water_.stretching == Stretching::vertical || water_.stretching == Stretching::none;
  view.height = below ? std::min(origin[2], 0.0) : origin[2];
  view.here = view.most = view.steep = 0.0;
  const auto n = static_cast<Eigen::Index>(waves_.waves.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    const Wave& w = waves_.waves[static_cast<std::size_t>(j)];
    const double along = std::cos(w.heading) * origin[0] + std::sin(w.heading) * origin[1];
    view.angle[j] = std::remainder(w.omega * instant.time + w.phase - w.wavenumber * along, 2 * pi);
  }
  for (Eigen::Index j = 0; j < view.angle.size(); j += block_size) {
    Block c, s; // of fixed size: no allocation
    cos_sin(Block(view.angle.segment<block_size>(j)), c, s);
    view.cosine.segment<block_size>(j) = c;
    view.sine.segment<block_size>(j) = s;
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    const Wave& w = waves_.waves[static_cast<std::size_t>(j)];
    const double k = w.wavenumber, a = w.amplitude * instant.growth;
    // f(s) = (e^{ks} + e^{-k(s + 2d)}) / (1 + e^{-2kd})
    const double d = water_.depth, whole = 1.0 + std::exp(-2.0 * k * d);
    const double up = std::exp(k * view.height) / whole;
    const double back = finite_ ? std::exp(-k * (2.0 * d + view.height)) / whole : 0.0;
    const double speed = water_.gravity / w.omega;
    const double re = a * view.cosine[j], im = a * view.sine[j];
    const std::array<double, 5> factors{1.0, up, back, speed * up, speed * back};
    for (int part = 0; part < 5; ++part) {
      view.waves(j, 2 * part) = factors[static_cast<std::size_t>(part)] * re;
      view.waves(j, 2 * part + 1) = factors[static_cast<std::size_t>(part)] * im;
    }
    view.here += re;
    view.most += std::abs(a);
    view.steep += std::abs(a) * k;
  }
  for (const Band& band : waves_.bands)
    for (int part = 0; part < parts; ++part) {
      const auto from = view.waves.col(part).segment(band.first_wave, band.waves);
      auto to = view.nodes.col(part).segment(band.first_node, band.nodes);
      if (band.weights.size() == 0)
        to = from;
      else
        for (int i = 0; i < band.nodes; ++i)
          to[i] = (band.weights.col(i).array() * from).sum();
    }
}

double WaveField::highest(const WaveView& view, double radius) const {
  if (water_.stretching == Stretching::none)
    return 0.0;
  return std::min(view.most, std::abs(view.here) + view.steep * radius);
}

void WaveField::elevation(const WaveView& view, const PointLists& points,
                          const FieldLists& out) const {
  if (water_.stretching == Stretching::none) {
    for (double* list : {out.value, out.by_x, out.by_y})
      if (list)
        std::fill_n(list, points.size, 0.0);
    return;
  }
  for (int first = 0; first < points.size; first += block_size) {
    const Block x = read(points.x, first, points.size), y = read(points.y, first, points.size);
    Surface surface;
    Block c, s;
    for (std::size_t j = 0; j < waves_.nodes.size(); ++j) {
      const Node& node = waves_.nodes[j];
      const Block angle = node.kx * x + node.ky * y;
      cos_sin(angle, c, s);
      add(view, node, j, c, s, surface);
    }
    write(surface.eta, first, points.size, out.value);
    write(surface.by_x, first, points.size, out.by_x);
    write(surface.by_y, first, points.size, out.by_y);
  }
}

template <bool gradient, bool bernoulli, bool finite>
void WaveField::pressure_of_block(WaveView& view, const PointLists& points, int first,
                                  const FieldLists& out) const {
  const Block x = read(points.x, first, points.size), y = read(points.y, first, points.size);
  const bool wheeler = water_.stretching == Stretching::wheeler;
  Block c, s;
  Surface surface;
  if (wheeler) // the height s needs the elevation first
    for (std::size_t j = 0; j < waves_.nodes.size(); ++j) {
      const Node& node = waves_.nodes[j];
      const Block angle = node.kx * x + node.ky * y;
      cos_sin(angle, c, s);
      Block::Map(view.cosines.data() + j * block_size) = c;
      Block::Map(view.sines.data() + j * block_size) = s;
      add(view, node, j, c, s, surface);
    }
  const Height at = height(water_, surface, read(points.z, first, points.size));
  const Block rise = at.s - view.height;
  Sums sum;
  for (std::size_t j = 0; j < waves_.nodes.size(); ++j) {
    const auto [k, kx, ky] = waves_.nodes[j];
    if (wheeler) {
      c = Block::Map(view.cosines.data() + j * block_size);
      s = Block::Map(view.sines.data() + j * block_size);
    } else {
      const Block angle = kx * x + ky * y;
      cos_sin(angle, c, s);
    }
    const Block e = (k * rise).exp();
    Block back;
    if constexpr (finite)
      back = 1.0 / e;
    // Sum and difference of the parts with e^{ks} and e^{-ks}: the difference is d/ds over k.
    const auto add_up = [&](int up, int down, Turned& plus, Turned& minus) {
      plus = turned(view, j, up, c, s);
      plus.re *= e;
      plus.im *= e;
      minus = plus;
      if constexpr (finite) {
        const Turned other = turned(view, j, down, c, s);
        plus.re += back * other.re;
        plus.im += back * other.im;
        minus.re -= back * other.re;
        minus.im -= back * other.im;
      }
    };
    Turned plus, minus;
    add_up(up_part, back_part, plus, minus);
    sum.q += plus.re;
    if constexpr (gradient) {
      sum.q_x += kx * plus.im;
      sum.q_y += ky * plus.im;
      sum.q_s += k * minus.re;
    }
    if constexpr (bernoulli) {
      add_up(up_flow, back_flow, plus, minus);
      sum.u += kx * plus.re;
      sum.v += ky * plus.re;
      sum.w -= k * minus.im;
      if constexpr (gradient) {
        sum.xx += (kx * kx) * plus.im;
        sum.xy += (kx * ky) * plus.im;
        sum.yy += (ky * ky) * plus.im;
        sum.xs += (k * kx) * minus.re;
        sum.ys += (k * ky) * minus.re;
        sum.ss -= (k * k) * plus.im;
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
  const auto block = [&]<bool finite>() {
    if (out.by_x)
      return water_.bernoulli ? &WaveField::pressure_of_block<true, true, finite>
                              : &WaveField::pressure_of_block<true, false, finite>;
    return water_.bernoulli ? &WaveField::pressure_of_block<false, true, finite>
                            : &WaveField::pressure_of_block<false, false, finite>;
  };
  const auto chosen =
      finite_ ? block.template operator()<true>() : block.template operator()<false>();
  for (int first = 0; first < points.size; first += block_size)
    (this->*chosen)(view, points, first, out);
}

} // namespace hydrodae::hull
