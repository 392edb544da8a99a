#include "hydrodae/build/fit_poles.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/math/sets.h"

namespace hydrodae::build {

namespace {

using Complex = std::complex<double>;
using Rung = water::ExponentialRadiation;

/// Block of each state; both states of a pair have the same.
std::vector<Index> blocks_of_states(const Rung& rung) {
  std::vector<Index> out(static_cast<std::size_t>(rung.n_states()));
  for (std::size_t k = 0; k < rung.blocks.size(); ++k)
    for (int n = 0; n < (rung.blocks[k].pair ? 2 : 1); ++n)
      out[static_cast<std::size_t>(rung.blocks[k].state + n)] = static_cast<Index>(k);
  return out;
}

/// Sorts the terms of a coordinate, and adds those of the same pole.
void gather(std::vector<Term>& terms) {
  std::stable_sort(terms.begin(), terms.end(),
                   [](const Term& a, const Term& b) { return a.pole < b.pole; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < terms.size(); ++i)
    if (terms[i].pole == terms[last].pole) {
      terms[last].input += terms[i].input;
      terms[last].output += terms[i].output;
    } else {
      terms[++last] = terms[i];
    }
  terms.resize(std::min(terms.size(), last + 1));
}

} // namespace

std::vector<Poles> coupled_poles(const Rung& rung, const VectorX& root_mass) {
  const std::vector<Index> block = blocks_of_states(rung);
  const Index n = root_mass.size();
  Sets sets(n + std::ssize(rung.blocks)); // sets of coordinates, then of blocks
  std::vector<bool> loads(rung.blocks.size());
  rung.product.for_each([&](Index u, Index state, double) {
    const Index k = block[static_cast<std::size_t>(state)];
    sets.join(u, n + k);
    loads[static_cast<std::size_t>(k)] = true;
  });
  for (const Rung::Input& in : rung.inputs)
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
      const Rung::Block& b = rung.blocks[static_cast<std::size_t>(first[k] - n)];
      p.poles[k] = {b.a, b.pair ? b.b : 0.0};
    }
    p.terms.resize(p.coordinates.size());
  }
  const auto add = [&](Complex Term::* part, Index u, Index state, double value, Complex second) {
    const auto k = static_cast<std::size_t>(block[static_cast<std::size_t>(state)]);
    if (!loads[k])
      return;
    const std::size_t at = k + static_cast<std::size_t>(n);
    Poles& p = out[lists.set[at]];
    Term term{lists.place[at] - std::ssize(p.coordinates)};
    term.*part = value / root_mass[u] * (state == rung.blocks[k].state ? 1.0 : second);
    p.terms[static_cast<std::size_t>(lists.place[static_cast<std::size_t>(u)])].push_back(term);
  };
  rung.product.for_each([&](Index u, Index state, double value) {
    add(&Term::output, u, state, value, {0.0, -1.0}); // Re(C z) = Re C Re z - Im C Im z
  });
  for (const Rung::Input& in : rung.inputs)
    add(&Term::input, in.coordinate, in.state, in.value, {0.0, 1.0});
  for (Poles& p : out)
    for (std::vector<Term>& terms : p.terms)
      gather(terms);
  std::erase_if(out, [](const Poles& p) { return p.poles.size() == 0 || p.coordinates.empty(); });
  return out;
}

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

std::vector<Definite::Place> coupled_places(const Poles& p) {
  std::vector<std::vector<Index>> coordinates(static_cast<std::size_t>(p.poles.size()));
  for (std::size_t u = 0; u < p.terms.size(); ++u)
    for (const Term& t : p.terms[u])
      coordinates[static_cast<std::size_t>(t.pole)].push_back(static_cast<Index>(u));
  std::vector<Definite::Place> out;
  std::vector<Index> last(p.terms.size(), -1); // column of the last place of each row
  for (Index v = 0; v < std::ssize(p.terms); ++v) {
    const auto first = std::ssize(out);
    for (const Term& t : p.terms[static_cast<std::size_t>(v)])
      for (const Index u : coordinates[static_cast<std::size_t>(t.pole)])
        if (Index& before = last[static_cast<std::size_t>(u)]; u >= v && before != v) {
          before = v;
          out.push_back({u, v});
        }
    std::sort(out.begin() + first, out.end(),
              [](const auto& a, const auto& b) { return a.row < b.row; });
  }
  return out;
}

double least_by_residues(const Poles& p) {
  VectorX norm2 = VectorX::Zero(p.poles.size()), product = norm2, rest2 = norm2;
  const auto for_each = [&](const auto& visit) {
    for (const std::vector<Term>& terms : p.terms)
      for (const Term& t : terms)
        visit(t);
  };
  for_each([&](const Term& t) {
    norm2[t.pole] += std::norm(t.input);
    product[t.pole] += (t.input * t.output).real();
  });
  for_each([&](const Term& t) {
    const double g = norm2[t.pole] > 0.0 ? std::max(product[t.pole] / norm2[t.pole], 0.0) : 0.0;
    rest2[t.pole] += std::norm(t.output - g * std::conj(t.input));
  });
  const VectorX rate = p.poles.real().cwiseAbs();
  return -(rest2.cwiseSqrt().array() * norm2.cwiseSqrt().array() / rate.array()).sum();
}

} // namespace hydrodae::build
