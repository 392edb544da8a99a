#include "hydrodae/solve/error_growth.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/solve/impact_error.h"
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

/// By group: of bodies, none of which floats?
std::vector<bool> dry_groups(const system::Regime& s) {
  std::vector<bool> out(static_cast<std::size_t>(s.n_error_groups()), true);
  std::fill(out.begin() + s.n_groups, out.end(), false); // points
  for (const system::HydroBody& floating : s.hydro.bodies)
    if (const int g = s.bodies[static_cast<std::size_t>(floating.body)].group; g >= 0)
      out[static_cast<std::size_t>(g)] = false;
  return out;
}

} // namespace

ErrorGrowth::ErrorGrowth(const system::Regime& s, const system::Pattern& pattern, double t,
                         const VectorX& y, const VectorX& yp, Error error, Way way, int every)
    : s_(s), flow_(s, pattern, t, y, yp), guided_(guided_groups(s)), smooth_(smooth_groups(s, way)),
      any_smooth_(std::find(smooth_.begin(), smooth_.end(), true) != smooth_.end()),
      kinks_(kinks(s, way)),
      any_kinks_(std::find(kinks_.begin(), kinks_.end(), true) != kinks_.end()),
      dry_(dry_groups(s)), y_(y), yp_(yp), growth_(VectorX::Ones(s.n_error_groups())),
      fade_(growth_), suspected_(VectorX::Zero(s.n_error_groups())),
      change_(VectorX::Zero(s.n_error_groups())), since_(t), window_(t), way_(way),
      fewest_(std::max(1, every / 4)), most_(4 * every), every_(every) {
  begin(std::move(error));
}

