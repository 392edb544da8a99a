/// Hermitian part of H(iw) of the memory fit, set by set of coupled coordinates:
///   H(iw) = sum_k (C_k B_k / (iw - p_k) + conj(C_k B_k) / (iw - conj p_k)) / 2,
/// with C_k B_k / (iw - p_k) for real poles. Only coordinates that drive a pole or are loaded by it
/// enter, so that the cost follows the coupling.

#include <algorithm>
#include <span>

#include "hydrodae/build/fit_poles.h"
#include "hydrodae/build/radiation_damping.h"
#include "hydrodae/build/weighted_sums.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::build {

namespace {

using Rows = Damping::Rows;
using Complex = std::complex<double>;

/// Factors of the real and imaginary parts of C B in the Hermitian part, at each frequency.
struct Weights {
  Rows real, imaginary; ///< (2 n_poles, padded n_frequencies): factors of Re C B, then of Im C B

  Weights(const Eigen::VectorXcd& poles, const std::vector<double>& frequency) {
    const Index m = poles.size();
    real.setZero(2 * m, dense::padded(std::ssize(frequency)));
    imaginary = real;
    for (Index i = 0; i < std::ssize(frequency); ++i)
      for (Index k = 0; k < m; ++k) {
        const double w = frequency[static_cast<std::size_t>(i)], a = poles[k].real(),
                     b = poles[k].imag();
        const auto part = [&](double shift) { // 1 / (i w - a - i shift)
          return Complex(-a, shift - w) / (a * a + (w - shift) * (w - shift));
        };
        const Complex plus = (b != 0.0 ? 0.5 : 1.0) * part(b),
                      minus = b != 0.0 ? 0.5 * part(-b) : 0.0;
        real(k, i) = (plus + minus).real();
        real(m + k, i) = (minus - plus).imag();
        imaginary(k, i) = (plus + minus).imag();
        imaginary(m + k, i) = (plus - minus).real();
      }
  }
};

/// Rows of `weights` for the poles of these terms, first for Re C B, then for Im C B.
Rows rows_of(const Rows& weights, const std::vector<Term>& terms) {
  const Index m = weights.rows() / 2, n = std::ssize(terms);
  Rows out(2 * n, weights.cols());
  for (Index i = 0; i < n; ++i) {
    out.row(i) = weights.row(terms[static_cast<std::size_t>(i)].pole);
    out.row(n + i) = weights.row(m + terms[static_cast<std::size_t>(i)].pole);
  }
  return out;
}

bool same_poles(const std::vector<Term>& a, const std::vector<Term>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Term& x, const Term& y) { return x.pole == y.pole; });
}

/// Weighted symmetric part of Re C B and Im C B (sign 1), or antisymmetric part (-1).
Rows sums(const Poles& p, const Rows& weights, Index n_frequencies,
          std::span<const Definite::Place> places, double sign) {
  Rows out(n_frequencies, std::ssize(places));
  for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
    const std::vector<Term>& terms = p.terms[static_cast<std::size_t>(places[first].column)];
    while (end < places.size() &&
           same_poles(terms, p.terms[static_cast<std::size_t>(places[end].column)]))
      ++end;
    const auto n = std::ssize(terms), count = static_cast<Index>(end - first);
    out.middleCols(static_cast<Index>(first), count) =
        weighted(rows_of(weights, terms), n_frequencies, count, [&](Index entry, auto column) {
          const Definite::Place place = places[first + static_cast<std::size_t>(entry)];
          const std::vector<Term>&own = p.terms[static_cast<std::size_t>(place.column)],
                &others = p.terms[static_cast<std::size_t>(place.row)];
          auto u = others.begin();
          for (Index k = 0; k < n; ++k) {
            const Term& v = own[static_cast<std::size_t>(k)];
            while (u != others.end() && u->pole < v.pole)
              ++u;
            if (u == others.end() || u->pole != v.pole)
              continue;
            const Complex uv = 0.5 * u->output * v.input, vu = 0.5 * v.output * u->input;
            column[k] = uv.real() + sign * vu.real();
            column[n + k] = uv.imag() + sign * vu.imag();
          }
        });
  }
  return out;
}

/// Multiplications of `sums` for each frequency, for the whole matrix.
double work(const Poles& p, const std::vector<Definite::Place>& places) {
  double out = 0.0;
  for (const Definite::Place& at : places)
    out += (at.row == at.column ? 1.0 : 2.0) *
           static_cast<double>(p.terms[static_cast<std::size_t>(at.column)].size());
  return out;
}

} // namespace

Judged damping_of(const water::ExponentialRadiation& rung, const VectorX& root_mass) {
  for (const water::ExponentialRadiation::Block& b : rung.blocks)
    if (!(b.a < 0.0))
      throw ModelError("hydro.database", "the memory fit has a pole of real part " +
                                             number_text(b.a) +
                                             " 1/s: it must be negative, else the memory grows by "
                                             "itself; fit it again with hydrodae hdb fit");
  Judged found{"Re H of the memory fit", 1e-3}; // fits are made passive
  const std::vector<Poles> sets = coupled_poles(rung, root_mass);
  std::vector<std::vector<Definite::Place>> places;
  double cost = 0.0, largest = 0.0;
  for (const Poles& p : sets)
    cost += work(p, places.emplace_back(coupled_places(p)));
  const auto most = static_cast<std::size_t>(std::clamp(sum_budget / (4.0 * cost), 16.0, 400.0));
  std::vector<Damping>& out = found.sets;
  std::vector<Weights> weights;
  for (const Poles& p : sets) {
    Damping& d = out.emplace_back();
    d.coordinates = p.coordinates;
    d.frequency = pole_frequencies(p, most);
    std::vector<Definite::Place> own;
    for (Index u = 0; u < d.size(); ++u)
      own.push_back({u, u});
    weights.emplace_back(p.poles, d.frequency);
    d.diagonal = sums(p, weights.back().real, std::ssize(d.frequency), own, 1.0);
    largest = std::max(largest, d.diagonal.cwiseAbs().maxCoeff());
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (least_by_residues(sets[i]) >= -found.allowed * largest)
      continue;
    Damping& d = out[i];
    const Index count = std::ssize(d.frequency);
    d.places = std::move(places[i]);
    d.real = sums(sets[i], weights[i].real, count, d.places, 1.0);
    d.imaginary = sums(sets[i], weights[i].imaginary, count, d.places, -1.0);
  }
  return found;
}

} // namespace hydrodae::build
