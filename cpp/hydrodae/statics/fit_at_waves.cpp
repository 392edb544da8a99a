#include "hydrodae/statics/fit_at_waves.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/frequency.h"
#include "hydrodae/linalg/klu.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/waves.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::statics {

namespace {

using sanity::Finding;
using Complex = std::complex<double>;

/// Difference relative to the rms motion of a coordinate: reported, and serious.
constexpr double off_worth_saying = 0.01, off_too_large = 0.1;
/// Negligible motion, as part of the largest of its unit
constexpr double unseen = 0.02;
constexpr Index most_coordinates = 300; ///< the matrices are dense
/// Largest number of judged components of a wave system, evenly chosen
constexpr std::size_t frequencies_judged = 64;

/// Moving coordinates in the water, with their indices in the tables and in the fit.
struct Coordinates {
  std::vector<std::string> labels;
  std::vector<int> table, input, output;
  std::vector<double> yaw; ///< mean yaw of the body, by which it meets the waves [rad]

  Coordinates(const model::Scene& scene, const system::System& s, const hydro::MemoryFit& fit) {
    for (const system::HydroData::Coordinate& c : s.hydro.coordinates) {
      const system::HydroBody& hb = s.hydro.bodies[static_cast<std::size_t>(c.hydro_body)];
      labels.push_back(build::hydro_label(scene, hb, c.component));
      table.push_back(build::label_index(scene.database->coordinates, labels.back()));
      input.push_back(build::label_index(fit.inputs, labels.back()));
      output.push_back(build::label_index(fit.outputs, labels.back()));
      yaw.push_back(s.hydro.bodies[static_cast<std::size_t>(hb.carrier)].yaw);
    }
  }
};

/// Transfer function H(iw) of a fit (m, m): f_rad = -Re(C z), so that H is the mean of C (iw -
/// p)^-1 B and of the conjugate of C (-iw - p)^-1 B.
Eigen::MatrixXcd transfer(const hydro::MemoryFit& fit, const Coordinates& of, double omega) {
  const Eigen::MatrixXcd B = fit.input_matrix(Eigen::all, of.input),
                         C = fit.output_matrix(of.output, Eigen::all);
  const auto at = [&](double w) {
    Eigen::MatrixXcd states = B;
    for (Index k = 0; k < states.rows(); ++k)
      states.row(k) /= Complex(0.0, w) - fit.poles[k];
    return product(C, states);
  };
  return 0.5 * (at(omega) + at(-omega).conjugate());
}

/// Equations linearised at the start, at rest, in the motions that the constraints allow.
class Linear {
public:
  explicit Linear(const system::Regime& s) {
    VectorX y = system::initial_state(s);
    y.segment(s.u0, s.n_u).setZero();
    const system::Pattern pattern = system::find_pattern(s);
    m = linear_matrices(s, pattern, y);
    free = MatrixX::Identity(s.n_u, s.n_u);
    if (s.n_lambda > 0) { // the reactions add to the stiffness
      const Eigen::ColPivHouseholderQR<MatrixX> rows(m.constraints.transpose());
      y.segment(s.lambda0, s.n_lambda) += rows.solve(-m.forces);
      m = linear_matrices(s, pattern, y);
      free = MatrixX(rows.householderQ()).rightCols(s.n_u - rows.rank());
    }
    system::Workspace<double> ws(s);
    const VectorX rest = VectorX::Zero(s.n);
    system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
    map = hydro_map(s, ws) * free;
    if (m.state_by_state.size() > 0)
      find_pattern_of_states();
  }

