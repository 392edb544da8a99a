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
    return 100;
  if (method == "explicit_rk")
    return 16;
  return method == "generalized_alpha" ? 40 : 10;
}

/// What the tolerance leaves at least, in units of it: Newton's iteration, samples between the ends
/// of steps; BDF and the interpolant of order 7 keep less close to it than collocation.
constexpr double usual_least = 10.0, least_of_radau = 3.0, fixed_least = 1e-2;

double least_error(const model::SolverOptions& options) {
  if (options.step > 0.0)
    return fixed_least * options.rtol;
  return (options.method == "radau" ? least_of_radau : usual_least) * options.rtol;
}

/// Do the errors of steps add up radian by radian? Those of fixed steps are of one kind, and BDF
/// makes so many steps between two looks that their sum would cancel.
bool adds_by_radian(const model::SolverOptions& options) {
  return options.step > 0.0 || options.method == "ida";
}

/// d ln(frequency) / d ln(speed) by the change of the equations: 0 of a linear oscillator; of a
/// pendulum that swings by 0.5, 1 and 2.5 rad 0.03, 0.13 and 3.3, where these change by 0.2, 0.7
/// and 2; 1 of what turns round and round.
double out_of_step(double change) { return std::max(0.25 * change, 0.8 * change * change); }

} // namespace

Trust::Trust(const system::Regime& s, const system::Pattern& pattern,
             const model::SolverOptions& options, const VectorX& y, const VectorX& yp)
    : s_(s), every_(steps_between_looks(options.method)), coherent_(adds_by_radian(options)),
      exact_(options.step > 0.0), doubt_(options.step > 0.0 ? 3.0 : 2.0),
      allowed_(options.error_guard), least_(least_error(options)), unit_(VectorX::Ones(s.z0)),
      fastest_(VectorX::Zero(s.n_groups)), largest_(fastest_), when_(fastest_), missing_(fastest_),
      rates_(fastest_), displaced_(fastest_), start_(y.head(s.n_q)),
      energies_(static_cast<std::size_t>(std::max(s.n_mechanisms, 1))) {
  for (const system::BodyData& b : s.bodies)
    if (b.mechanism >= 0 && b.group >= 0)
      energies_[static_cast<std::size_t>(b.mechanism)].group = b.group;
  find_guided();
  growth_ = std::make_unique<ErrorGrowth>(s, pattern, 0.0, y, yp, ErrorGrowth::Error(), coherent_,
                                          every_);
}

/// Motion of a group, no less than what its tolerance is made for [levers or rad].
double Trust::size(Index group, const VectorX& reached) const {
  double expected = 0.0;
  for (const system::BodyData& b : s_.bodies)
    if (b.group == group)
      expected = std::max(expected, b.length_scale / b.lever * s_.motion_scale[group]);
  return std::max({reached[group], expected, 1e-300});
}

/// Positions count in levers or rad, velocities over the rate at which the group moves; where
/// bodies turn, or spin, much more than their centres are displaced, displacements count by their
/// own size.
void Trust::measure(const VectorX& y, const VectorX& reached) {
  constexpr double least_part = 1e-6;
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
  if (growth_->add(t, integrator.step_error(), unit_, rates_, event, at))
    look(t, reached, recorder);
}

void Trust::take(Index group, double t, double error) {
  if (error <= largest_[group])
    return;
  largest_[group] = error;
  when_[group] = t;
}

void Trust::take_inner(double t, const VectorX& errors) {
  for (Index i = 0; i < errors.size(); ++i)
    if (const int group = s_.bodies[static_cast<std::size_t>(i)].group; group >= 0)
      take(group, t, errors[i]);
}

/// How much of what is missing a mechanism remembers until the next look. Conservative ones forget
/// nothing; dampers take errors with the energy 4 K w of a swing that they take, as an error that
/// is carried along tells, too, if only where it turns little from look to look. What drives guide
/// altogether carries none.
double Trust::remembered(Energy& e, double phase, const system::Recorder::Balance& now) {
  constexpr double held = 10.0; // radians of the motion
  const double weight = std::exp(-phase / held);
  e.kinetic = e.kinetic > 0.0 ? weight * e.kinetic + (1.0 - weight) * now.now : now.now;
  const double taken = now.given - e.given;
  e.given = now.given;
  if (e.guided)
    return 0.0;
  const double damped = taken > 0.0 ? std::exp(-taken / std::max(4.0 * e.kinetic, 1e-300)) : 1.0;
  damped_[e.group] = std::max(damped_[e.group], damped);
  return std::max(growth_->fade()[e.group], damped);
}

/// Kinetic energy of a body that moves as its tolerance expects: less tells nothing.
double Trust::least(int mechanism) const {
  double out = 0.0;
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0 || b.mechanism != mechanism)
      continue;
    const double speed = b.length_scale / b.time_scale * s_.motion_scale[b.group];
    out = std::max(out, 0.5 * b.mass * speed * speed);
  }
  return out;
}

