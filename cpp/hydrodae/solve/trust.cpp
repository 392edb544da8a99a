#include "hydrodae/solve/trust.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/solve/step_error.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::solve {

namespace {

/// Steps between two looks: the work of a look, a Jacobian and its factors, against that of a step.
int steps_between_looks(const std::string& method) {
  if (method == "ida")
    return 16;
  if (method == "explicit_rk")
    return 16;
  return method == "generalized_alpha" ? 40 : 10;
}

/// What the tolerance leaves at least, in units of it: Newton's iteration, samples between the ends
/// of steps; BDF and the interpolant of order 7 keep less close to it than collocation.
constexpr double usual_least = 10.0, least_of_radau = 3.0, fixed_least = 0.1;

double least_error(const model::SolverOptions& options) {
  if (options.step > 0.0)
    return fixed_least * options.rtol;
  return (options.method == "radau" ? least_of_radau : usual_least) * options.rtol;
}

/// Those of fixed steps are of one kind; BDF knows their signs, and makes so many of them between
/// two looks that their sum would cancel.
ErrorGrowth::Way way_of(const model::SolverOptions& options) {
  if (options.step > 0.0)
    return ErrorGrowth::Way::coherently;
  return options.method == "ida" ? ErrorGrowth::Way::with_signs : ErrorGrowth::Way::sizes;
}

} // namespace

Trust::Trust(const system::Regime& s, const system::Pattern& pattern,
             const model::SolverOptions& options, const VectorX& y, const VectorX& yp)
    : s_(s), every_(steps_between_looks(options.method)), way_(way_of(options)),
      exact_(options.step > 0.0), doubt_(options.step > 0.0 ? 3.0 : 2.0),
      allowed_(options.error_guard), least_(least_error(options)), unit_(VectorX::Ones(s.lambda0)),
      reached_(VectorX::Zero(s.n_error_groups())), fastest_(reached_), largest_(reached_),
      when_(reached_), piled_(MatrixX::Zero(reached_.size(), 3)), missing_(reached_),
      most_missing_(reached_), rates_(reached_), displaced_(reached_), start_(y.head(s.lambda0)),
      energies_(static_cast<std::size_t>(std::max(s.n_mechanisms, 1))) {
  for (const system::BodyData& b : s.bodies)
    if (b.mechanism >= 0 && b.group >= 0)
      energies_[static_cast<std::size_t>(b.mechanism)].group = b.group;
  find_guided();
  growth_ =
      std::make_unique<ErrorGrowth>(s, pattern, 0.0, y, yp, ErrorGrowth::Error(), way_, every_);
}

/// Motion that the tolerance of a group is made for [levers or rad].
double Trust::expected(Index group) const {
  double out = 0.0;
  for (const system::Block& block : s_.blocks) {
    if (block.group != group || !block.moves)
      continue;
    if (block.body >= 0) {
      const system::BodyData& b = s_.bodies[static_cast<std::size_t>(block.body)];
      out = std::max(out, b.length_scale / b.lever * s_.motion_scale[group]);
    } else {
      system::for_each_point(s_.states[static_cast<std::size_t>(block.states)],
                             [&](Index place, Index, double length) {
                               out = std::max(out, s_.scale[place] / length);
                             });
    }
  }
  return out;
}

/// Motion of a group, no less than that [levers or rad].
double Trust::size(Index group) const {
  return std::max({reached_[group], expected(group), 1e-300});
}

/// Positions count in levers or rad, velocities over the rate at which the group moves; where
/// bodies turn, or spin, much more than their centres are displaced, displacements count by their
/// own size.
void Trust::measure(const VectorX& y, const VectorX& reached) {
  constexpr double least_part = 1e-6;
  reached_.head(s_.n_groups) = reached;
  for (const system::Block& block : s_.blocks)
    if (block.states >= 0 && block.moves)
      measure_points(block, y);
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0)
      continue;
    double& fastest = fastest_[b.group];
    for (int k = 0; k < b.n_active; ++k)
      fastest = std::max(fastest, std::abs(y[b.u0 + k]) / (b.active[k] < 3 ? b.lever : 1.0));
    const Index n = b.n_translations;
    displaced_[b.group] = std::max(displaced_[b.group],
                                   (y.segment(b.q0, n) - start_.segment(b.q0, n)).norm() / b.lever);
  }
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0)
      continue;
    const double rate =
        std::max(fastest_[b.group] / std::max(reached[b.group], 1e-300), 1e-3 / b.time_scale);
    rates_[b.group] = rate;
    const double part =
        std::clamp(displaced_[b.group] / std::max(reached[b.group], 1e-300), least_part, 1.0);
    const double length = b.lever * part;
    for (int k = 0; k < b.n_active; ++k)
      unit_[b.u0 + k] = (b.active[k] < 3 ? length : 1.0) * rate;
    for (int k = 0; k < b.n_position; ++k)
      unit_[b.q0 + k] = k < b.n_translations                             ? length
                        : b.rotation == system::BodyData::Rotation::free ? 0.5
                                                                         : 1.0;
  }
}