void ErrorGrowth::begin(Error error) {
  const bool with_signs = way_ == Way::with_signs;
  error_ = std::move(error);
  if (error_.vector.size() == 0) {
    error_.vector = error_.middle = error_.old = error_.fresh = error_.gathered =
        VectorX::Zero(s_.lambda0);
    error_.old_piled = error_.window = error_.change = error_.added = error_.piled = error_.plain =
        error_.level = error_.rough_level = VectorX::Zero(s_.n_error_groups());
    error_.since_rough = VectorX::Constant(s_.n_error_groups(), INFINITY);
  } else if (with_signs && !error_.with_signs) { // another method has come
    error_.old.swap(error_.vector);
    error_.old_piled = error_.piled;
  } else if (!with_signs && error_.with_signs) {
    error_.vector += error_.middle + error_.old;
    error_.middle.setZero();
    error_.old.setZero();
  }
  error_.with_signs = with_signs;
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

bool ErrorGrowth::add(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate,
                      const VectorX& motion, bool last, const Interpolant& at) {
  if (way_ == Way::with_signs)
    return add_with_signs(t, step_error, unit, rate, motion, last, at);
  error_.fresh += step_error;
  const double phase = rate.size() > 0 ? rate.maxCoeff() * (t - window_) : 0.0;
  if (way_ == Way::coherently &&
      phase > 1.0) { // rad; what a step adds and the next takes away is none
    error_.added += sizes(error_.fresh - error_.gathered, unit);
    error_.gathered = error_.fresh;
    window_ = t;
  }
  if (any_smooth_)
    keep(t, step_error, rate, motion, at);
  if (++steps_ < every_ && !last)
    return false;
  at(t, y_, yp_);
  growth_.setOnes();
  fade_.setOnes();
  const VectorX before = sizes(error_.vector, unit), fresh = sizes(error_.fresh, unit);
  VectorX shown = VectorX::Ones(s_.n_error_groups());
  if (any_smooth_)
    flow_.keep(last_look_);
  const VectorX at_last_look = error_.vector;
  bool closely = false;
  if (VectorX carried = error_.fresh; carry(t, rate, carried)) {
    const VectorX after = sizes(error_.vector, unit);
    const VectorX places = place_sizes(carried, unit);
    for (Index g = 0; g < s_.n_error_groups(); ++g) {
      if (fresh[g] > 0.0)
        shown[g] = std::clamp(places[g] / fresh[g], is_guided(g) ? 0.0 : 1.0,
                              change_[g] > rough ? doubtfully_hidden : hidden);
      if (before[g] > 0.0)
        growth_[g] = after[g] / before[g];
    }
    closely = !last && n_pieces_ > 1 && is_doubtful(motion.cwiseProduct(rate) * (t - since_));
    // None is told where the error of an impact is not carried.
    for (Index g = 0; g < s_.n_error_groups(); ++g)
      if (last || before[g] <= 0.0)
        continue;
      else if (!is_smooth(g))
        follow(g, rate[g] * (t - since_));
      else if (!closely)
        grow(g, std::log(std::clamp(growth_[g], 1e-12, 1e6)),
             doubt_of(g, rate[g] * (t - since_), INFINITY));
    for (Index g = 0; g < s_.n_error_groups(); ++g)
      suspect(g, 0.0);
  }
  error_.added += sizes(error_.fresh - error_.gathered, unit);
  error_.added.array() *= shown.array();
  if (closely)
    look_closely(unit, rate, motion, at_last_look);
  limit(error_.vector, unit, VectorX::Ones(rate.size()), 1e-3); // it tells growth only
  error_.piled += error_.added;
  error_.plain += error_.added;
  error_.gathered.setZero();
  window_ = t;
  error_.added.setZero();
  take_in(error_.fresh, unit, error_.vector);
  error_.fresh.setZero();
  since_ = t;
  steps_ = 0;
  n_pieces_ = 0;
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

bool ErrorGrowth::is_rough(Index g) const {
  return change_[g] > rough || (kinks_[static_cast<std::size_t>(g)] && error_.change[g] > 0.25);
}

void ErrorGrowth::fade(Index g, double factor) {
  if (change_[g] > rough && !kinks_[static_cast<std::size_t>(g)])
    error_.piled[g] *= factor;
}

/// Where a group's part of the vector is larger than `most`, it is brought to a part of that.
void ErrorGrowth::limit(VectorX& vector, const VectorX& unit, const VectorX& most,
                        double part) const {
  const VectorX size = sizes(vector, unit);
  for (Index i = 0; i < s_.lambda0; ++i)
    if (const int g = s_.error_group[static_cast<std::size_t>(i)]; !(size[g] <= most[g]))
      vector[i] = std::isfinite(size[g]) ? part * most[g] * vector[i] / size[g] : 0.0;
}

/// Looks are as close as the equations change between them.
void ErrorGrowth::look_again(double change, double much, double little) {
  if (change > much)
    every_ = std::max(fewest_, every_ / 2);
  else if (change < little)
    every_ = std::min(most_, every_ + 1 + every_ / 4);
}

/// What has piled up grows as far as the vector does, and that is more than an impact may seem to
/// do to its size alone, since displacements turn into velocities.
void ErrorGrowth::carry_over(const ImpactError& impact, const VectorX& unit) {
  constexpr double doubtful_factor = 2.0;
  const auto growth = [&](VectorX& vector) {
    const VectorX before = sizes(vector, unit);
    impact(vector, unit);
    VectorX out = VectorX::Ones(before.size());
    const VectorX after = sizes(vector, unit);
    for (Index g = 0; g < before.size(); ++g)
      if (before[g] > 0.0 && std::isfinite(after[g]))
        out[g] = after[g] / before[g];
    return out;
  };
  const VectorX grown = growth(error_.vector);
  if (error_.with_signs) {
    growth(error_.middle);
    error_.old_piled.array() *= growth(error_.old).array();
    error_.piled = error_.old_piled + sizes(error_.middle, unit) + sizes(error_.vector, unit);
  } else {
    error_.piled.array() *= (grown / doubtful_factor).cwiseMax(1.0).array();
  }
}

/// The vector of the run and `fresh`.
bool ErrorGrowth::carry(double t, const VectorX& rate, VectorX& fresh) {
  if (t <= since_ || !error_.vector.allFinite() || !fresh.allFinite())
    return false;
  const bool regular = flow_.look(t, y_, yp_, 1);
  flow_.compare(rate, change_, error_.change);
  look_again(change_.size() > 0 ? change_.maxCoeff() : 0.0, 0.25, 0.05);
  if (!regular)
    return false; // the error stays what it was until the next look
  const bool carried = flow_.step(error_.vector);
  return flow_.step(fresh) && carried;
}

} // namespace hydrodae::solve