  /// Motion U / (iw) (m,) by loads (m,), with the radiation H (m, m).
  Eigen::VectorXcd motion(double omega, const Eigen::MatrixXcd& H, const Eigen::VectorXcd& force) {
    const Eigen::MatrixXcd wide = map.cast<Complex>();
    const Eigen::MatrixXcd own = impedance(omega) + Complex(0.0, omega) * congruence(map, H);
    return product(wide, solve_complex(own, product(wide.transpose(), force)));
  }

private:
  /// N^T (K + iw C - w^2 M - F_z (iw - A)^-1 (B + iw D)) N, kept until the frequency changes.
  const Eigen::MatrixXcd& impedance(double omega) {
    if (omega == omega_)
      return impedance_;
    omega_ = omega;
    const Complex iw(0.0, omega);
    Eigen::MatrixXcd Z = iw * iw * m.mass + iw * m.damping + m.stiffness;
    if (states_)
      Z -= product(m.load_by_state.cast<Complex>(), states_by_xi(iw));
    return impedance_ = congruence(free, Z);
  }

  /// Pattern of iw - A: each node of a line depends on its neighbours only.
  void find_pattern_of_states() {
    const MatrixX& A = m.state_by_state;
    starts_ = {0};
    for (Index j = 0; j < A.cols(); ++j) {
      for (Index i = 0; i < A.rows(); ++i)
        if (i == j || A(i, j) != 0.0)
          rows_.push_back(i);
      starts_.push_back(std::ssize(rows_));
    }
    states_.emplace(starts_, rows_);
  }

  /// (iw - A)^-1 (B + iw D), (n_z, n_u).
  Eigen::MatrixXcd states_by_xi(Complex iw) {
    const MatrixX& A = m.state_by_state;
    for (Index j = 0; j < A.cols(); ++j)
      for (Index k = starts_[static_cast<std::size_t>(j)];
           k < starts_[static_cast<std::size_t>(j + 1)]; ++k) {
        const auto at = static_cast<std::size_t>(k);
        states_->values()[at] = (rows_[at] == j ? iw : 0.0) - A(rows_[at], j);
      }
    Eigen::MatrixXcd out = m.state_by_xi + iw * m.state_by_rate;
    if (!states_->factorise())
      return Eigen::MatrixXcd::Constant(out.rows(), out.cols(), NAN);
    for (Index j = 0; j < out.cols(); ++j)
      if (!out.col(j).isZero(0.0))
        states_->solve(out.col(j).data());
    return out;
  }

  LinearMatrices m;
  MatrixX free, map; ///< N (n_u, n_free) with G N = 0, T (m, n_u) N
  std::vector<Index> starts_, rows_;
  std::optional<linalg::SparseLu<Complex>> states_; ///< iw - A
  double omega_ = -1.0;                             ///< frequency of `impedance_` [rad/s]
  Eigen::MatrixXcd impedance_;
};

/// Sum of |amplitude|^2 by table frequency (its index) and heading.
std::map<std::pair<Index, double>, double> at_table(const VectorX& omega,
                                                    const std::vector<sea::Component>& components) {
  std::map<std::pair<Index, double>, double> out;
  for (const sea::Component& c : components) {
    const Index above = std::lower_bound(omega.begin(), omega.end(), c.omega) - omega.begin();
    const Index high = std::clamp<Index>(above, 1, omega.size() - 1);
    const bool lower = c.omega - omega[high - 1] < omega[high] - c.omega;
    out[{lower ? high - 1 : high, c.heading}] += std::norm(c.amplitude);
  }
  return out;
}

/// Comparison of the motions in waves by the tables and by the fit.
struct Comparison {
  const hydro::Database& db;
  const hydro::MemoryFit& fit;
  const Coordinates& of;
  Linear& linear;
  hydro::Excitation excitation;

  std::optional<Eigen::VectorXcd> force(double omega, double heading) const {
    Eigen::VectorXcd out(std::ssize(of.labels)), all;
    double yaw = NAN;
    for (std::size_t k = 0; k < of.labels.size(); ++k) {
      if (of.yaw[k] != yaw) {
        yaw = of.yaw[k];
        const std::optional<double> relative = excitation.headings().covered(heading - yaw);
        if (!relative)
          return std::nullopt;
        all = excitation(omega, *relative);
      }
      out[static_cast<Index>(k)] = all[static_cast<Index>(k)];
    }
    return out;
  }

