#include "hydrodae/hull/wave_basis.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hydrodae::hull {
namespace {

/// Largest h |c| of one band: rounding grows by e^{2 h |c|}.
constexpr double widest = 3.0;
/// Largest k r of harmonics, whose rounding grows by e^{k r}.
constexpr double farthest_turn = 8.0;
constexpr double least = 1e-13; ///< error of the sums

/// Operations of a plane wave at a point, of a term of a band and of a harmonic.
constexpr double plane_cost = 60.0, term_cost = 6.0, harmonic_cost = 5.0;

/// Terms for the error `least`; `width` is h |c|.
int term_count(double width) {
  double error = std::exp(2.0 * width);
  int m = 0;
  while (error > least && m < 100)
    error *= width / ++m;
  return std::max(m, 1);
}

int terms_of(const std::vector<const Wave*>& band, double reach) {
  const double range = band.back()->wavenumber - band.front()->wavenumber;
  return range > 0.0 ? term_count(0.5 * range * reach) : 1;
}

void add_band(const std::vector<const Wave*>& all, double reach, WaveBasis& out) {
  Band band;
  band.first = out.places();
  band.k = 0.5 * (all.front()->wavenumber + all.back()->wavenumber);
  band.terms = terms_of(all, reach);
  band.cosine = std::cos(all.front()->heading);
  band.sine = std::sin(all.front()->heading);
  for (const Wave* wave : all)
    out.waves.push_back(*wave);
  Wave none = *all.back();
  none.amplitude = 0.0;
  while (out.places() % lanes != 0)
    out.waves.push_back(none);
  band.places = out.places() - band.first;
  band.first_weight = static_cast<int>(out.weights.size());
  std::vector<double> row(static_cast<std::size_t>(band.places), 1.0);
  for (int m = 0; m < band.terms; ++m)
    for (int j = 0; j < band.places; ++j) {
      double& weight = row[static_cast<std::size_t>(j)];
      const Wave& wave = out.waves[static_cast<std::size_t>(band.first + j)];
      out.weights.push_back(weight);
      weight *= (wave.wavenumber - band.k) * out.length / (m + 1);
    }
  out.bands.push_back(band);
}

/// Least degree with the error `least` of sum |a_j|; -1: no degree is exact enough.
int least_degree(const std::vector<Wave>& waves, double reach) {
  double whole = 0.0;
  std::vector<double> rest;
  for (const Wave& w : waves) {
    const double turn = w.wavenumber * reach;
    if (!(turn <= farthest_turn))
      return -1;
    whole += std::abs(w.amplitude);
    rest.push_back(std::abs(w.amplitude) * turn * (1.0 + turn)); // (1 + k r): of the gradient, too
  }
  for (int degree = 0;; ++degree) {
    double sum = 0.0;
    for (const double r : rest)
      sum += r;
    if (!(sum > least * whole))
      return degree;
    for (std::size_t j = 0; j < rest.size(); ++j)
      rest[j] *= waves[j].wavenumber * reach / (degree + 2);
  }
}

int harmonic_count(int degree) { return (degree + 1) * (degree + 2) / 2; }

void fill(int degree, WaveBasis& out) {
  Harmonics& h = out.harmonics;
  h.degree = degree;
  double first = 1.0; // g_mm = 1 / (2^m m!)
  for (int m = 0; m <= degree; ++m) {
    double scale = first;
    for (int n = m; n <= degree; ++n) {
      const double n2_m2 = n * n - m * m, below = (n - 1) * (n - 1) - m * m;
      if (n > m)
        scale *= (2 * n - 1) / n2_m2;
      h.recurrence.push_back(n > m + 1 ? below / ((2.0 * n - 1.0) * (2.0 * n - 3.0)) : 0.0);
      h.scale.push_back((m == 0 ? 1.0 : 2.0) * scale);
    }
    first /= 2.0 * (m + 1);
  }
  for (int n = 0; n <= degree; ++n)
    for (const Wave& w : out.waves)
      h.powers.push_back(std::pow(w.wavenumber * out.length, n));
  for (const bool sine : {false, true})
    for (int m = 0; m <= degree; ++m)
      for (const Wave& w : out.waves)
        h.turns.push_back(sine ? std::sin(m * w.heading) : std::cos(m * w.heading));
}

} // namespace

int WaveBasis::terms() const {
  if (harmonics.degree >= 0)
    return harmonic_count(harmonics.degree);
  int sum = 0;
  for (const Band& band : bands)
    sum += band.terms;
  return sum;
}

WaveBasis make_basis(const std::vector<Wave>& waves, double reach, bool finite) {
  WaveBasis out;
  if (std::isfinite(reach) && reach > 0.0)
    out.length = reach;
  std::vector<const Wave*> sorted;
  for (const Wave& w : waves)
    sorted.push_back(&w);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Wave* a, const Wave* b) {
    return std::tie(a->heading, a->wavenumber) < std::tie(b->heading, b->wavenumber);
  });
  for (std::size_t first = 0; first < sorted.size();) {
    std::vector<const Wave*> band;
    while (
        first < sorted.size() && (band.empty() || sorted[first]->heading == band[0]->heading) &&
        (band.empty() || (sorted[first]->wavenumber - band[0]->wavenumber) * 0.5 * reach <= widest))
      band.push_back(sorted[first++]);
    const auto own = static_cast<double>(band.size());
    if (plane_cost + term_cost * terms_of(band, reach) < own * (plane_cost + term_cost))
      add_band(band, reach, out);
    else
      for (const Wave* wave : band)
        add_band({wave}, reach, out);
  }
  double cost = 0.0;
  for (const Band& band : out.bands)
    cost += (finite ? 2.0 : 1.0) * (plane_cost + term_cost * band.terms);
  const int degree = least_degree(waves, reach);
  if (degree >= 0 && harmonic_cost * harmonic_count(degree) < cost) {
    // One list of all waves without gaps.
    out.bands.clear();
    out.weights.clear();
    out.waves = waves;
    while (!out.waves.empty() && out.places() % lanes != 0) {
      out.waves.push_back(out.waves.back());
      out.waves.back().amplitude = 0.0;
    }
    fill(degree, out);
  }
  return out;
}

} // namespace hydrodae::hull
