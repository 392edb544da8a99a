#include "hydrodae/run/step_bound.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::run {

namespace {

/// Part of a step at each end in which the polynomial through the stages of radau is nearly exact.
constexpr double step_edge = 0.02;

} // namespace

StepBound::StepBound(const Problem& problem, double looser)
    : problem_(problem), looser_(looser),
      forcing_(problem.regime, problem.options.end_time, problem.scene.output.step) {}

double StepBound::find(const From& from, Course& course) {
  const double t = from.t, longer = stretch(from.integrator, course);
  const system::Forcing::Limit limit = forcing_.limit(from.turns, from.integrator.gap(), longer);
  if (course.event_near - t <= step_edge * (t - course.last_start)) // avoids a tiny last step
    course.event_near = INFINITY;
  const double step = problem_.scene.solver.step;
  constexpr double too_long = 4.0;
  if (step > too_long * (limit.time - t))
    throw SolverError(t, {Reason::step,
                          "the step of " + number_text(step) + " s is too long for " + *limit.by +
                              ", which may be passed over",
                          "",
                          {{"step", step}},
                          rounded_text(limit.time - t) + " s may do",
                          ""});
  double other = INFINITY; // bounds that longer steps of this run must not pass
  if (problem_.history)
    other = t + problem_.history->longest_step();
  if (longer < 1.0) {
    if (problem_.options.max_step > 0.0)
      other = std::min(other, t + problem_.options.max_step);
    other = t + longer * (other - t);
    // A step over a whole interval between two instants of controllers is split.
    const double next = from.next_control, part = longer * (next - course.control_since);
    if (std::isfinite(part) && next - t > part)
      other = std::min(other, t + part);
  }
  return std::min({limit.time, course.event_near, other});
}

/// Ratio of step lengths to those of the run which this run checks, for steps not bounded by the
/// tolerance. The ratio is that of the error control for the highest order so far (ida begins with
/// a low order).
double StepBound::stretch(const integrate::Integrator& integrator, Course& course) const {
  course.highest_order = std::max(course.highest_order, integrator.statistics().last_order);
  return looser_ == 1.0 ? 1.0 : std::pow(looser_, 1.0 / (course.highest_order + 1.0));
}

bool StepBound::is_inside(double start, double t, double end) {
  const double least = step_edge * (end - start);
  return t - start > least && end - t > least;
}

} // namespace hydrodae::run
