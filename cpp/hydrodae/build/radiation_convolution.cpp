/// Radiation by convolution: kernels as splines.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/parts.h"
#include "hydrodae/build/radiation.h"
#include "hydrodae/math/bspline.h"

namespace hydrodae::build {

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
double kernel_frequency(const system::HydroData& h) {
  const system::Convolution& c = h.convolution;
  VectorX size = VectorX::Zero(h.n_moving), frequency = size;
  for (int p = 0; p < c.n_moving_pairs; ++p) {
    const system::Convolution::Pair& pair = c.pairs[static_cast<std::size_t>(p)];
    const double mass = h.added_mass(pair.column, pair.column);
    if (pair.row != pair.column || !(mass > 0.0))
      continue;
    const auto K = c.splines.col(p);
    const VectorX slope = (K.tail(K.size() - 1) - K.head(K.size() - 1)) / c.step;
    size[pair.column] = K.cwiseAbs().maxCoeff() / mass;
    frequency[pair.column] = slope.norm() / K.norm();
  }
  double fastest = 0.0;
  for (int u = 0; u < h.n_moving; ++u)
    if (size[u] > 1e-3 * size.maxCoeff())
      fastest = std::max(fastest, frequency[u]);
  return fastest;
}

} // namespace

// Kernels of the pairs that feel each other, rows that move first.
std::vector<std::string> fill_convolution(const model::Scene& scene, system::System& s) {
  system::HydroData& h = s.hydro;
  const hydro::RadiationKernel& kernel = *scene.database->kernel;
  h.added_mass_all = cut(scene, h, kernel.outputs, kernel.inputs, kernel.added_mass_inf);
  h.added_mass = moving_rows(h, h.added_mass_all);
  system::Convolution& c = h.convolution;
  c.step = kernel.step;
  const double length = scene.hydro->memory_length.value_or(kernel.length());
  const auto n = std::min<Eigen::Index>(static_cast<Eigen::Index>(length / c.step + 1e-9) + 1,
                                        static_cast<Eigen::Index>(kernel.values.size()));
  c.length = c.step * static_cast<double>(n - 1);
  std::vector<int> columns; // column of the kernel for each coordinate
  for (const system::HydroData::Coordinate& k : h.coordinates)
    columns.push_back(
        label_index(kernel.inputs, hydro_label(scene, h.bodies[k.hydro_body], k.component)));
  std::vector<VectorX> splines;
  auto add_row = [&](int row, int from) { // `from`: row of the kernel
    for (int u = 0; u < h.n_moving; ++u) {
      const VectorX samples = kernel_samples(kernel, from, columns[static_cast<std::size_t>(u)], n);
      if (samples.isZero(0.0))
        continue;
      c.pairs.push_back({row, u});
      splines.push_back(bspline_coefficients(samples));
    }
  };
  for (int u = 0; u < h.n_moving; ++u) {
    const system::HydroData::Coordinate& k = h.coordinates[static_cast<std::size_t>(u)];
    add_row(u,
            label_index(kernel.outputs, hydro_label(scene, h.bodies[k.hydro_body], k.component)));
  }
  c.n_moving_pairs = static_cast<int>(c.pairs.size());
  for (int i = 0; i < static_cast<int>(h.bodies.size()); ++i)
    for (int d = 0; d < 6; ++d) {
      const int from = label_index(kernel.outputs, hydro_label(scene, h.bodies[i], d));
      if (h.bodies[i].moving[d] >= 0 || from < 0)
        continue;
      const std::size_t before = c.pairs.size();
      add_row(h.n_moving + static_cast<int>(c.locked.size()), from);
      if (c.pairs.size() > before)
        c.locked.push_back(6 * i + d);
    }
  c.splines.resize(n + 2, static_cast<Eigen::Index>(splines.size()));
  for (std::size_t p = 0; p < splines.size(); ++p)
    c.splines.col(static_cast<Eigen::Index>(p)) = splines[p];
  c.frequency = kernel_frequency(h);
  return kernel.outputs;
}

} // namespace hydrodae::build
