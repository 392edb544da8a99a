#include "hydrodae/build/check_radiation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::build {

namespace {

// How negative damping may be, of the largest. Fits are made passive; tables of real meshes have
// irregular frequencies (F3OF: 1.3 %), cut kernels ripple (sphere: 0.15 %).
constexpr double allowed_fit = 1e-3;
constexpr double allowed_table = 0.05;
constexpr double own = 0.05;        ///< the same for one coordinate, of its own largest
constexpr double negligible = 1e-4; ///< of the largest: what belongs to a coordinate below is noise
constexpr double budget = 4e8;      ///< multiplications that the check may take

/// Hermitian part of H(iw), by the masses of the coordinates once scaled [1/s].
struct Damping {
  double frequency = 0.0; ///< [rad/s]
  MatrixX real;           ///< symmetric part of Re H
  MatrixX imaginary;      ///< antisymmetric part of Im H; empty where it is not looked at
};

/// sqrt of mass and added mass of each coordinate on itself: damping over mass is a rate that
/// bodies of all sizes share.
VectorX mass_scale(const system::System& s) {
  const system::HydroData& h = s.hydro;
  VectorX scale(h.n_moving);
  for (int u = 0; u < h.n_moving; ++u) {
    const system::HydroData::Coordinate& k = h.coordinates[static_cast<std::size_t>(u)];
    const system::BodyData& b =
        s.bodies[static_cast<std::size_t>(h.bodies[static_cast<std::size_t>(k.hydro_body)].body)];
    const double mass = k.component < 3 ? b.mass : b.inertia(k.component - 3, k.component - 3);
    scale[u] = std::sqrt(std::max(mass + h.added_mass(u, u), 1e-300));
  }
  return scale;
}

void scale_by(const VectorX& mass, Damping& d) {
  const auto inverse = mass.cwiseInverse().asDiagonal();
  d.real = 0.5 * (inverse * MatrixX(d.real + d.real.transpose()) * inverse);
  if (d.imaginary.size() > 0)
    d.imaginary = 0.5 * (inverse * MatrixX(d.imaginary - d.imaginary.transpose()) * inverse);
}

/// Poles with their rows and columns, from the states.
struct Poles {
  Eigen::VectorXcd poles;
  Eigen::MatrixXcd input, output; ///< (n_poles, n_moving), (n_moving, n_poles)
};

Poles poles_of(const system::HydroData& h) {
  const auto n = static_cast<Index>(h.blocks.size());
  Poles out{Eigen::VectorXcd(n), Eigen::MatrixXcd::Zero(n, h.n_moving),
            Eigen::MatrixXcd::Zero(h.n_moving, n)};
  std::vector<Index> block(static_cast<std::size_t>(h.n_states));
  for (Index k = 0; k < n; ++k) {
    const system::HydroData::Block& b = h.blocks[static_cast<std::size_t>(k)];
    out.poles[k] = {b.a, b.pair ? b.b : 0.0};
    block[static_cast<std::size_t>(b.state)] = k;
    if (b.pair)
      block[static_cast<std::size_t>(b.state + 1)] = k;
    for (Index u = 0; u < h.n_moving; ++u)
      out.output(u, k) = {h.output(u, b.state), b.pair ? -h.output(u, b.state + 1) : 0.0};
  }
  for (const system::HydroData::Input& in : h.inputs) {
    const Index k = block[static_cast<std::size_t>(in.state)];
    const bool second = in.state != h.blocks[static_cast<std::size_t>(k)].state;
    out.input(k, in.coordinate) += second ? std::complex<double>(0.0, in.value) : in.value;
  }
  return out;
}

/// From far below the slowest to far above the fastest pole, and near each of them.
std::vector<double> pole_frequencies(const Poles& p, std::size_t most) {
  const VectorX size = p.poles.cwiseAbs();
  std::vector<double> near, out;
  for (Index k = 0; k < p.poles.size(); ++k)
    for (double part : {0.0, 0.5, -0.5, 1.5})
      near.push_back(std::abs(p.poles[k].imag()) + part * std::abs(p.poles[k].real()));
  std::sort(near.begin(), near.end());
  const std::size_t coarse = std::max<std::size_t>(most / 3, 12);
  const double low = 0.01 * size.minCoeff(), high = 100.0 * size.maxCoeff();
  for (std::size_t k = 0; k < coarse; ++k)
    out.push_back(low *
                  std::pow(high / low, static_cast<double>(k) / static_cast<double>(coarse - 1)));
  const std::size_t stride =
      std::max<std::size_t>(1, near.size() / std::max<std::size_t>(most - coarse, 1));
  for (std::size_t k = 0; k < near.size(); k += stride)
    if (near[k] > 0.0)
      out.push_back(near[k]);
  return out;
}

/// H(iw) = sum_k (C B / (iw - p) + conj(C B) / (iw - conj p)) / 2, C B / (iw - p) for real poles.
std::vector<Damping> of_fit(const system::HydroData& h) {
  const Poles p = poles_of(h);
  const double cost =
      static_cast<double>(h.n_moving) * h.n_moving * static_cast<double>(p.poles.size());
  const auto most = static_cast<std::size_t>(std::clamp(budget / (4.0 * cost), 16.0, 400.0));
  const bool both = h.n_moving <= 60;
  std::vector<Damping> out;
  for (double w : pole_frequencies(p, most)) {
    // Re and Im of the sum as real products of [Re C, Im C] with weighted [Re B, Im B].
    Eigen::VectorXcd plus(p.poles.size()), minus(p.poles.size());
    for (Index k = 0; k < p.poles.size(); ++k) {
      const std::complex<double> iw(0.0, w);
      const bool pair = p.poles[k].imag() != 0.0;
      plus[k] = (pair ? 0.5 : 1.0) / (iw - p.poles[k]);
      minus[k] = pair ? 0.5 / (iw - std::conj(p.poles[k])) : 0.0;
    }
    Damping d{w, {}, {}};
    // C B plus + conj(C B) minus
    const Eigen::MatrixXcd first = plus.asDiagonal() * p.input,
                           second = minus.asDiagonal() * p.input.conjugate();
    d.real = p.output.real() * (first + second).real() + p.output.imag() * (second - first).imag();
    if (both)
      d.imaginary =
          p.output.real() * (first + second).imag() + p.output.imag() * (first - second).real();
    out.push_back(std::move(d));
  }
  return out;
}

/// int_0^T K cos(w t) dt by trapezoids over the samples of the splines.
std::vector<Damping> of_kernel(const system::HydroData& h) {
  const system::Convolution& c = h.convolution;
  const Index n = c.splines.rows() - 2;
  const auto pairs = static_cast<Index>(c.n_moving_pairs);
  MatrixX samples =
      (c.splines.topRows(n).leftCols(pairs) + 4.0 * c.splines.middleRows(1, n).leftCols(pairs) +
       c.splines.bottomRows(n).leftCols(pairs)) /
      6.0;
  samples.row(0) *= 0.5;
  const double cost = static_cast<double>(n) * static_cast<double>(pairs);
  const auto count = static_cast<Index>(std::clamp(budget / (8.0 * cost), 16.0, 200.0));
  const double low = 0.5 / c.length, high = 0.5 * pi / c.step;
  MatrixX cosine(count, n);
  VectorX frequency(count);
  for (Index i = 0; i < count; ++i) {
    frequency[i] =
        low * std::pow(high / low, static_cast<double>(i) / static_cast<double>(count - 1));
    for (Index k = 0; k < n; ++k)
      cosine(i, k) = c.step * std::cos(frequency[i] * c.step * static_cast<double>(k));
  }
  const MatrixX values = cosine * samples;
  std::vector<Damping> out;
  for (Index i = 0; i < count; ++i) {
    Damping d{frequency[i], MatrixX::Zero(h.n_moving, h.n_moving), {}};
    for (Index p = 0; p < pairs; ++p) {
      const system::Convolution::Pair& pair = c.pairs[static_cast<std::size_t>(p)];
      d.real(pair.row, pair.column) = values(i, p);
    }
    out.push_back(std::move(d));
  }
  return out;
}

std::string coordinate_name(const system::System& s, Index u) {
  const system::HydroData::Coordinate& k = s.hydro.coordinates[static_cast<std::size_t>(u)];
  const system::HydroBody& body = s.hydro.bodies[static_cast<std::size_t>(k.hydro_body)];
  return s.bodies[static_cast<std::size_t>(body.body)].name + " in " +
         std::string(model::coordinate_names[static_cast<std::size_t>(k.component)]);
}

[[noreturn]] void refuse(const system::System& s, const std::string& what, Index u,
                         double frequency, double part) {
  char size[32], at[32];
  std::snprintf(size, sizeof size, "%.2g", 100.0 * part);
  std::snprintf(at, sizeof at, "%.3g", frequency);
  throw ModelError("hydro.database",
                   "the radiation would feed the motion of " + coordinate_name(s, u) + ": " + what +
                       " falls to -" + size + " % of its largest at " + at +
                       " rad/s, and damping must not be negative. Check signs, mesh and irregular "
                       "frequencies of the source, and make the database or its fit again; "
                       "solver.force (--force) runs it none the less");
}

/// As a real symmetric matrix, of a Hermitian one R + i I twice as large: [[R, -I], [I, R]].
MatrixX symmetric(const Damping& d) {
  if (d.imaginary.size() == 0)
    return d.real;
  const Index n = d.real.rows();
  MatrixX out(2 * n, 2 * n);
  out << d.real, -d.imaginary, d.imaginary, d.real;
  return out;
}

/// The smallest eigenvalue and the coordinate that has most of its vector.
std::pair<double, Index> lowest(const Damping& d) {
  const auto [value, vector] = lowest_eigenpair(symmetric(d));
  const Index n = d.real.rows();
  VectorX squares = vector.head(n).cwiseAbs2();
  if (vector.size() > n)
    squares += vector.tail(n).cwiseAbs2();
  Index u = 0;
  squares.maxCoeff(&u);
  return {value, u};
}

bool is_positive(const Damping& d, double shift) {
  MatrixX shifted = symmetric(d);
  shifted.diagonal().array() += shift;
  return is_positive_definite(shifted);
}

/// @param largest  of each coordinate over all frequencies, over its mass
void judge(const system::System& s, const std::vector<Damping>& all, const VectorX& largest,
           const std::string& what, double allowed) {
  const double scale = largest.maxCoeff();
  if (!(scale > 0.0))
    return; // no radiation at all
  const Damping* worst_own = nullptr;
  double part = own;
  Index coordinate = 0;
  for (const Damping& d : all)
    for (Index u = 0; u < largest.size(); ++u)
      if (largest[u] > negligible * scale && -d.real(u, u) > part * largest[u]) {
        part = -d.real(u, u) / largest[u];
        worst_own = &d;
        coordinate = u;
      }
  if (worst_own)
    refuse(s, what, coordinate, worst_own->frequency, part);
  const Damping* worst = nullptr;
  double least = -allowed * scale;
  Index which = 0;
  for (const Damping& d : all) {
    if (is_positive(d, -least))
      continue;
    const auto [value, u] = lowest(d);
    if (value < least) {
      least = value;
      worst = &d;
      which = u;
    }
  }
  if (worst)
    refuse(s, what, which, worst->frequency, -least / scale);
}

} // namespace

