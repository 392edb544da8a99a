#include "hydrodae/statics/balance.h"

#include <cmath>
#include <optional>

#include "hydrodae/build/closing.h"
#include "hydrodae/build/constraints.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/statics/static_step.h"
#include "hydrodae/system/algebraic.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/system/retract.h"
#include "hydrodae/system/trouble.h"

namespace hydrodae::statics {

namespace {

using system::BodyData;
using system::Regime;

constexpr double longest = 3.0; ///< largest step, in length scales
constexpr int most_steps = 200, most_creeping_steps = 1000;
constexpr int most_idle_steps = 40; ///< number of Newton steps without a better balance

/// Gaps of all rows at position level, in the order of lambda; zero at velocity level.
VectorX gaps_of(const Regime& s, const VectorX& r) {
  VectorX gaps = VectorX::Zero(s.n_lambda);
  system::for_each_row(s, [&](const system::Row& row, bool velocity_level) {
    if (s.holds(row) && !velocity_level)
      gaps[s.lambda(row) - s.lambda0] = r[s.mu(row)];
  });
  return gaps;
}

VectorX gap_sizes(const Regime& s) {
  VectorX sizes = VectorX::Ones(s.n_lambda);
  system::for_each_row(s, [&](const system::Row& row, bool velocity_level) {
    if (s.holds(row))
      sizes[s.lambda(row) - s.lambda0] = s.row_scale[velocity_level ? s.lambda(row) : s.mu(row)];
  });
  return sizes;
}

/// Name of a coordinate with the unit of its force: "heave of body 'sphere'", "N".
struct CoordinateName {
  std::string text, unit;
};

CoordinateName coordinate_name(const Regime& s, Index u) {
  for (const BodyData& b : s.bodies) {
    const Index k = u - (b.u0 - s.u0);
    if (k < 0 || k >= b.n_active)
      continue;
    const int c = b.active[static_cast<std::size_t>(k)];
    return {std::string(model::coordinate_names[static_cast<std::size_t>(c)]) + " of body " +
                in_quotes(b.name),
            c < 3 ? "N" : "N m"};
  }
  return {s.row_names[s.u0 + u], "N or N m"};
}

/// Coordinates of motions allowed by the constraints that a force drives and no stiffness restores:
/// K d = 0 but d . f != 0.
std::vector<std::string> unrestored(const Regime& s, const LinearMatrices& m,
                                    const VectorX& scale) {
  const MatrixX G = m.constraints * scale.asDiagonal();
  const MatrixX free = null_space(G);
  std::vector<std::string> out;
  if (free.cols() == 0)
    return out;
  const VectorX forces = free.transpose() * scale.cwiseProduct(m.forces);
  const MatrixX K = free.transpose() * scale.asDiagonal() * m.stiffness * scale.asDiagonal() * free;
  const double weight = s.row_scale.segment(s.u0, s.n_u).cwiseProduct(scale).maxCoeff(),
               largest = K.rowwise().norm().maxCoeff();
  MatrixX loose = MatrixX::Identity(K.rows(), K.rows()); // vectors x with x . K = 0
  if (largest > 1e-9 * weight)
    loose = null_space(K.transpose(), 1e-9 * std::max(1.0, weight / largest));
  const VectorX drift = loose * (loose.transpose() * forces);
  if (!(drift.norm() > 1e-9 * weight))
    return out;
  const VectorX moved = (free * drift).cwiseAbs();
  for (Index u = 0; u < s.n_u; ++u)
    if (moved[u] > 0.1 * moved.maxCoeff())
      out.push_back(coordinate_name(s, u).text);
  return out;
}

std::string off_balance(const Regime& s, const LinearMatrices& m, const VectorX& scale) {
  Index worst = 0;
  m.forces.cwiseQuotient(s.row_scale.segment(s.u0, s.n_u).cwiseMax(1e-300))
      .cwiseAbs()
      .maxCoeff(&worst);
  const CoordinateName name = coordinate_name(s, worst);
  const std::vector<std::string> slack = unrestored(s, m, scale);
  return s.row_names[s.u0 + worst] + " is off by " + number_text(m.forces[worst]) + " " +
         name.unit +
         (slack.empty() ? "; start nearer to the equilibrium, or hold what drifts"
                        : "; there is no stiffness in " + joined(slack) +
                              ": balance weight, buoyancy and constant loads there, or add a "
                              "mooring, a spring or hydrostatics");
}

/// Equations at a pose.
struct Balance {
  LinearMatrices m;
  VectorX gaps;
  double force_error = INFINITY, gap_error = INFINITY; ///< errors in units of weights and lengths
  /// Rounding error of the forces by that of the positions, in units of weights
  double rounding = 0.0;
  std::string trouble; ///< reason why they are missing; empty: they exist

