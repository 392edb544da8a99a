#pragma once
/// Radiation by convolution with the kernel:
///
///   F = int_0^min(t,T) K(tau) U(t - tau) dtau,   U = 0 before the start
///
/// system/history.h integrates it: F = memory + by_U U(t) + by_U_dot U'(t).

#include "hydrodae/water/radiation_law.h"

namespace hydrodae::water {

/// Product out = m x without temporaries; a plain loop for scalars that Eigen does not vectorise.
template <class S> void multiply(const MatrixX& m, const S* x, S* out) {
  if constexpr (std::is_same_v<S, double>) {
    Eigen::Map<VectorX>(out, m.rows()).noalias() = m * Eigen::Map<const VectorX>(x, m.cols());
  } else {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      S sum(0);
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        sum += S(m(i, j)) * x[j];
      out[i] = sum;
    }
  }
}

/// Radiation kernels as cubic B-splines on a uniform grid (math/bspline.h), one column for each
/// pair of coordinates that act on each other.
struct Convolution : RadiationLaw {
  static constexpr std::string_view type = "convolution", doc = "the kernel K(t)";
  static constexpr bool reads_kernel = true;
  struct Keys {
    std::optional<double> memory_length;
  };
  template <class H> static Fields<H> keys() {
    return {{"memory_length", &H::memory_length, "s",
             "Length of the kernel of the convolution; by default that of the database.", false,
             more_than(0)}};
  }

  struct Pair {
    int row = 0;    ///< row: entry of U; from n_moving on, entry of `locked`
    int column = 0; ///< column: entry of U
    bool operator==(const Pair&) const = default;
  };
  double step = 0.0, length = 0.0; ///< step of the grid, and length T, beyond which K = 0 [s]
  double frequency = 0.0;          ///< root mean square frequency of the kernels' spectra [rad/s]
  std::vector<Pair> pairs;         ///< pairs with a moving row first
  int n_moving_pairs = 0;
  std::vector<int> locked; ///< locked rows of the full loads (6 n_bodies)
  MatrixX splines;         ///< coefficients (n_grid + 2, n_pairs)
  bool empty() const { return pairs.empty(); }

  std::vector<std::string> read(const RadiationSource& from, const Keys& keys, AddedMass& added);

  bool operator==(const Convolution& other) const {
    return step == other.step && pairs == other.pairs && splines.rows() == other.splines.rows() &&
           splines == other.splines;
  }
  Index n_scratch(const WetBodies& wet) const { return empty() ? 0 : wet.n_moving; }
  bool acts() const { return !empty(); }
  template <class Visit> void for_each_coupling(Visit&& visit) const {
    for (int k = 0; k < n_moving_pairs; ++k)
      visit(pairs[static_cast<std::size_t>(k)].row, pairs[static_cast<std::size_t>(k)].column);
  }

  template <class S> void add_loads(const WaterMotion<S>& m, S* force) const {
    if (empty() || !m.past)
      return;
    const auto add = [&](const MatrixX& by, const S* x) {
      multiply<S>(by, x, m.scratch);
      for (int u = 0; u < m.wet.n_moving; ++u)
        force[u] += m.scratch[u];
    };
    add(m.past->by_U_dot, m.U_dot);
    add(m.past->by_U, m.U);
    for (int u = 0; u < m.wet.n_moving; ++u)
      force[u] += S(m.past->memory[u]);
  }
  void add_all_loads(const WaterMotion<double>& m, double* force) const;
  bool add_gradient(const WaterMotion<double>& m, std::size_t i, std::size_t j, Matrix6& by_U_dot,
                    Matrix6& by_U) const {
    if (empty() || !m.past)
      return false;
    const HydroBody &a = m.wet.bodies[i], &b = m.wet.bodies[j];
    by_U_dot += hydro_block(m.past->by_U_dot, a, b);
    by_U += hydro_block(m.past->by_U, a, b);
    return true;
  }
};

} // namespace hydrodae::water