void check_radiation(const model::Scene& scene, const system::System& s, const VectorX& largest) {
  const system::HydroData& h = s.hydro;
  if (scene.solver.force || !h.radiates())
    return;
  const VectorX mass = mass_scale(s);
  std::vector<Damping> all;
  std::string what = "Re H of the memory fit";
  for (const system::HydroData::Block& b : h.blocks)
    if (!(b.a < 0.0))
      throw ModelError("hydro.database", "the memory fit has a pole of real part " +
                                             number_text(b.a) +
                                             " 1/s: it must be negative, else the memory grows by "
                                             "itself; fit it again with hydrodae hdb fit");
  if (h.damped) {
    what = "the radiation damping";
    all.push_back({*scene.hydro->frequency, h.damping, {}});
  } else if (!h.convolution.empty()) {
    what = "the transform of the radiation kernel";
    all = of_kernel(h);
  } else {
    all = of_fit(h);
  }
  VectorX most = VectorX::Zero(h.n_moving);
  if (h.damped)
    most = largest.cwiseQuotient(mass.cwiseAbs2());
  for (Damping& d : all) {
    scale_by(mass, d);
    most = most.cwiseMax(d.real.diagonal().cwiseAbs());
  }
  judge(s, all, most, what, h.damped || !h.convolution.empty() ? allowed_table : allowed_fit);
}

} // namespace hydrodae::build