/// From dE / 2 K of the speed follows the same part of the size of the motion, and of its
/// frequency.
void Trust::take_energy(double t, const VectorX& reached, const system::Recorder& recorder) {
  constexpr double little = 1e-2; // kinetic energy, of all that was exchanged
  damped_.setZero(s_.n_groups);
  for (std::size_t m = 0; m < energies_.size() && s_.n_groups > 0; ++m) {
    Energy& e = energies_[m];
    const system::Recorder::Balance b =
        recorder.mechanisms().empty() ? recorder.whole() : recorder.mechanisms()[m];
    const double kinetic = std::max({b.kinetic, little * b.exchanged, least(static_cast<int>(m))}),
                 whole = size(e.group, reached), phase = fastest_[e.group] / whole * (t - looked_),
                 kept = remembered(e, phase, b);
    e.missing = kept * e.missing + b.error - e.seen;
    e.seen = b.error;
    if (e.guided || !(kinetic > 0.0))
      continue;
    const double part = std::abs(e.missing) / (2.0 * kinetic);
    const double change = growth_->change()[e.group];
    e.late = kept * e.late +
             (e.struck ? std::max(1.0, out_of_step(change)) : out_of_step(change)) * phase * part;
    missing_[e.group] = std::max(missing_[e.group], (part + e.late) * whole);
  }
  for (Index g = 0; g < s_.n_groups; ++g) // by the mechanism of the group that is damped least
    if (damped_[g] > 0.0)
      growth_->fade(g, damped_[g]);
}

/// The body of a group whose positions the carried error moves most.
const system::BodyData& Trust::worst_of(Index group) const {
  const ErrorGrowth::Error& e = growth_->error();
  const VectorX sizes = body_sizes(s_, (e.vector + e.fresh).head(s_.n_q));
  std::size_t worst = s_.bodies.size();
  for (std::size_t i = 0; i < s_.bodies.size(); ++i)
    if (s_.bodies[i].group == group &&
        (worst == s_.bodies.size() ||
         sizes[static_cast<Index>(i)] > sizes[static_cast<Index>(worst)]))
      worst = i;
  return s_.bodies[worst];
}

void Trust::look(double t, const VectorX& reached, const system::Recorder& recorder) {
  constexpr double seen = 1e-2;
  missing_.setZero();
  take_energy(t, reached, recorder);
  looked_ = t;
  const ErrorGrowth::Error& e = growth_->error();
  for (Index g = 0; g < s_.n_groups; ++g) {
    const double off = std::max(e.piled[g], missing_[g]);
    take(g, t, off);
    const double whole = size(g, reached);
    const double most = allowed_ * whole / doubt_;
    // Growth alone, of next to nothing, may be that of looks too far apart.
    const bool grown = e.piled[g] > most && e.plain[g] > seen * most;
    if (allowed_ > 0.0 && (grown || missing_[g] > most))
      throw SolverError(
          t, "stopped at t = " + number_text(t) + " s: the errors of the steps so far have put " +
                 in_quotes(worst_of(g).name) + " off by about " + rounded_text(off / whole) +
                 " of the motion, give or take a factor of " + number_text(doubt_) +
                 ", which may be more than " + number_text(allowed_) +
                 " (solver.error_guard; 0: no guard): from here on the motion is not to be "
                 "trusted; a smaller tolerance or step carries it further");
  }
}

void Trust::find_guided() {
  const std::vector<bool> guided = system::guided_mechanisms(s_);
  for (std::size_t m = 0; m < energies_.size(); ++m)
    energies_[m].guided = guided[m];
}

void Trust::strike(int mechanism) { energies_[static_cast<std::size_t>(mechanism)].struck = true; }

/// What the methods before have left inside their steps stays.
void Trust::use(const model::SolverOptions& options) {
  every_ = steps_between_looks(options.method);
  coherent_ = adds_by_radian(options);
  least_ = std::max(least_, least_error(options));
}

void Trust::restart(const system::Pattern& pattern, double t, const VectorX& y, const VectorX& yp) {
  find_guided();
  ErrorGrowth::Error error = growth_->error();
  growth_ =
      std::make_unique<ErrorGrowth>(s_, pattern, t, y, yp, std::move(error), coherent_, every_);
}

void Trust::remember(Archive& a) {
  a(*growth_, unit_, fastest_, largest_, when_, missing_, damped_, rates_, displaced_, energies_,
    looked_, least_, exact_);
}

Trust::Estimate Trust::estimate(const VectorX& reached) const {
  const ErrorGrowth::Error& e = growth_->error();
  Estimate out;
  for (Index g = 0; g < s_.n_groups; ++g) {
    double now = e.piled[g] + e.added[g];
    for (Index i = 0; i < s_.z0; ++i)
      if (s_.group[static_cast<std::size_t>(i)] == g && !growth_->is_guided(g))
        now += std::abs(e.fresh[i] - e.gathered[i]) / unit_[i];
    // An error as large as the motion: beyond, growth says no more.
    const double whole = size(g, reached),
                 error = std::max(std::min(std::max(largest_[g], now) / whole, 1.0), least_);
    if (error > out.error)
      out = {error, worst_of(g).name, when_[g]};
  }
  return out;
}

} // namespace hydrodae::solve