  bool holds() const {
    return force_error <= std::max(balanced, rounding) && gap_error <= balanced;
  }
  double error() const { return std::hypot(force_error, gap_error); }
};

/// Search for the static pose, with its scratch and scales.
class Search {
public:
  explicit Search(const Regime& system)
      : s_(system), pattern_(system::find_pattern(system)),
        scale_(build::displacement_scale(system)), sizes_(gap_sizes(system)),
        weights_(system.row_scale.segment(system.u0, system.n_u).cwiseMax(1e-300)),
        units_(system.scale.segment(system.lambda0, system.n_lambda).cwiseMax(1e-300)), ws_(system),
        laws_(system), residual_(system.n) {}

  Balance at(VectorX& y) {
    Balance out;
    if (!system::solve_algebraic(s_, laws_, 0.0, y)) {
      out.trouble = "an algebraic unknown of a force has no solution there";
      return out;
    }
    const VectorX rest = VectorX::Zero(s_.n);
    system::residual<double>(s_, ws_, 0.0, y.data(), rest.data(), residual_.data());
    if (!std::isfinite(residual_.sum())) {
      out.trouble = system::unknown_load(s_, ws_);
      if (out.trouble.empty())
        out.trouble = "the forces have no value there";
      return out;
    }
    out.m = linear_matrices(s_, pattern_, y);
    out.gaps = gaps_of(s_, residual_);
    out.force_error = out.m.forces.cwiseQuotient(weights_).cwiseAbs().maxCoeff();
    out.rounding = rounding(out.m, y).cwiseQuotient(weights_).maxCoeff();
    out.gap_error = s_.n_lambda > 0 ? out.gaps.cwiseQuotient(sizes_).cwiseAbs().maxCoeff() : 0.0;
    return out;
  }

  /// Makes an implicit Euler step of pseudo-time tau, in units of weights and length scales;
  /// infinite tau is a Newton step. Steps longer than `longest` are shortened.
  /// @returns its length before that; infinite: not a number
  double step(const Balance& now, double tau, VectorX& y) const {
    const LinearMatrices& m = now.m;
    const Index n = s_.n_u + s_.n_lambda;
    MatrixX kkt = MatrixX::Zero(n, n);
    kkt.topLeftCorner(s_.n_u, s_.n_u) =
        weights_.cwiseInverse().asDiagonal() * m.stiffness * scale_.asDiagonal();
    kkt.topLeftCorner(s_.n_u, s_.n_u).diagonal().array() += 1.0 / tau;
    kkt.topRightCorner(s_.n_u, s_.n_lambda) =
        -(weights_.cwiseInverse().asDiagonal() * m.constraints.transpose() * units_.asDiagonal());
    kkt.bottomLeftCorner(s_.n_lambda, s_.n_u) =
        sizes_.cwiseInverse().asDiagonal() * m.constraints * scale_.asDiagonal();
    VectorX rhs(n);
    rhs << m.forces.cwiseQuotient(weights_), -now.gaps.cwiseQuotient(sizes_);
    VectorX x = smallest_solution(kkt, rhs, s_.n_u);
    if (!x.allFinite())
      return INFINITY;
    const double length = x.head(s_.n_u).cwiseAbs().maxCoeff();
    if (length > longest) // the reactions are kept: they are linear
      x.head(s_.n_u) *= longest / length;
    system::retract(s_, x.head(s_.n_u).cwiseProduct(scale_), y);
    y.segment(s_.lambda0, s_.n_lambda) += x.tail(s_.n_lambda).cwiseProduct(units_);
    return length;
  }

