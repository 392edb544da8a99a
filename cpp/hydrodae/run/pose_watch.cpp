#include "hydrodae/run/pose_watch.h"

#include <algorithm>
#include <numeric>

#include "hydrodae/build/row_ranks.h"
#include "hydrodae/core/methods.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::run {

namespace {

/// Independence of the rows at a singular pose, relative to the best seen
constexpr double singular = 1e-2;
/// Pivot of aligned rows, relative to the best: an eigenvalue is the square of a sine
constexpr double in_line = 0.1;

/// Mechanism of each constraint row (n_lambda,).
std::vector<int> row_mechanisms(const system::Regime& s) {
  std::vector<int> out(static_cast<std::size_t>(s.n_lambda));
  const auto take = [&](const system::JointData& j, Index lambda) {
    if (const system::BodyData* body = system::moving_body(s, j))
      out[static_cast<std::size_t>(lambda - s.lambda0)] = body->mechanism;
  };
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      if (s.holds(row))
        take(j, s.lambda(row));
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c))
      take(system::joint_of(s, c), s.lambda(c));
  return out;
}

} // namespace

system::Regime stabilised(system::Regime s) {
  s.formulation = system::Formulation::stabilised;
  return s;
}

bool has_loop(const system::Regime& s) {
  const int ground = static_cast<int>(s.bodies.size());
  std::vector<int> root(s.bodies.size() + 1);
  std::iota(root.begin(), root.end(), 0);
  auto find = [&](int i) {
    while (root[static_cast<std::size_t>(i)] != i)
      i = root[static_cast<std::size_t>(i)];
    return i;
  };
  auto place = [&](int body) {
    return body < 0 || s.bodies[static_cast<std::size_t>(body)].n_active == 0 ? ground : body;
  };
  // The ground guides a body with at most two coordinates.
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (s.bodies[i].n_active <= 2)
      root[i] = ground;
  for (const system::JointData& j : s.joints) {
    if (j.rows.empty())
      continue;
    const int a = find(place(j.A.body)), b = find(place(j.B.body));
    if (a == b && place(j.A.body) != place(j.B.body))
      return true;
    root[static_cast<std::size_t>(a)] = b;
  }
  return false;
}

/// Constraint rows that hold now, in any formulation, and their solver.
struct PoseWatch::Rows {
  explicit Rows(const system::Regime& s)
      : system(stabilised(s)), pattern(system::find_pattern(system)),
        equations(system, pattern, 1.0), saddle(equations), mechanism(row_mechanisms(system)) {}

  system::Regime system;
  system::Pattern pattern;
  linalg::Equations equations;
  linalg::SaddlePoint saddle;
  std::vector<int> mechanism; ///< mechanism of each row (n_lambda,)
};

PoseWatch::PoseWatch(const system::Regime& s, const SolverOptions& options, const VectorX& y,
                     bool wanted)
    : s_(s), options_(options) {
  if (wanted && has_loop(s))
    begin(y);
}

PoseWatch::~PoseWatch() = default;

void PoseWatch::restart(const VectorX& y) {
  if (rows_)
    begin(y);
}

void PoseWatch::begin(const VectorX& y) {
  rows_ = std::make_unique<Rows>(s_);
  state_.best = independence(0.0, y, VectorX::Zero(y.size()));
  state_.best_pivots = pivots(y);
}

VectorX PoseWatch::pivots(const VectorX& y) const {
  return build::least_pivots(rows_->system, y, rows_->mechanism,
                             std::max(rows_->system.n_mechanisms, 1));
}

VectorX PoseWatch::independence(double t, const VectorX& y, const VectorX& yp) {
  VectorX at = y, rate = yp;
  const int parts = std::max(rows_->system.n_mechanisms, 1);
  if (!rows_->saddle.accelerations(t, at, rate))
    return VectorX::Zero(parts);
  return rows_->saddle.independence(rows_->mechanism, parts);
}

bool PoseWatch::is_singular(double t, const VectorX& y, const VectorX& yp) {
  const VectorX now = independence(t, y, yp);
  state_.best = state_.best.cwiseMax(now);
  const auto near = (now.array() <= singular * state_.best.array()).eval();
  if (!near.any())
    return false;
  const VectorX least = pivots(y);
  state_.best_pivots = state_.best_pivots.cwiseMax(least);
  return (near && least.array() <= in_line * state_.best_pivots.array()).any();
}

bool PoseWatch::near_singular(const Step& step) {
  const bool short_steps = method_traits(options_.method).many_steps;
  if (!rows_ || (short_steps && ++state_.asked % 4 != 0))
    return false;
  const int looks = short_steps ? 1 : 6;
  for (int k = 1; k <= looks; ++k) {
    const double t = k == looks ? step.end : step.start + (step.end - step.start) * k / looks;
    step.integrator.interpolate(t, y_, yp_);
    if (is_singular(t, y_, yp_))
      return true;
  }
  return false;
}

Halt PoseWatch::with_remedy(Halt halt, double t, const VectorX& y, const VectorX& yp) {
  if (!rows_ || !is_singular(t, y, yp))
    return halt;
  if (!halt.advice.empty())
    halt.advice += "; ";
  halt.advice +=
      method_traits(options_.method).passes_singular_poses
          ? "it is next to a singular pose (a dead point, or bars in line), where the motion may "
            "have no unique way on: a smaller rtol, or a little friction, may help"
          : "it is next to a singular pose (a dead point, or bars in line): solver.method = "
            "\"radau\" or \"explicit_rk\" passes such poses";
  return halt;
}

} // namespace hydrodae::run
