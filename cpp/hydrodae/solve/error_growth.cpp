#include "hydrodae/solve/error_growth.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/system/mechanisms.h"

namespace hydrodae::solve {

namespace {
constexpr double rough = 0.5; ///< change of the equations from which on growth is not believed
// Growth per radian of the motion that may come of looks far apart; chaotic motions have 0.2 to 1.
constexpr double doubtful = 0.15;
// How much more than by themselves errors may show in the positions once the constraints take part,
// and where that is not believed.
constexpr double hidden = 1e3, doubtfully_hidden = 2.0;

/// By group: do the rows that hold leave no motion of its own to any of its mechanisms?
std::vector<bool> guided_groups(const system::Regime& s) {
  const std::vector<bool> mechanisms = system::guided_mechanisms(s);
  std::vector<bool> out(static_cast<std::size_t>(s.n_error_groups()), true);
  std::fill(out.begin() + s.n_groups, out.end(), false); // points
  for (const system::BodyData& b : s.bodies)
    if (b.group >= 0 && b.mechanism >= 0 && !mechanisms[static_cast<std::size_t>(b.mechanism)])
      out[static_cast<std::size_t>(b.group)] = false;
  return out;
}

} // namespace

ErrorGrowth::ErrorGrowth(const system::Regime& s, const system::Pattern& pattern, double t,
                         const VectorX& y, const VectorX& yp, Error error, bool coherent, int every)
    : s_(s), e_(s, pattern, 1.0), error_(std::move(error)), guided_(guided_groups(s)), y_(y),
      yp_(yp), growth_(VectorX::Ones(s.n_error_groups())), fade_(growth_),
      change_(VectorX::Zero(s.n_error_groups())), row_size_(s.n), since_(t), window_(t),
      coherent_(coherent), fewest_(std::max(1, every / 4)), most_(4 * every), every_(every) {
  linearise(t);
  first_by_y_ = by_y_;
  first_u_ = y_.segment(s.u0, s.n_u);
  if (error_.vector.size() > 0)
    return;
  error_.vector = error_.fresh = error_.gathered = VectorX::Zero(s.lambda0);
  error_.change = error_.added = error_.piled = error_.plain = error_.level = error_.rough_level =
      VectorX::Zero(s.n_error_groups());
  error_.since_rough = VectorX::Constant(s.n_error_groups(), INFINITY);
}

/// Root of the sum of squares over the positions and velocities of each group.
VectorX ErrorGrowth::sizes(const VectorX& vector, const VectorX& unit) const {
  VectorX out = VectorX::Zero(s_.n_error_groups());
  for (Index i = 0; i < s_.lambda0; ++i) {
    if (!s_.is_motion(i))
      continue;
    const double x = vector[i] / unit[i];
    out[s_.error_group[static_cast<std::size_t>(i)]] += x * x;
  }
  return out.cwiseSqrt();
}

/// The same of the positions alone.
VectorX ErrorGrowth::place_sizes(VectorX vector, const VectorX& unit) const {
  vector.segment(s_.u0, s_.z0 - s_.u0).setZero();
  for (const system::Block& block : s_.blocks)
    if (block.states >= 0 && block.moves)
      system::for_each_point(
          s_.states[static_cast<std::size_t>(block.states)],
          [&](Index, Index velocity, double) { vector.segment<3>(velocity).setZero(); });
  return sizes(vector, unit);
}

/// The derivatives at a look, for the next.
void ErrorGrowth::linearise(double t) {
  e_.accept(t, y_, yp_);
  e_.jacobian(t, y_, yp_);
  by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
}

bool ErrorGrowth::add(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate,
                      bool last, const Interpolant& at) {
  error_.fresh += step_error;
  const double phase = rate.size() > 0 ? rate.maxCoeff() * (t - window_) : 0.0;
  if (coherent_ && phase > 1.0) { // rad; what a step adds and the next takes away is none
    error_.added += sizes(error_.fresh - error_.gathered, unit);
    error_.gathered = error_.fresh;
    window_ = t;
  }
  if (++steps_ < every_ && !last)
    return false;
  steps_ = 0;
  growth_.setOnes();
  fade_.setOnes();
  const VectorX before = sizes(error_.vector, unit), fresh = sizes(error_.fresh, unit);
  VectorX shown = VectorX::Ones(s_.n_error_groups());
  at(t, y_, yp_);
  if (VectorX carried = error_.fresh; carry(t, rate, carried)) {
    const VectorX after = sizes(error_.vector, unit);
    const VectorX places = place_sizes(carried, unit);
    for (Index g = 0; g < s_.n_error_groups(); ++g) {
      if (fresh[g] > 0.0)
        shown[g] = std::clamp(places[g] / fresh[g], is_guided(g) ? 0.0 : 1.0,
                              change_[g] > rough ? doubtfully_hidden : hidden);
      if (before[g] > 0.0)
        growth_[g] = after[g] / before[g];
      if (!last && before[g] > 0.0) // no growth is told where the error of an impact is not carried
        follow(g, rate[g] * (t - since_));
    }
  }
  // It tells growth only, and is kept from growing without end.
  constexpr double large = 1.0;
  const VectorX size = sizes(error_.vector, unit);
  for (Index i = 0; i < s_.lambda0; ++i)
    if (const double own = size[s_.error_group[static_cast<std::size_t>(i)]]; !(own <= large))
      error_.vector[i] = std::isfinite(own) ? 1e-3 * error_.vector[i] / own : 0.0;
  error_.added += sizes(error_.fresh - error_.gathered, unit);
  error_.added.array() *= shown.array();
  error_.gathered.setZero();
  window_ = t;
  error_.piled += error_.added;
  error_.plain += error_.added;
  error_.added.setZero();
  error_.vector += error_.fresh;
  error_.fresh.setZero();
  since_ = t;
  return true;
}

/// What the growth of the vector means to what has piled up, over `phase` radians of the motion.
/// The level of E follows its logarithm, and leaks to zero as fast as growth may come of looks far
/// apart; so linear equations are followed exactly, and others as far as they grow or fade faster.
/// Where the equations change much between looks, growth is not believed, nor a long fading; but of
/// lines, which slacken and snap in all looks, and whose growth is true.
void ErrorGrowth::follow(Index g, double phase) {
  constexpr double deepest = -4.0; // levels below are not come back from
  const bool line = g >= s_.n_groups;
  const double before = error_.level[g],
               doubt = doubtful * std::min(change_[g] / rough, 1.0) * phase,
               seen = std::log(std::clamp(growth_[g], 1e-12, 1e6)),
               level = before + (change_[g] > rough && !line ? std::min(seen, 0.0) : seen);
  double now = level > 0.0 ? std::max(0.0, level - doubt) : std::min(0.0, level + doubt);
  if (error_.change[g] > rough)
    now = std::max(now, deepest);
  if (!line)
    now = std::min(now, between_rough(g, now));
  error_.piled[g] *= std::exp(now - before);
  error_.level[g] = std::max(now, deepest);
  fade_[g] = std::exp(std::min(0.0, now - error_.level[g]));
}

/// While something is struck, displacements become velocities, by the stiffness of the contact, and
/// displacements again as it lets go: half of this happens within looks that see too great a change
/// to follow it. So growth from one such look to the next is not believed, either.
double ErrorGrowth::between_rough(Index g, double level) {
  constexpr double together = 6.0; // looks
  ++error_.since_rough[g];
  if (change_[g] <= rough)
    return level;
  if (error_.since_rough[g] <= together)
    level = std::min(level, error_.rough_level[g]);
  error_.since_rough[g] = 0.0;
  error_.rough_level[g] = level;
  return level;
}

void ErrorGrowth::fade(Index g, double factor) {
  if (change_[g] > rough)
    error_.piled[g] *= factor;
}

/// In the units of the unknowns, relative to the largest of each row and to its inertia (the
/// directions of reactions turn in linear motions, too). Between looks, of stiffness and damping:
/// where they are too far apart errors would seem to grow that do not. Against the first look, of
/// what frequencies come of: stiffness and the gyroscopic moments, not valves and friction.
void ErrorGrowth::find_change(const VectorX& rate) {
  constexpr double much = 0.25, little = 0.05;
  const system::Pattern& p = e_.pattern;
  change_.setZero();
  row_size_.setZero();
  const auto entries = [&](auto&& visit) {
    for (Index c = 0; c < s_.lambda0; ++c)
      for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k)
        if (p.row[k] >= s_.u0 && s_.is_motion(c) && p.row[k] < s_.lambda0 && s_.is_motion(p.row[k]))
          visit(k, p.row[k], c, s_.scale[c]);
  };
  entries([&](Index k, Index row, Index, double scale) {
    const double inertia =
        std::abs(e_.parts.by_yp[k]) * rate[s_.error_group[static_cast<std::size_t>(row)]];
    row_size_[row] =
        std::max({row_size_[row], scale * std::abs(e_.parts.by_y[k]), scale * std::abs(by_y_[k]),
                  scale * std::abs(first_by_y_[k]), scale * inertia});
  });
  const auto take = [&](Index row, double difference, double& change) {
    if (difference > change * row_size_[row])
      change = difference / row_size_[row];
  };
  entries([&](Index k, Index row, Index column, double scale) {
    const int group = s_.error_group[static_cast<std::size_t>(row)];
    take(row, scale * std::abs(e_.parts.by_y[k] - by_y_[k]), change_[group]);
    if (column < s_.u0 || column >= s_.z0)
      take(row, scale * std::abs(e_.parts.by_y[k] - first_by_y_[k]), error_.change[group]);
  });
  for (const system::BodyData& b : s_.bodies) {
    if (b.rotation != system::BodyData::Rotation::free || b.group < 0)
      continue;
    const Index w = b.u0 + b.n_translations;
    const Matrix3 change = (system::gyroscopic_matrix(b.inertia, y_.segment<3>(w)) -
                            system::gyroscopic_matrix(b.inertia, first_u_.segment<3>(w - s_.u0)))
                               .cwiseAbs();
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        take(w + i, s_.scale[w + k] * change(i, k), error_.change[b.group]);
  }
  const double most = change_.size() > 0 ? change_.maxCoeff() : 0.0;
  if (most > much)
    every_ = std::max(fewest_, every_ / 2);
  else if (most < little)
    every_ = std::min(most_, every_ + 1 + every_ / 4);
}

