/// What is found once: the rows left, and where masses and gradients stand in the Jacobian.

#include "hydrodae/tree/joint_space.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"

namespace hydrodae::tree {

namespace {

constexpr double same_pose = 1e-6; ///< misfit [levers or rad]; markers may be as far out of line
constexpr double singular_pivot = 1e-8; ///< of the last pivot against the first

void require_no_pressed_friction(const system::Regime& s) {
  system::for_each_law(
      s, [](const system::ElementList&, std::size_t, const system::PortData& port) {
        if (!port.reaction.empty())
          throw ModelError("solver.coordinates",
                           in_quotes(port.component) +
                               " is friction that the reaction of its joint presses, which "
                               "coordinates = \"reduced\" does not find; use coordinates = "
                               "\"bodies\"");
      });
}

} // namespace

JointSpace::JointSpace(linalg::Equations& equations)
    : e_(equations), s_(equations.system), tree_(s_.system), guided_(tree_.guided), cut_(s_),
      motion_(s_.system, static_cast<std::size_t>(tree_.n_u)), moved_(motion_) {
  require_no_pressed_friction(s_);
  system::lay_out(cut_, guided_);
  prepare();
  const Index needed = tree_.rows_left(s_);
  if (m_ <= needed)
    return;
  // Some rows that the tree meets were found to follow from others: now others follow from them.
  of_redundant_ = std::make_unique<linalg::SaddlePoint>(e_);
  drop_dependent_rows(needed);
}

void JointSpace::prepare() {
  pattern_ = system::find_pattern(cut_, system::Part::accelerations);
  own_ = std::make_unique<linalg::Equations>(cut_, pattern_, e_.rtol);
  parts_ = std::make_unique<system::JacobianParts>(pattern_);
  n_ = tree_.n_u;
  m_ = cut_.n_lambda;
  y_.setZero(cut_.n);
  yp_ = yp0_ = residual_ = y_;
  rhs_.setZero(n_ + m_);
  solution_ = r_ = rhs_;
  metric_.setOnes(m_);
  bias_.setZero(s_.n_u);
  net_ = bias_;
  moved_x_.setZero(size());
  change_.setZero(s_.lambda0);
  before_ = change_;
  plain_.setZero(n_ + m_, n_ + m_);
  matrix_ = plain_;
  composite_.assign(s_.bodies.size(), Matrix6::Zero());
  wrench_.assign(s_.bodies.size(), Vector6::Zero());
  find_components();
  find_masses();
  find_gradient();
}

void JointSpace::find_components() {
  body_of_.assign(static_cast<std::size_t>(s_.n_u), 0);
  component_of_.assign(body_of_.size(), 0);
  for (std::size_t i = 0; i < s_.bodies.size(); ++i)
    for (int k = 0; k < s_.bodies[i].n_active; ++k) {
      const auto u = static_cast<std::size_t>(s_.bodies[i].u0 - s_.u0 + k);
      body_of_[u] = i;
      component_of_[u] = s_.bodies[i].active[static_cast<std::size_t>(k)];
    }
}

/// Bodies in the water, and those that masses join with others, have one matrix in common.
void JointSpace::find_masses() {
  masses_.clear();
  own_masses_.clear();
  coupled_masses_.clear();
  coupled_bodies_.clear();
  for (Index column = s_.u0; column < s_.z0; ++column)
    for (Index k = pattern_.column_start[column]; k < pattern_.column_start[column + 1]; ++k)
      if (const Index row = pattern_.row[k]; row >= s_.u0 && row < s_.z0 && pattern_.has_rate[k])
        masses_.push_back({k, row - s_.u0, column - s_.u0});
  std::vector<Index> place(s_.bodies.size(), -1);
  for (const water::HydroBody& body : s_.hydro.bodies)
    if (body.moves)
      place[static_cast<std::size_t>(body.body)] = 0;
  for (const Entry& m : masses_)
    if (body_of_[m.row] != body_of_[m.column])
      place[body_of_[m.row]] = place[body_of_[m.column]] = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] == 0) {
      place[i] = 6 * static_cast<Index>(coupled_bodies_.size());
      coupled_bodies_.push_back(i);
    }
  for (const Entry& m : masses_) {
    const std::size_t body = body_of_[m.row];
    const int i = component_of_[m.row], j = component_of_[m.column];
    if (place[body] < 0)
      own_masses_.push_back({m.from, body, i, j});
    else
      coupled_masses_.push_back({m.from, place[body] + i, place[body_of_[m.column]] + j});
  }
  const auto size = 6 * static_cast<Index>(coupled_bodies_.size());
  coupled_.setZero(size, size);
  coupled_S_.setZero(size, n_);
  coupled_MS_ = coupled_S_;
}