/// Points have no turns, and their tolerances no motion to follow.
void Trust::measure_points(const system::Block& block, const VectorX& y) {
  const system::StateBlock& states = s_.states[static_cast<std::size_t>(block.states)];
  double &reached = reached_[block.group], &fastest = fastest_[block.group];
  system::for_each_point(states, [&](Index place, Index velocity, double length) {
    reached = std::max(reached, (y.segment<3>(place) - start_.segment<3>(place)).norm() / length);
    fastest = std::max(fastest, y.segment<3>(velocity).norm() / length);
  });
  const double time =
      states.body < 0 ? 1.0 : s_.bodies[static_cast<std::size_t>(states.body)].time_scale;
  const double rate = std::max(fastest / std::max(reached, 1e-300), 1e-3 / time);
  rates_[block.group] = rate;
  system::for_each_point(states, [&](Index place, Index velocity, double length) {
    const double fast = s_.scale[velocity] / s_.scale[place];
    unit_.segment<3>(place).setConstant(length);
    unit_.segment<3>(velocity).setConstant(length * std::max(rate, fast));
  });
}

void Trust::accept(double t, Integrator& integrator, const VectorX& reached, const VectorX& y,
                   bool event, const system::Recorder& recorder) {
  const auto at = [&](double time, VectorX& out, VectorX& rates) {
    integrator.interpolate(time, out, rates);
  };
  if (event && exact_) { // it is located within the tolerance, which the steps do not know
    least_ *= usual_least / fixed_least;
    exact_ = false;
  }
  measure(y, reached);
  take_inner(t, integrator.inner_error());
  if (growth_->add(t, integrator.step_error(), unit_, rates_, reached_, event, at))
    look(t, recorder);
}

void Trust::take(Index group, double t, double error) {
  if (error <= largest_[group])
    return;
  largest_[group] = error;
  when_[group] = t;
}

void Trust::take_inner(double t, const VectorX& errors) {
  for (Index i = 0; i < errors.size(); ++i)
    if (const system::Block& block = s_.blocks[static_cast<std::size_t>(i)];
        block.moves && block.group >= 0)
      take(block.group, t, errors[i]);
}

/// The body or line of a group whose positions the carried error moves most.
const std::string& Trust::worst_of(Index group) const {
  const ErrorGrowth::Error& e = growth_->error();
  const VectorX sizes = block_sizes(s_, e.vector + e.fresh);
  std::size_t worst = s_.blocks.size();
  for (std::size_t i = 0; i < s_.blocks.size(); ++i)
    if (s_.blocks[i].group == group && s_.blocks[i].moves &&
        (worst == s_.blocks.size() ||
         sizes[static_cast<Index>(i)] > sizes[static_cast<Index>(worst)]))
      worst = i;
  return s_.blocks[worst].name;
}

/// The least of the last looks: what is gone in the next was that of a singular pose.
double Trust::lasting(Index group, double now) {
  piled_(group, 2) = piled_(group, 1);
  piled_(group, 1) = piled_(group, 0);
  piled_(group, 0) = now;
  return piled_.row(group).minCoeff();
}

void Trust::look(double t, const system::Recorder& recorder) {
  missing_.setZero();
  take_energy(t, recorder);
  looked_ = t;
  const ErrorGrowth::Error& e = growth_->error();
  for (Index g = 0; g < reached_.size(); ++g) {
    const double piled = lasting(g, e.piled[g]), off = std::max(piled, missing_[g]);
    take(g, t, off);
    most_missing_[g] = std::max(most_missing_[g], missing_[g]);
    const double whole = size(g);
    const double most = allowed_ * whole / doubt_;
    if (allowed_ > 0.0 && ((piled > most && has_steps(g, most)) || missing_[g] > most))
      fail(t, g, off / whole,
           ": from here on the motion is not to be trusted; a smaller tolerance or step carries it "
           "further");
  }
}

