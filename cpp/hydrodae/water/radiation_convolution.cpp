#include "hydrodae/water/radiation_convolution.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/math/bspline.h"

namespace hydrodae::water {

namespace {

/// Samples of one kernel. Over the last tenth of the memory a squared cosine reduces it to zero, so
/// that it ends smoothly.
VectorX kernel_samples(const hydro::RadiationKernel& kernel, int row, int column, Eigen::Index n) {
  VectorX samples(n);
  const double end = static_cast<double>(n - 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double late = (static_cast<double>(k) / end - 0.9) / 0.1;
    const double c = late > 0.0 ? std::cos(0.5 * pi * late) : 1.0;
    samples[k] = c * c * kernel.values[static_cast<std::size_t>(k)](row, column);
  }
  samples[n - 1] = 0.0;
  return samples;
}

/// Root mean square frequency of the kernels [rad/s], for the fastest coordinate whose kernel
/// matters relative to its added mass.
double kernel_frequency(const Convolution& c, const MatrixX& added_mass) {
  VectorX size = VectorX::Zero(added_mass.rows()), frequency = size;
  for (int p = 0; p < c.n_moving_pairs; ++p) {
    const Convolution::Pair& pair = c.pairs[static_cast<std::size_t>(p)];
    const double mass = added_mass(pair.column, pair.column);
    if (pair.row != pair.column || !(mass > 0.0))
      continue;
    const auto K = c.splines.col(p);
    const VectorX slope = (K.tail(K.size() - 1) - K.head(K.size() - 1)) / c.step;
    size[pair.column] = K.cwiseAbs().maxCoeff() / mass;
    frequency[pair.column] = slope.norm() / K.norm();
  }
  double fastest = 0.0;
  for (Index u = 0; u < size.size(); ++u)
    if (size[u] > 1e-3 * size.maxCoeff())
      fastest = std::max(fastest, frequency[u]);
  return fastest;
}

} // namespace

// Kernels of the pairs that feel each other, rows that move first.
std::vector<std::string> Convolution::read(const RadiationSource& from, const Keys& keys,
                                           AddedMass& added) {
  const WetBodies& wet = from.wet;
  const hydro::RadiationKernel& kernel = *from.database.kernel;
  added.all = from.cut(kernel.outputs, kernel.inputs, kernel.added_mass_inf);
  step = kernel.step;
  const auto n = std::min<Index>(
      static_cast<Index>(keys.memory_length.value_or(kernel.length()) / step + 1e-9) + 1,
      std::ssize(kernel.values));
  length = step * static_cast<double>(n - 1);
  const std::vector<int> column = from.places(kernel.inputs), row = from.all_places(kernel.outputs);
  std::vector<VectorX> columns;
  const auto add_row = [&](int to, int of_kernel) {
    for (int u = 0; u < wet.n_moving; ++u) {
      const VectorX samples =
          kernel_samples(kernel, of_kernel, column[static_cast<std::size_t>(u)], n);
      if (samples.isZero(0.0))
        continue;
      pairs.push_back({to, u});
      columns.push_back(bspline_coefficients(samples));
    }
  };
  for (int u = 0; u < wet.n_moving; ++u) {
    const Index place = wet.coordinates[static_cast<std::size_t>(u)].row();
    add_row(u, row[static_cast<std::size_t>(place)]);
  }
  n_moving_pairs = static_cast<int>(pairs.size());
  for (int k = 0; k < static_cast<int>(row.size()); ++k) {
    const int of_kernel = row[static_cast<std::size_t>(k)];
    if (wet.bodies[static_cast<std::size_t>(k / 6)].moving[static_cast<std::size_t>(k % 6)] >= 0 ||
        of_kernel < 0)
      continue;
    const std::size_t before = pairs.size();
    add_row(wet.n_moving + static_cast<int>(locked.size()), of_kernel);
    if (pairs.size() > before)
      locked.push_back(k);
  }
  splines.resize(n + 2, std::ssize(columns));
  for (std::size_t p = 0; p < columns.size(); ++p)
    splines.col(static_cast<Index>(p)) = columns[p];
  frequency = kernel_frequency(*this, wet.moving_rows(added.all));
  return kernel.outputs;
}

void Convolution::add_all_loads(const WaterMotion<double>& m, double* force) const {
  if (empty() || !m.past)
    return;
  const ConvolvedPast& past = *m.past;
  const Eigen::Map<const VectorX> U(m.U, m.wet.n_moving), U_dot(m.U_dot, m.wet.n_moving);
  for (int u = 0; u < m.wet.n_moving; ++u)
    force[m.wet.coordinates[static_cast<std::size_t>(u)].row()] +=
        past.memory[u] + past.by_U.row(u).dot(U) + past.by_U_dot.row(u).dot(U_dot);
  for (std::size_t k = 0; k < locked.size(); ++k) {
    const auto row = static_cast<Index>(k);
    force[locked[k]] += past.memory_locked[row] + past.locked_by_U.row(row).dot(U) +
                        past.locked_by_U_dot.row(row).dot(U_dot);
  }
}

} // namespace hydrodae::water