void JointSpace::find_gradient() {
  std::map<std::pair<Index, std::size_t>, Part> parts;
  for (Index column = s_.u0; column < s_.z0; ++column)
    for (Index k = pattern_.column_start[column]; k < pattern_.column_start[column + 1]; ++k) {
      const Index row = pattern_.row[k] - cut_.lambda0;
      if (row < 0 || row >= m_)
        continue;
      const auto u = static_cast<std::size_t>(column - s_.u0);
      Part& part = parts[{row, body_of_[u]}];
      part.row = row;
      part.body = body_of_[u];
      part.entries.emplace_back(k, component_of_[u]);
    }
  gradient_.clear();
  for (auto& [key, part] : parts)
    gradient_.push_back(std::move(part));
}

/// Keeps the `needed` rows that are the most independent at the start, unless that is a singular
/// pose.
void JointSpace::drop_dependent_rows(Index needed) {
  VectorX x(size()), xp(size());
  read(0.0, system::initial_state(s_), x);
  if (!rates(0.0, x, xp))
    return;
  MatrixX rows = plain_.bottomLeftCorner(m_, n_).transpose();
  for (Index i = 0; i < m_; ++i)
    rows.col(i).normalize();
  const PivotedColumns order = pivoted_columns(rows);
  if (needed > 0 &&
      !(std::abs(order.pivots[needed - 1]) > singular_pivot * std::abs(order.pivots[0])))
    return;
  std::vector<bool> keep(static_cast<std::size_t>(m_), false);
  for (Index i = 0; i < needed; ++i)
    keep[static_cast<std::size_t>(order.order[static_cast<std::size_t>(i)])] = true;
  system::for_each_row(s_, [&](const system::Row& row, bool) {
    if (cut_.holds(row) && !keep[static_cast<std::size_t>(cut_.lambda(row) - cut_.lambda0)])
      guided_[row.number] = true;
  });
  system::lay_out(cut_, guided_);
  prepare();
}

void JointSpace::enter(double t, const VectorX& y, const VectorX& yp, VectorX& x, VectorX& xp) {
  read(t, y, x);
  xp = x;
  e_.accept(t, y, yp);
  own_->accept(t, y, yp);
}

void JointSpace::read(double t, const VectorX& y, VectorX& x) {
  x.setZero(size());
  const auto [misfit, body] = motion_.read(s_, tree_, y, x);
  moved_.sign = motion_.sign;
  moved_.angle_offset = motion_.angle_offset;
  x.tail(s_.n_z) = y.segment(s_.z0, s_.n_z);
  if (body < 0 || misfit <= same_pose * std::max(1.0, s_.bodies[body].lever))
    return;
  const tree::TreeLink& link = tree_.links[static_cast<std::size_t>(tree_.link_of[body])];
  const std::string joint =
      link.joint < 0 ? "its coordinates" : "joint " + in_quotes(s_.joints[link.joint].name);
  throw SolverError(t, {Reason::range,
                        "body " + in_quotes(s_.bodies[body].name) + " stands where " + joint +
                            " does not lead: " + number_text(misfit) +
                            " m or rad off (a joint assembled upside down?)",
                        "bodies/" + s_.bodies[body].name,
                        {{"misfit", misfit}},
                        "use solver.coordinates = \"bodies\"",
                        ""});
}

void JointSpace::follow() {
  cut_.signals = s_.signals;
  cut_.lags = s_.lags;
  cut_.static_loads = s_.static_loads;
  cut_.rates = s_.rates;
  cut_.history = s_.history;
}

} // namespace hydrodae::tree