/// Growth alone, of next to nothing, may be that of looks too far apart: is enough of the error
/// that of the steps themselves, or growth followed, or so large with its signs that it is beyond
/// doubt?
bool Trust::has_steps(Index group, double most) const {
  constexpr double seen = 1e-2, seen_of_followed = 1e-6, beyond_doubt = 4.0;
  const ErrorGrowth::Error& e = growth_->error();
  const bool followed =
      growth_->is_smooth(group) || (e.with_signs && e.piled[group] > beyond_doubt * most);
  return e.plain[group] > (followed ? seen_of_followed : seen) * most;
}

void Trust::fail(double t, Index group, double off, const std::string& then) const {
  throw SolverError(t, "stopped at t = " + number_text(t) +
                           " s: the errors of the steps so far have put " +
                           in_quotes(worst_of(group)) + " off by about " + rounded_text(off) +
                           " of the motion, give or take a factor of " + number_text(doubt_) +
                           ", which may be more than " + number_text(allowed_) +
                           " (solver.error_guard; 0: no guard)" + then);
}

/// During the run the motion is what start and loads let expect, and what is gone in the next looks
/// does not count; at its end the motion is what it was, and the error what it is.
void Trust::finish(double t) const {
  for (Index g = 0; g < reached_.size() && allowed_ > 0.0; ++g) {
    const double whole = moved(g), most = allowed_ * whole / doubt_;
    if (reached_[g] < whole) // next to no motion that could be off
      continue;
    const double off = std::max(largest_[g], piled_now(g));
    if ((off > most && has_steps(g, most)) || most_missing_[g] > most)
      fail(t, g, off / whole, " at the end of the run: a smaller tolerance or step may do");
  }
}

void Trust::strike(int mechanism) { energies_[static_cast<std::size_t>(mechanism)].struck = true; }

/// What the methods before have left inside their steps stays.
void Trust::use(const model::SolverOptions& options) {
  every_ = steps_between_looks(options.method);
  way_ = way_of(options);
  least_ = std::max(least_, least_error(options));
}

void Trust::restart(const system::Pattern& pattern, double t, const VectorX& y, const VectorX& yp) {
  find_guided();
  ErrorGrowth::Error error = growth_->error();
  growth_ = std::make_unique<ErrorGrowth>(s_, pattern, t, y, yp, std::move(error), way_, every_);
}

void Trust::remember(Archive& a) {
  a(*growth_, unit_, reached_, fastest_, largest_, when_, missing_, most_missing_, damped_, rates_,
    displaced_, energies_, looked_, least_, exact_, piled_);
}

/// What a group has moved by [levers or rad].
double Trust::moved(Index group) const {
  constexpr double at_rest = 0.01; // of the motion expected: what moves less has none of its own
  return std::max({reached_[group], at_rest * expected(group), 1e-300});
}

/// What has piled up in a group, with the errors since the last look.
double Trust::piled_now(Index group) const {
  const ErrorGrowth::Error& e = growth_->error();
  double now = e.piled[group] + e.added[group];
  for (Index i = 0; i < s_.lambda0; ++i)
    if (s_.error_group[static_cast<std::size_t>(i)] == group && s_.is_motion(i) &&
        !growth_->is_guided(group))
      now += std::abs(e.fresh[i] - e.gathered[i]) / unit_[i];
  return now;
}

bool Trust::at_rest() const {
  constexpr double none = 1e-10; // levers or rad
  return reached_.size() > 0 && reached_.maxCoeff() < none;
}

Trust::Estimate Trust::estimate() const {
  Estimate out;
  for (Index g = 0; g < reached_.size(); ++g) {
    // Tolerances are made for the motion that was expected; the estimate is told of what was
    // reached. An error as large as the motion: beyond, growth says no more.
    const double hoped = expected(g), whole = moved(g),
                 left = least_ * std::max(hoped / whole, 1.0),
                 error = std::min(std::max({largest_[g] / whole, piled_now(g) / whole, left}), 1.0);
    if (error > out.error)
      out = {error, worst_of(g), when_[g]};
  }
  return out;
}

} // namespace hydrodae::solve