/// The implicit midpoint rule on F_y d + F_y' d' = 0, with the mean of the derivatives at both
/// ends, lest what turns or swings between them feeds the error; memory states by backward Euler,
/// since some fade within the step; the constraints hold at its end, and so do the loads of states
/// of forces, which may fade within a thousandth of it. For the vector of the run and for `fresh`.
bool ErrorGrowth::carry(double t, const VectorX& rate, VectorX& fresh) {
  const double h = t - since_;
  if (h <= 0.0 || !error_.vector.allFinite() || !fresh.allFinite())
    return false;
  const system::Pattern& p = e_.pattern;
  if (!lu_)
    lu_ = std::make_unique<SparseLu<double>>(p.column_start, p.row);
  e_.accept(t, y_, yp_);
  e_.jacobian(t, y_, yp_);
  rhs_.setZero(s_.n);
  VectorX fresh_rhs = VectorX::Zero(s_.n);
  std::vector<double>& values = lu_->values();
  for (Index c = 0; c < s_.n; ++c)
    for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k) {
      const Index row = p.row[k];
      const bool of_force = c >= s_.z0 && c < s_.memory0 && !s_.is_absolute(c);
      const bool moves = s_.is_motion(row), half = moves && c < s_.lambda0 && !of_force;
      const double by_y = moves ? 0.5 * (by_y_[k] + e_.parts.by_y[k]) : e_.parts.by_y[k],
                   by_rate =
                       (moves ? 0.5 * (by_rate_[k] + e_.parts.by_yp[k]) : e_.parts.by_yp[k]) / h;
      values[k] = (half ? 0.5 * by_y : by_y) + by_rate;
      if (row < s_.lambda0 && c < s_.lambda0) {
        const double from = by_rate - (half ? 0.5 * by_y : 0.0);
        rhs_[row] += from * error_.vector[c];
        fresh_rhs[row] += from * fresh[c];
      }
    }
  find_change(rate);
  by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
  if (!lu_->factorise())
    return false; // a singular pose: the error stays what it was until the next look
  const auto solved = [&](VectorX& rhs, VectorX& vector) {
    constexpr double most = 1e3; // beyond, the constraints are about to become dependent
    lu_->solve(rhs.data());
    if (!rhs.allFinite() || rhs.head(s_.n_q).norm() > most * vector.norm())
      return false;
    vector = rhs.head(s_.lambda0);
    return true;
  };
  const bool carried = solved(rhs_, error_.vector);
  return solved(fresh_rhs, fresh) && carried;
}

} // namespace hydrodae::solve
