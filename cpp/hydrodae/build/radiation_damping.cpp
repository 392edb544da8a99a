/// Hermitian part of what the radiation does, set by set of coupled coordinates.

#include "hydrodae/build/radiation_damping.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "hydrodae/math/dense_cholesky.h"
#include "hydrodae/math/sets.h"

namespace hydrodae::build {

namespace {

using Rows = Damping::Rows;

constexpr double budget = 4e8; ///< multiplications that the sums may take

/// table^T weights (n_frequencies, n_columns) for weights (n, n_frequencies); the columns of
/// `weights` are filled up with zeros to whole registers.
/// @param fill  writes the column of that number of the table, zero at first
template <class Fill>
Rows weighted(const Rows& weights, Index n_frequencies, Index n_columns, Fill&& fill) {
  const Index strip = std::min<Index>(4 * dense::lanes, dense::padded(n_columns));
  Rows table(weights.rows(), strip), part(weights.cols(), strip), out(n_frequencies, n_columns);
  for (Index first = 0; first < n_columns; first += strip) {
    const Index count = std::min(strip, n_columns - first);
    table.setZero();
    part.setZero();
    for (Index i = 0; i < count; ++i)
      fill(first + i, table.col(i));
    dense::kernels().add_product(weights.rows(), weights.cols(), weights.data(), strip,
                                 table.data(), part.data());
    out.middleCols(first, count) = part.topLeftCorner(n_frequencies, count);
  }
  return out;
}

/// Coordinates that feel each other through the memory, with its poles, rows and columns over
/// sqrt(mass).
struct Poles {
  std::vector<Index> coordinates;
  Eigen::VectorXcd poles;
  Eigen::MatrixXcd input, output; ///< both (n_poles, n_coordinates)
};

/// The blocks of each state; of a pair both.
std::vector<Index> blocks_of_states(const system::HydroData& h) {
  std::vector<Index> out(static_cast<std::size_t>(h.n_states));
  for (std::size_t k = 0; k < h.blocks.size(); ++k)
    for (int n = 0; n < (h.blocks[k].pair ? 2 : 1); ++n)
      out[static_cast<std::size_t>(h.blocks[k].state + n)] = static_cast<Index>(k);
  return out;
}

/// Calls `visit` with coordinate, state and value of each nonzero of C.
template <class Visit> void for_outputs(const system::HydroData& h, Visit&& visit) {
  for (std::size_t i = 0; i < h.bodies.size(); ++i)
    for (const int u : h.bodies[i].moving)
      for (const int state : h.links[i].states)
        if (u >= 0 && h.output(u, state) != 0.0)
          visit(Index{u}, Index{state}, h.output(u, state));
}

/// The sets of coordinates that a block joins: all that it loads and that drive it.
std::vector<Poles> coupled_poles(const system::HydroData& h, const VectorX& root_mass) {
  const std::vector<Index> block = blocks_of_states(h);
  const Index n = h.n_moving;
  Sets sets(n + std::ssize(h.blocks)); // of coordinates, then blocks
  std::vector<bool> loads(h.blocks.size());
  for_outputs(h, [&](Index u, Index state, double) {
    const Index k = block[static_cast<std::size_t>(state)];
    sets.join(u, n + k);
    loads[static_cast<std::size_t>(k)] = true;
  });
  for (const system::HydroData::Input& in : h.inputs)
    if (const Index k = block[static_cast<std::size_t>(in.state)];
        loads[static_cast<std::size_t>(k)])
      sets.join(in.coordinate, n + k);
  const Sets::Lists lists = sets.lists();
  std::vector<Poles> out;
  for (const std::vector<Index>& members : lists.members) {
    const auto first = std::lower_bound(members.begin(), members.end(), n);
    Poles& p = out.emplace_back();
    p.coordinates.assign(members.begin(), first);
    p.poles.resize(members.end() - first);
    for (Index k = 0; k < p.poles.size(); ++k) {
      const system::HydroData::Block& b = h.blocks[static_cast<std::size_t>(first[k] - n)];
      p.poles[k] = {b.a, b.pair ? b.b : 0.0};
    }
    p.input = p.output = Eigen::MatrixXcd::Zero(p.poles.size(), std::ssize(p.coordinates));
  }
  const auto add = [&](Eigen::MatrixXcd Poles::* matrix, Index u, Index state, double value,
                       std::complex<double> second) {
    const auto k = static_cast<std::size_t>(block[static_cast<std::size_t>(state)]);
    const std::size_t at = k + static_cast<std::size_t>(n);
    Poles& p = out[lists.set[at]];
    if (loads[k])
      (p.*matrix)(lists.place[at] - std::ssize(p.coordinates),
                  lists.place[static_cast<std::size_t>(u)]) +=
          value / root_mass[u] * (state == h.blocks[k].state ? 1.0 : second);
  };
  for_outputs(h, [&](Index u, Index state, double value) { // Re(C z) = Re C Re z - Im C Im z
    add(&Poles::output, u, state, value, {0.0, -1.0});
  });
  for (const system::HydroData::Input& in : h.inputs)
    add(&Poles::input, in.coordinate, in.state, in.value, {0.0, 1.0});
  std::erase_if(out, [](const Poles& p) { return p.input.size() == 0; });
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

/// H(iw) = sum_k (C B / (iw - p) + conj(C B) / (iw - conj p)) / 2, C B / (iw - p) for real poles:
/// the real and imaginary parts of C B, symmetric or antisymmetric, by weights of the frequency.
Damping of_fit(Poles p, std::size_t most) {
  Damping d{std::move(p.coordinates), pole_frequencies(p, most), {}, {}};
  const Index n = d.size(), m = p.poles.size(), count = std::ssize(d.frequency);
  Rows real = Rows::Zero(2 * m, dense::padded(count)), imaginary = real;
  for (Index i = 0; i < count; ++i)
    for (Index k = 0; k < m; ++k) {
      const double w = d.frequency[static_cast<std::size_t>(i)], a = p.poles[k].real(),
                   b = p.poles[k].imag();
      const auto part = [&](double shift) { // 1 / (i w - a - i shift)
        return std::complex<double>(-a, shift - w) / (a * a + (w - shift) * (w - shift));
      };
      const std::complex<double> plus = (b != 0.0 ? 0.5 : 1.0) * part(b),
                                 minus = b != 0.0 ? 0.5 * part(-b) : 0.0;
      real(k, i) = (plus + minus).real();
      real(m + k, i) = (minus - plus).imag();
      imaginary(k, i) = (plus + minus).imag();
      imaginary(m + k, i) = (plus - minus).real();
    }
  std::vector<std::pair<Index, Index>> entries;
  for (Index u = 0; u < n; ++u)
    for (Index v = 0; v <= u; ++v)
      entries.emplace_back(u, v);
  Eigen::VectorXcd uv(m), vu(m);
  const auto fill = [&](double sign) {
    return [&, sign](Index entry, auto column) {
      const auto [u, v] = entries[static_cast<std::size_t>(entry)];
      uv = 0.5 * p.output.col(u).cwiseProduct(p.input.col(v));
      vu = 0.5 * p.output.col(v).cwiseProduct(p.input.col(u));
      column.head(m) = uv.real() + sign * vu.real();
      column.tail(m) = uv.imag() + sign * vu.imag();
    };
  };
  d.real = weighted(real, count, std::ssize(entries), fill(1.0));
  d.imaginary = weighted(imaginary, count, std::ssize(entries), fill(-1.0));
  return d;
}

/// An entry of a matrix that is zero elsewhere.
struct Entry {
  Index row = 0, column = 0;
};

/// Coordinates that entries join, and for each place of the lower triangle its entries by number.
struct Coupled {
  Damping damping;
  std::vector<std::vector<std::size_t>> entries;
};

std::vector<Coupled> coupled(Index n, const std::vector<Entry>& entries) {
  Sets sets(n);
  for (const Entry& e : entries)
    sets.join(e.row, e.column);
  Sets::Lists lists = sets.lists();
  std::vector<Coupled> out;
  for (std::vector<Index>& members : lists.members) {
    Coupled& set = out.emplace_back();
    set.damping.coordinates = std::move(members);
    set.entries.resize(static_cast<std::size_t>(Damping::place(set.damping.size(), 0)));
  }
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto row = static_cast<std::size_t>(entries[k].row),
               column = static_cast<std::size_t>(entries[k].column);
    const Index at = Damping::place(lists.place[row], lists.place[column]);
    out[lists.set[row]].entries[static_cast<std::size_t>(at)].push_back(k);
  }
  return out;
}

/// Of an entry in the symmetric part over the masses.
double part_of(const Entry& e, const VectorX& root_mass) {
  return (e.row == e.column ? 1.0 : 0.5) / (root_mass[e.row] * root_mass[e.column]);
}

} // namespace

std::vector<Damping> damping_of_fit(const system::HydroData& h, const VectorX& root_mass) {
  std::vector<Poles> sets = coupled_poles(h, root_mass);
  double cost = 0.0;
  for (const Poles& p : sets)
    cost += static_cast<double>(p.input.size()) * static_cast<double>(p.input.cols());
  const auto most = static_cast<std::size_t>(std::clamp(budget / (4.0 * cost), 16.0, 400.0));
  std::vector<Damping> out;
  for (Poles& p : sets)
    out.push_back(of_fit(std::move(p), most));
  return out;
}

std::vector<Damping> damping_of_table(const system::HydroData& h, const VectorX& root_mass,
                                      double frequency) {
  std::vector<Entry> entries;
  for (Index v = 0; v < h.n_moving; ++v)
    for (Index u = 0; u < h.n_moving; ++u)
      if (h.damping(u, v) != 0.0)
        entries.push_back({u, v});
  std::vector<Damping> out;
  for (Coupled& set : coupled(h.n_moving, entries)) {
    Damping& d = out.emplace_back(std::move(set.damping));
    d.frequency = {frequency};
    d.real = Damping::Rows::Zero(1, std::ssize(set.entries));
    for (std::size_t at = 0; at < set.entries.size(); ++at)
      for (const std::size_t k : set.entries[at])
        d.real(0, static_cast<Index>(at)) +=
            part_of(entries[k], root_mass) * h.damping(entries[k].row, entries[k].column);
  }
  return out;
}

// By trapezoids over the samples of the splines.
std::vector<Damping> damping_of_kernel(const system::HydroData& h, const VectorX& root_mass) {
  const system::Convolution& c = h.convolution;
  const Index n = c.splines.rows() - 2;
  const double cost = static_cast<double>(n) * static_cast<double>(c.n_moving_pairs);
  const auto count = static_cast<Index>(std::clamp(budget / (8.0 * cost), 16.0, 200.0));
  const double low = 0.5 / c.length, high = 0.5 * pi / c.step;
  std::vector<double> frequency;
  Rows cosine = Rows::Zero(n, dense::padded(count));
  for (Index i = 0; i < count; ++i) {
    frequency.push_back(
        low * std::pow(high / low, static_cast<double>(i) / static_cast<double>(count - 1)));
    for (Index k = 0; k < n; ++k)
      cosine(k, i) = (k == 0 ? 0.5 : 1.0) * c.step *
                     std::cos(frequency.back() * c.step * static_cast<double>(k));
  }
  std::vector<Entry> entries;
  for (int p = 0; p < c.n_moving_pairs; ++p)
    entries.push_back(
        {c.pairs[static_cast<std::size_t>(p)].row, c.pairs[static_cast<std::size_t>(p)].column});
  std::vector<Damping> out;
  for (Coupled& set : coupled(h.n_moving, entries)) {
    Damping& d = out.emplace_back(std::move(set.damping));
    d.frequency = frequency;
    d.real = weighted(cosine, count, std::ssize(set.entries), [&](Index at, auto column) {
      for (const std::size_t k : set.entries[static_cast<std::size_t>(at)]) {
        const auto K = c.splines.col(static_cast<Index>(k));
        column +=
            part_of(entries[k], root_mass) / 6.0 * (K.head(n) + 4.0 * K.segment(1, n) + K.tail(n));
      }
    });
  }
  return out;
}

} // namespace hydrodae::build
