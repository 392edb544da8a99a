/// Damping of tables and kernels, for each set of coupled coordinates.

#include "hydrodae/build/radiation_damping.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hydrodae/build/weighted_sums.h"
#include "hydrodae/math/sets.h"

namespace hydrodae::build {

namespace {

using Rows = Damping::Rows;

/// Nonzero entry of a matrix.
struct Entry {
  Index row = 0, column = 0;
};

/// Coordinates joined by entries, and the numbers of the entries at each place.
struct Coupled {
  Damping damping;
  std::vector<std::vector<std::size_t>> entries;
};

std::vector<Coupled> coupled(Index n, const std::vector<Entry>& entries) {
  Sets sets(n);
  for (const Entry& e : entries)
    sets.join(e.row, e.column);
  Sets::Lists lists = sets.lists();
  struct Numbered {
    Definite::Place place;
    std::size_t number = SIZE_MAX; ///< SIZE_MAX: a place on the diagonal without an entry
  };
  std::vector<std::vector<Numbered>> numbered(lists.members.size());
  for (std::size_t u = 0; u < lists.place.size(); ++u)
    numbered[lists.set[u]].push_back({{lists.place[u], lists.place[u]}});
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto row = static_cast<std::size_t>(entries[k].row),
               column = static_cast<std::size_t>(entries[k].column);
    const auto [low, high] = std::minmax(lists.place[row], lists.place[column]);
    numbered[lists.set[row]].push_back({{high, low}, k});
  }
  std::vector<Coupled> out(lists.members.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    Coupled& set = out[i];
    set.damping.coordinates = std::move(lists.members[i]);
    std::sort(numbered[i].begin(), numbered[i].end(), [](const Numbered& a, const Numbered& b) {
      return std::tie(a.place.column, a.place.row, a.number) <
             std::tie(b.place.column, b.place.row, b.number);
    });
    for (const Numbered& entry : numbered[i]) {
      std::vector<Definite::Place>& places = set.damping.places;
      if (places.empty() || places.back() != entry.place) {
        places.push_back(entry.place);
        set.entries.emplace_back();
      }
      if (entry.number != SIZE_MAX)
        set.entries.back().push_back(entry.number);
    }
  }
  return out;
}

void set_diagonal(Damping& d) {
  d.diagonal.resize(d.real.rows(), d.size());
  for (std::size_t at = 0; at < d.places.size(); ++at)
    if (d.places[at].row == d.places[at].column)
      d.diagonal.col(d.places[at].row) = d.real.col(static_cast<Index>(at));
}

/// Tables of real meshes have irregular frequencies (F3OF: 1.3 %), cut kernels ripple (sphere: 0.15
/// %).
constexpr double allowed_table = 0.05;

/// Factor of an entry in the symmetric part over the masses.
double part_of(const Entry& e, const VectorX& root_mass) {
  return (e.row == e.column ? 1.0 : 0.5) / (root_mass[e.row] * root_mass[e.column]);
}

} // namespace

Judged damping_of(const water::ConstantRadiation& rung, const VectorX& root_mass) {
  const Index n = root_mass.size();
  std::vector<Entry> entries;
  for (Index v = 0; v < n; ++v)
    for (Index u = 0; u < n; ++u)
      if (rung.damping(u, v) != 0.0)
        entries.push_back({u, v});
  Judged out{"the radiation damping", allowed_table, {}, rung.largest};
  for (Coupled& set : coupled(n, entries)) {
    Damping& d = out.sets.emplace_back(std::move(set.damping));
    d.frequency = {rung.frequency};
    d.real = Rows::Zero(1, std::ssize(set.entries));
    for (std::size_t at = 0; at < set.entries.size(); ++at)
      for (const std::size_t k : set.entries[at])
        d.real(0, static_cast<Index>(at)) +=
            part_of(entries[k], root_mass) * rung.damping(entries[k].row, entries[k].column);
    set_diagonal(d);
  }
  return out;
}

// Trapezoidal rule over the samples of the splines.
Judged damping_of(const water::Convolution& c, const VectorX& root_mass) {
  const Index n = c.splines.rows() - 2;
  const double cost = static_cast<double>(n) * static_cast<double>(c.n_moving_pairs);
  const auto count = static_cast<Index>(std::clamp(sum_budget / (8.0 * cost), 16.0, 200.0));
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
  Judged out{"the transform of the radiation kernel", allowed_table};
  for (Coupled& set : coupled(root_mass.size(), entries)) {
    Damping& d = out.sets.emplace_back(std::move(set.damping));
    d.frequency = frequency;
    d.real = weighted(cosine, count, std::ssize(set.entries), [&](Index at, auto column) {
      for (const std::size_t k : set.entries[static_cast<std::size_t>(at)]) {
        const auto K = c.splines.col(static_cast<Index>(k));
        column +=
            part_of(entries[k], root_mass) / 6.0 * (K.head(n) + 4.0 * K.segment(1, n) + K.tail(n));
      }
    });
    set_diagonal(d);
  }
  return out;
}

} // namespace hydrodae::build