  /// Newton's method. Returns the balance found, or the last one if it diverges or stalls: many
  /// unshortened steps without a better balance.
  Balance newton(VectorX& y) {
    constexpr double better = 0.9;
    double best = INFINITY;
    for (int k = 0, idle = 0;; ++k) {
      Balance now = at(y);
      if (now.error() < better * best) {
        best = now.error();
        idle = 0;
      }
      if (!now.trouble.empty() || now.holds() || k == most_steps || idle == most_idle_steps)
        return now;
      const double length = step(now, INFINITY, y);
      if (std::isinf(length))
        return now;
      idle = length > longest ? 0 : idle + 1;
    }
  }

  /// Throws ModelError if rounding of a body's place or rotation in the last digit changes a load
  /// by a relevant part of the weights.
  void refuse_rounding(const VectorX& start) {
    constexpr double counts = 1e-3;
    VectorX y = start;
    const Balance now = at(y);
    if (!now.trouble.empty() || now.rounding <= counts)
      return;
    Index worst = 0;
    const VectorX change = rounding(now.m, y);
    change.cwiseQuotient(weights_).maxCoeff(&worst);
    const CoordinateName name = coordinate_name(s_, worst);
    throw ModelError(
        "solver.start",
        "no static equilibrium can be found: " + name.text +
            " is held so stiffly that rounding in the last digit of the positions changes its load "
            "by " +
            rounded_text(change[worst]) + " " + name.unit + ", where " +
            rounded_text(weights_[worst]) + " " + name.unit +
            " is the weight; lower the largest stiffness there, or put a joint in its place");
  }

  /// Creeps to the static pose, with pseudo-times that grow while steps succeed without shortening.
  std::optional<Balance> creep(VectorX& y) {
    constexpr double grow = 2.0, cut = 0.25, worse = 2.0, least = 1e-9, most = 1e9;
    Balance now = at(y);
    if (!now.trouble.empty())
      return {};
    double tau = 1.0;
    for (int k = 0; k < most_creeping_steps && tau > least; ++k) {
      if (now.holds())
        return now;
      VectorX next_y = y;
      const double length = step(now, tau, next_y);
      if (std::isinf(length))
        return {};
      Balance next = at(next_y);
      if (!(next.error() <= worse * now.error())) {
        tau *= cut;
        continue;
      }
      if (length <= longest)
        tau = std::min(grow * tau, most);
      now = std::move(next);
      y = next_y;
    }
    return {};
  }

  std::string off(const Balance& end) const {
    return end.trouble.empty() ? off_balance(s_, end.m, scale_) : end.trouble;
  }

private:
  /// Rounding error of each load by that of the positions [N, N m] (n_u,).
  VectorX rounding(const LinearMatrices& m, const VectorX& y) const {
    constexpr double last_digit = 2.2e-16;
    VectorX place = VectorX::Ones(s_.n_u);
    for (const BodyData& b : s_.bodies)
      for (int k = 0; k < b.n_translations; ++k)
        place[b.u0 - s_.u0 + k] = std::abs(y[b.q0 + k]);
    return last_digit * (m.stiffness.cwiseAbs() * place);
  }

  const Regime& s_;
  const system::Pattern pattern_;
  const VectorX scale_, sizes_, weights_, units_;
  system::Workspace<double> ws_;
  system::JacobianWorkspace laws_;
  VectorX residual_;
};

/// Refuses rows with a moving drive: they have no static pose.
void refuse_motion(const Regime& s, const VectorX& y) {
  system::Workspace<double> ws(s);
  VectorX r(s.n);
  const VectorX rest = VectorX::Zero(s.n);
  system::residual<double>(s, ws, 0.0, y.data(), rest.data(), r.data());
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c) && std::abs(r[s.lambda(c)]) > 0.0)
      throw ModelError("constraint." + c.name,
                       "constraint '" + c.name + "' moves at the start: there is no equilibrium");
}

} // namespace

LinearMatrices balance(const Regime& s, VectorX& y) {
  if (s.n_u == 0) // nothing can move
    return linear_matrices(s, system::find_pattern(s), y);
  Search search(s);
  search.refuse_rounding(y);
  const VectorX start = y;
  Balance found = search.newton(y);
  if (!found.holds()) {
    y = start;
    std::optional<Balance> crept = search.creep(y);
    if (!crept)
      throw ModelError("solver.start",
                       "no static equilibrium near the start: " + search.off(found));
    found = std::move(*crept);
  }
  refuse_motion(s, y);
  return found.m;
}

} // namespace hydrodae::statics
