#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/methods.h"
#include "hydrodae/core/text.h"
#include "hydrodae/element/pto_linear.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {

namespace {

[[noreturn]] void refuse_solver(const std::string& key, const std::string& message) {
  throw ModelError("solver." + key, message);
}

/// Limits of steps and samples: more would never end, or never fit on a disk.
constexpr double most_steps = 1e10, most_samples = 1e9;

/// Checks that `step` divides the run into at most `most` parts.
void check_count(const Scene& scene, const std::string& key, double step, double most,
                 const std::string& parts) {
  const double end = scene.solver.end_time;
  if (!(end > step * most))
    return;
  const std::string step_text = key + " = " + number_text(step) + " s",
                    end_text = "solver.end_time = " + number_text(end) + " s";
  // The message names the key that the case contains.
  const bool given = scene.places.contains(key);
  throw ModelError(given ? key : "solver.end_time",
                   (given ? step_text + " divides the run to " + end_text
                          : end_text + " is divided by " + step_text + " (the default)") +
                       " into more than " + number_text(most) + " " + parts + "; for this end " +
                       key + " must be " + number_text(end / most) + " s or more");
}

void check_counts(const Scene& scene) {
  const SolverOptions& o = scene.solver;
  check_count(scene, "output.step", scene.output.step, most_samples, "samples");
  if (o.step > 0.0)
    check_count(scene, "solver.step", o.step, most_steps, "steps");
  if (o.max_step > 0.0)
    check_count(scene, "solver.max_step", o.max_step, most_steps, "steps");
  if (o.baumgarte_time > 0.0)
    check_count(scene, "solver.baumgarte_time", o.baumgarte_time, most_steps, "times");
  for (const element::PtoLinear& pto : forces_of<element::PtoLinear>(scene))
    if (pto.delay > 0.0) // steps are no longer than the delay
      check_count(scene, "force." + pto.name + ".delay", pto.delay, most_steps, "steps");
}

/// Text "5 or 8", "1, 3, .. 19".
std::string in_words(const std::vector<int>& orders) {
  const std::string first = std::to_string(orders[0]), second = std::to_string(orders[1]);
  return orders.size() == 2 ? first + " or " + second
                            : first + ", " + second + ", .. " + std::to_string(orders.back());
}

void check_order(const SolverOptions& o) {
  if (o.order == 0)
    return;
  const MethodTraits* method = find_method(o.method);
  if (!method)
    refuse_solver("order", "\"auto\" takes methods at orders of their own; name the method whose "
                           "order it is, such as method = \"radau\"");
  if (method->orders.empty())
    refuse_solver("order", std::string(method->one_order));
  if (std::find(method->orders.begin(), method->orders.end(), o.order) == method->orders.end())
    refuse_solver("order", o.method + " has order " + in_words(method->orders));
}

void check_step(const SolverOptions& o) {
  const MethodTraits* method = find_method(o.method);
  if (!method) {
    if (o.step > 0.0)
      refuse_solver("step",
                    "\"auto\" takes methods that choose their steps by rtol; for a fixed step "
                    "name the method, such as method = \"generalized_alpha\"; "
                    "solver.max_step limits them");
  } else {
    if (!method->adapts && o.step == 0.0)
      refuse_solver("step", o.method + " has a fixed step: give solver.step [s]");
    if (!method->fixes && o.step > 0.0)
      refuse_solver("step", o.method + " chooses its steps by rtol; solver.max_step limits them");
  }
  if (o.step > 0.0 && o.max_step > 0.0)
    refuse_solver("max_step", "has no meaning beside a fixed step");
  if (o.step > o.end_time)
    refuse_solver("step", "is longer than the run (" + number_text(o.end_time) + " s)");
}

void check_formulation(const SolverOptions& o) {
  const bool stabilised = o.formulation == "stabilised";
  const MethodTraits* method = find_method(o.method);
  if (!stabilised && !method)
    refuse_solver("formulation", "\"auto\" keeps to \"stabilised\", as all its methods do; for "
                                 "comparisons name the method, \"ida\" or \"radau\"");
  if (!stabilised && !method->drifting)
    refuse_solver("formulation", o.method + " has its own: only \"stabilised\" here");
  if (o.baumgarte_time > 0.0 && o.formulation != "index_1")
    refuse_solver("baumgarte_time", "belongs to formulation \"index_1\"");
  if (o.formulation != "index_3" || o.force)
    return;
  if (const std::string_view why = method->fails_index_3; !why.empty())
    refuse_solver("formulation",
                  std::string(why) + "; solver.force (--force) runs it all the same");
}

} // namespace

void check_solver(const Scene& scene) {
  const SolverOptions& o = scene.solver;
  check_order(o);
  check_step(o);
  check_formulation(o);
  check_counts(scene);
  const MethodTraits* method = find_method(o.method);
  if (o.max_order != 5 && !(method && method->limits_order))
    refuse_solver("max_order", "belongs to ida; " +
                                   (method ? o.method + " takes solver.order" : "name the method"));
  // The default is not a request.
  if (o.spectral_radius != SolverOptions{}.spectral_radius && !(method && method->takes_radius))
    refuse_solver("spectral_radius",
                  "belongs to generalized_alpha; " +
                      (method ? "leave it out with " + o.method : "name the method"));
}

} // namespace hydrodae::model