  /// Adds the squared motions by the tables, and the squared differences, at one frequency.
  void add(Index row, double heading, double weight, VectorX& size, VectorX& miss) const {
    const double omega = db.omega[row];
    const std::optional<Eigen::VectorXcd> load = force(omega, heading);
    if (!load)
      return; // a run refuses this wave
    const auto place = static_cast<std::size_t>(row);
    const Eigen::MatrixXcd table = db.damping[place](of.table, of.table) +
                                   Complex(0.0, omega) * (db.added_mass[place](of.table, of.table) -
                                                          fit.added_mass_inf(of.output, of.input));
    const Eigen::VectorXcd right = linear.motion(omega, table, *load),
                           ours = linear.motion(omega, transfer(fit, of, omega), *load);
    size += weight * right.cwiseAbs2();
    miss += weight * (ours - right).cwiseAbs2();
  }
};

/// Coordinate with the largest relative difference, and that difference.
std::pair<std::size_t, double> worst(const Coordinates& of, const VectorX& size,
                                     const VectorX& miss) {
  const auto turns = [&](std::size_t k) {
    const std::string dof = of.labels[k].substr(of.labels[k].rfind('.') + 1);
    return dof == "roll" || dof == "pitch" || dof == "yaw";
  };
  double largest[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < of.labels.size(); ++k)
    largest[turns(k)] = std::max(largest[turns(k)], size[static_cast<Index>(k)]);
  std::pair<std::size_t, double> out{0, 0.0};
  for (std::size_t k = 0; k < of.labels.size(); ++k) {
    const auto i = static_cast<Index>(k);
    if (size[i] > unseen * unseen * largest[turns(k)] &&
        miss[i] > out.second * out.second * size[i])
      out = {k, std::sqrt(miss[i] / size[i])};
  }
  return out;
}

} // namespace

std::vector<Finding> look_at_fit(const model::Scene& scene, const system::System& given) {
  std::vector<Finding> out;
  const hydro::MemoryFit* fit = scene.pose_tables.empty() ? model::memory_fit(scene) : nullptr;
  if (!fit || scene.waves.empty() || given.n_u > most_coordinates || given.hydro.n_moving == 0)
    return out;
  std::optional<hydro::Database> images;
  std::string symmetry;
  if (given.hydro.axes == system::HydroAxes::yaw)
    images = build::wave_tables(scene, given, symmetry);
  const hydro::Database& db = images ? *images : *scene.database;
  if (db.omega.size() < 2 || db.damping.empty())
    return out;
  const Coordinates of(scene, given, *fit);
  const system::Regime regime(given);
  Linear linear(regime);
  const Comparison comparison{db, *fit, of, linear, {db, db.excitation, of.labels}};
  for (const sea::Wave& wave : scene.waves) {
    const auto parts = at_table(db.omega, model::wave_components(scene, wave, nullptr));
    const std::size_t stride =
        1 + (std::max<std::size_t>(parts.size(), 1) - 1) / frequencies_judged;
    VectorX size = VectorX::Zero(std::ssize(of.labels)), miss = size;
    std::size_t count = 0;
    for (const auto& [place, weight] : parts)
      if (count++ % stride == 0)
        comparison.add(place.first, place.second, weight, size, miss);
    const auto [label, share] = worst(of, size, miss);
    if (!(share > off_worth_saying))
      continue;
    out.push_back(
        {share > off_too_large,
         "wave " + in_quotes(wave->name) + ": by a linear estimate the motion " +
             in_quotes(of.labels[label]) + " is off by " + rounded_text(100.0 * share, 2) +
             " %, as the memory fit " + in_quotes(fit->name) +
             " misses the tables at these frequencies; fit it for this case with: "
             "hydrodae hdb fit " +
             db.path + " " + fit->name + "=" + joined(fit->inputs, ",") + " --case CASE"});
  }
  return out;
}

} // namespace hydrodae::statics
