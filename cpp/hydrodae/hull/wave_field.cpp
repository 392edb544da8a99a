#include "hydrodae/hull/wave_field.h"

#include <algorithm>
#include <array>

#include "hydrodae/core/error.h"

namespace hydrodae::hull {
namespace {

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

/// The fields of a set at a block of points.
using Fields = Eigen::Array<double, block_size, set_size>;

/// Length of a block, in whole registers of any instruction set.
int padded(int size) { return (size + 2 * lanes - 1) / (2 * lanes) * (2 * lanes); }

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
  basis_ = make_basis(waves, reach + crest, finite_);
  const auto list = [&](const auto& of) {
    std::vector<double> out;
    for (const Wave& w : basis_.waves)
      out.push_back(of(w));
    return out;
  };
  const auto x = [](const Wave& w) { return w.wavenumber * std::cos(w.heading); };
  const auto y = [](const Wave& w) { return w.wavenumber * std::sin(w.heading); };
  const auto speed = [&](const Wave& w) { return water.gravity / w.omega; };
  const auto mirror = [&](const Wave& w) { return std::exp(-2.0 * w.wavenumber * water.depth); };
  const auto k = [](const Wave& w) { return w.wavenumber; };
  lists_ = {list([](const Wave& w) { return w.omega; }),
            list([](const Wave& w) { return w.phase; }),
            list(k),
            list(x),
            list(y),
            list([](const Wave& w) { return w.amplitude; }),
            list([&](const Wave& w) { return 1.0 / (1.0 + mirror(w)); }),
            list(mirror)};
  for (const Wave& w : waves)
    steep_ += std::abs(w.amplitude) * w.wavenumber;
  most_ = most;
  // Derivatives of q = Re(A e^{kc}), A e^{-ks} included, and those of the potential Re(i g/w A
  // e^{kc}): the first ones and d2/ds2, then the others.
  const auto one = list([](const Wave&) { return 1.0; });
  const auto flow = [&](const auto& a, const auto& b) {
    return list([&](const Wave& w) { return speed(w) * a(w) * b(w); });
  };
  const auto unit = [](const Wave&) { return 1.0; };
  sets_[surface_set] = {{one, lists_.kx, lists_.ky, {}}, {0, -1, -1, 0}, {}};
  sets_[pressure_set] = {
      {one, lists_.kx, lists_.ky, lists_.k}, {0, -1, -1, 0}, {false, false, false, true}};
  sets_[flow_set] = {{flow(x, unit), flow(y, unit), flow(k, unit), flow(k, k)},
                     {0, 0, 1, 1},
                     {false, false, true, false}};
  sets_[flow_slope_set] = {
      {flow(x, x), flow(x, y), flow(x, k), flow(y, k)}, {-1, -1, 0, 0}, {false, false, true, true}};
}

WaveView WaveField::make_view() const {
  WaveView view;
  const std::size_t parts = 2 * basis_.waves.size();
  view.waves.surface.resize(parts);
  view.waves.up.resize(parts);
  view.waves.back.resize(parts);
  view.scratch.resize(static_cast<std::size_t>(moment_scratch(basis_)));
  for (Moments& of_set : view.moments)
    of_set.resize(moment_size(basis_, finite_));
  return view;
}

void WaveField::look(const Instant& instant, const Vector3& origin, WaveView& view,
                     bool gradients) const {
  const bool below =
      water_.stretching == Stretching::vertical || water_.stretching == Stretching::none;
  view.height = below ? std::min(origin[2], 0.0) : origin[2];
  view.most = instant.growth * most_;
  view.steep = instant.growth * steep_;
  Amplitudes& waves = view.waves;
  find_amplitudes(lists_, instant.time, instant.growth, origin, view.height, finite_, waves);
  const double *up = waves.up.data(), *back = finite_ ? waves.back.data() : nullptr;
  const int fields = gradients ? set_size : 1;
  const auto find = [&](Set set, int n, const double* with_up, const double* with_back) {
    find_moments(basis_, sets_[set], n, with_up, with_back, view.scratch.data(), view.moments[set]);
  };
  if (water_.stretching != Stretching::none)
    find(surface_set, fields, waves.surface.data(), nullptr);
  find(pressure_set, fields, up, back);
  if (water_.bernoulli) {
    find(flow_set, set_size, up, back);
    if (gradients)
      find(flow_slope_set, set_size, up, back);
  }
}

double WaveField::highest(const WaveView& view, double radius) const {
  if (water_.stretching == Stretching::none)
    return 0.0;
  return std::min(view.most, std::abs(view.waves.here) + view.steep * radius);
}

void WaveField::elevation(const WaveView& view, const PointLists& points,
                          const FieldLists& out) const {
  const std::array<double*, 3> lists{out.value, out.by_x, out.by_y};
  if (water_.stretching == Stretching::none) {
    for (double* list : lists)
      if (list)
        std::fill_n(list, points.size, 0.0);
    return;
  }
  Fields sum;
  for (int first = 0; first < points.size; first += block_size) {
    const Block x = read(points.x, first, points.size), y = read(points.y, first, points.size);
    const int size = padded(std::min(block_size, points.size - first));
    sum_fields(basis_, view.moments[surface_set], false, out.by_x ? set_size : 1,
               {size, x.data(), y.data()}, sum.data());
    for (int i = 0; i < 3; ++i)
      if (double* list = lists[static_cast<std::size_t>(i)])
        write(sum.col(i), first, points.size, list);
  }
}

template <bool gradient, bool bernoulli>
void WaveField::pressure_of_block(const WaveView& view, const PointLists& points, int first,
                                  const FieldLists& out) const {
  const Block x = read(points.x, first, points.size), y = read(points.y, first, points.size);
  const int size = padded(std::min(block_size, points.size - first));
  Fields sum, flow, slope;
  Surface surface;
  if (water_.stretching == Stretching::wheeler) { // the height s needs the elevation first
    sum_fields(basis_, view.moments[surface_set], false, gradient ? set_size : 1,
               {size, x.data(), y.data()}, sum.data());
    surface.eta = sum.col(0);
    if constexpr (gradient) {
      surface.by_x = sum.col(1);
      surface.by_y = sum.col(2);
    }
  }
  const Height at = height(water_, surface, read(points.z, first, points.size));
  const Block rise = at.s - view.height;
  const PointBlock block{size, x.data(), y.data(), rise.data()};
  const auto add_up = [&](Set set, int fields, Fields& to) {
    sum_fields(basis_, view.moments[set], finite_, fields, block, to.data());
  };
  add_up(pressure_set, gradient ? set_size : 1, sum);
  const double rho = water_.density, weight = rho * water_.gravity;
  Block p = weight * sum.col(0);
  if constexpr (bernoulli) {
    add_up(flow_set, set_size, flow);
    p -= (0.5 * rho) * (flow.col(0).square() + flow.col(1).square() + flow.col(2).square());
  }
  write(p, first, points.size, out.value);
  if constexpr (gradient) {
    Block p_x = weight * sum.col(1), p_y = weight * sum.col(2), p_s = weight * sum.col(3);
    if constexpr (bernoulli) {
      add_up(flow_slope_set, set_size, slope);
      const auto u = flow.col(0), v = flow.col(1), w = flow.col(2), ss = flow.col(3);
      const auto xx = slope.col(0), xy = slope.col(1), xs = slope.col(2), ys = slope.col(3);
      p_x -= rho * (u * xx + v * xy + w * xs);
      p_y -= rho * (u * xy - v * (xx + ss) + w * ys); // no divergence
      p_s -= rho * (u * xs + v * ys + w * ss);
    }
    write(p_x + p_s * at.by_x, first, points.size, out.by_x);
    write(p_y + p_s * at.by_y, first, points.size, out.by_y);
    write(p_s * at.by_z, first, points.size, out.by_z);
  }
}

void WaveField::pressure(const WaveView& view, const PointLists& points,
                         const FieldLists& out) const {
  const auto of_block = out.by_x ? (water_.bernoulli ? &WaveField::pressure_of_block<true, true>
                                                     : &WaveField::pressure_of_block<true, false>)
                                 : (water_.bernoulli ? &WaveField::pressure_of_block<false, true>
                                                     : &WaveField::pressure_of_block<false, false>);
  for (int first = 0; first < points.size; first += block_size)
    (this->*of_block)(view, points, first, out);
}

} // namespace hydrodae::hull
