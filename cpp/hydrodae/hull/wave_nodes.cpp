#include "hydrodae/hull/wave_nodes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hydrodae::hull {
namespace {

/// Largest h |c| of one band: rounding grows by e^{2 h |c|}.
constexpr double widest = 3.0;

/// Nodes for an error of 1e-13; `width` is h |c|.
int node_count(double width) {
  double error = 2.0 * std::exp(2.0 * width);
  int m = 0;
  while (error > 1e-13 && m < 100)
    error *= 0.5 * width / ++m;
  return std::max(m, 1);
}

/// L_m(k) on Chebyshev's nodes of the first kind by the barycentric formula.
void lagrange(const std::vector<Node>& nodes, int first, double k, Eigen::Ref<VectorX> out) {
  const auto m = static_cast<int>(out.size());
  for (int i = 0; i < m; ++i) {
    const double distance = k - nodes[static_cast<std::size_t>(first + i)].k;
    if (distance == 0.0) {
      out.setZero();
      out[i] = 1.0;
      return;
    }
    const double weight = std::sin((2 * i + 1) * pi / (2 * m)) * (i % 2 == 0 ? 1.0 : -1.0);
    out[i] = weight / distance;
  }
  out /= out.sum();
}

void add_band(int first, int end, double reach, WaveNodes& all) {
  const auto wave = [&](int j) -> const Wave& { return all.waves[static_cast<std::size_t>(j)]; };
  const double low = wave(first).wavenumber, high = wave(end - 1).wavenumber;
  const double c = std::cos(wave(first).heading), s = std::sin(wave(first).heading);
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const int waves = end - first, count = node_count(half * reach);
  Band band{first, waves, static_cast<int>(all.nodes.size()), std::min(waves, count), {}};
  if (count >= waves) {
    for (int j = first; j < end; ++j)
      all.nodes.push_back({wave(j).wavenumber, wave(j).wavenumber * c, wave(j).wavenumber * s});
  } else {
    for (int i = 0; i < count; ++i) {
      const double k = middle + half * std::cos((2 * i + 1) * pi / (2 * count));
      all.nodes.push_back({k, k * c, k * s});
    }
    band.weights.resize(waves, count);
    VectorX row(count);
    for (int j = 0; j < waves; ++j) {
      lagrange(all.nodes, band.first_node, wave(first + j).wavenumber, row);
      band.weights.row(j) = row.transpose();
    }
  }
  all.bands.push_back(std::move(band));
}

} // namespace

WaveNodes make_nodes(const std::vector<Wave>& waves, double reach) {
  WaveNodes all;
  all.waves = waves;
  std::stable_sort(all.waves.begin(), all.waves.end(), [](const Wave& a, const Wave& b) {
    return std::tie(a.heading, a.wavenumber) < std::tie(b.heading, b.wavenumber);
  });
  const auto n = static_cast<int>(waves.size());
  const auto wave = [&](int j) -> const Wave& { return all.waves[static_cast<std::size_t>(j)]; };
  for (int first = 0; first < n;) {
    int end = first;
    while (end < n && wave(end).heading == wave(first).heading &&
           (wave(end).wavenumber - wave(first).wavenumber) * 0.5 * reach <= widest)
      ++end;
    add_band(first, end, reach, all);
    first = end;
  }
  return all;
}

} // namespace hydrodae::hull
