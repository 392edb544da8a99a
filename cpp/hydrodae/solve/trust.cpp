#include "hydrodae/solve/trust.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/solve/step_error.h"

namespace hydrodae::solve {

namespace {

/// Steps between two looks: the work of a look, a Jacobian and its factors, against that of a step.
int steps_between_looks(const std::string& method) {
  if (method == "explicit_rk")
    return 4;
  if (method == "ida")
    return 40;
  return method == "generalized_alpha" ? 20 : 5;
}

} // namespace

Trust::Trust(const system::System& s, const system::Pattern& pattern,
             const model::SolverOptions& options)
    : s_(s), every_(steps_between_looks(options.method)), allowed_(options.error_guard),
      rtol_(options.step > 0.0 ? 0.0 : options.rtol), unit_(VectorX::Ones(s.z0)),
      fastest_(VectorX::Zero(s.n_groups)), largest_(fastest_), when_(fastest_) {
  growth_ = std::make_unique<ErrorGrowth>(s, pattern, 0.0, ErrorGrowth::Error(), every_);
}

/// Motion of a group, no less than what its tolerance is made for [levers or rad].
double Trust::size(Index group, const VectorX& reached) const {
  double expected = 0.0;
  for (const system::BodyData& b : s_.bodies)
    if (b.group == group)
      expected = std::max(expected, b.length_scale / b.lever * s_.motion_scale[group]);
  return std::max({reached[group], expected, 1e-300});
}

/// Positions count in levers or rad, velocities over the rate at which the group moves.
void Trust::measure(const VectorX& y, const VectorX& reached) {
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0)
      continue;
    double& fastest = fastest_[b.group];
    for (int k = 0; k < b.n_active; ++k)
      fastest = std::max(fastest, std::abs(y[b.u0 + k]) / (b.active[k] < 3 ? b.lever : 1.0));
  }
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0)
      continue;
    const double rate =
        std::max(fastest_[b.group] / std::max(reached[b.group], 1e-300), 1e-3 / b.time_scale);
    for (int k = 0; k < b.n_active; ++k)
      unit_[b.u0 + k] = (b.active[k] < 3 ? b.lever : 1.0) * rate;
    for (int k = 0; k < b.n_position; ++k)
      unit_[b.q0 + k] = k < b.n_translations                             ? b.lever
                        : b.rotation == system::BodyData::Rotation::free ? 0.5
                                                                         : 1.0;
  }
}

void Trust::accept(double t, Integrator& integrator, const VectorX& reached, const VectorX& y) {
  const auto at = [&](double time, VectorX& out, VectorX& rates) {
    integrator.interpolate(time, out, rates);
  };
  measure(y, reached);
  if (growth_->add(t, integrator.step_error(), unit_, at))
    look(t, reached);
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

void Trust::look(double t, const VectorX& reached) {
  constexpr double seen = 1e-2; // of the guard, that the errors must add up to without growth
  const ErrorGrowth::Error& e = growth_->error();
  for (Index g = 0; g < s_.n_groups; ++g) {
    if (e.piled[g] > largest_[g]) {
      largest_[g] = e.piled[g];
      when_[g] = t;
    }
    const double whole = size(g, reached);
    if (allowed_ > 0.0 && e.piled[g] > allowed_ * whole && e.plain[g] > seen * allowed_ * whole)
      throw SolverError(
          t, "stopped at t = " + number_text(t) + " s: the errors of the steps so far have put " +
                 in_quotes(worst_of(g).name) + " off by about " + rounded_text(e.piled[g] / whole) +
                 " of the motion, more than " + number_text(allowed_) +
                 " (solver.error_guard; 0: no guard): from here on the motion is not to be "
                 "trusted; a smaller tolerance or step carries it further");
  }
}

void Trust::restart(const system::Pattern& pattern, double t) {
  ErrorGrowth::Error error = growth_->error();
  growth_ = std::make_unique<ErrorGrowth>(s_, pattern, t, std::move(error), every_);
}

Trust::Estimate Trust::estimate(const VectorX& reached) const {
  constexpr double inside = 3.0; // tolerances: Newton's iteration, interpolation of samples
  const ErrorGrowth::Error& e = growth_->error();
  Estimate out;
  for (Index g = 0; g < s_.n_groups; ++g) {
    double now = e.piled[g];
    for (Index i = 0; i < s_.z0; ++i)
      if (s_.group[static_cast<std::size_t>(i)] == g)
        now += std::abs(e.fresh[i]) / unit_[i];
    const double error =
        std::max({largest_[g] / size(g, reached), now / size(g, reached), inside * rtol_});
    if (error > out.error)
      out = {error, worst_of(g).name, when_[g]};
  }
  return out;
}

} // namespace hydrodae::solve
