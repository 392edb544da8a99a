#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {

namespace {

[[noreturn]] void refuse_solver(const std::string& key, const std::string& message) {
  throw ModelError("solver." + key, message);
}

/// A run of more steps or samples would never end, or never fit on a disk.
constexpr double most_steps = 1e10, most_samples = 1e9;

/// `step` may divide the run into `most` parts at most.
void check_count(const Scene& scene, const std::string& key, double step, double most,
                 const std::string& parts) {
  const double end = scene.solver.end_time;
  if (!(end > step * most))
    return;
  const std::string step_text = key + " = " + number_text(step) + " s",
                    end_text = "solver.end_time = " + number_text(end) + " s";
  // Where only one of the two is written down, that one is to blame.
  const bool given = scene.positions.contains(key);
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
  for (const element::PtoLinear& pto : std::get<std::vector<element::PtoLinear>>(scene.forces))
    if (pto.delay > 0.0) // no step is longer than it
      check_count(scene, "force." + pto.name + ".delay", pto.delay, most_steps, "steps");
}

struct Orders {
  int low, high;
  bool odd;
};

void check_order(const SolverOptions& o) {
  if (o.order == 0)
    return;
  if (o.method == "auto")
    refuse_solver("order", "\"auto\" takes methods at orders of their own; name the method whose "
                           "order it is, such as method = \"radau\"");
  if (o.method == "ida")
    refuse_solver("order", "ida varies its order; solver.max_order limits it");
  if (o.method == "generalized_alpha")
    refuse_solver("order", "generalized_alpha is always of order 2");
  if (o.method == "explicit_rk" && o.order != 5 && o.order != 8)
    refuse_solver("order", "explicit_rk has order 5 or 8");
  const Orders orders = o.method == "radau"   ? Orders{1, 19, true}
                        : o.method == "gauss" ? Orders{2, 20, false}
                                              : Orders{2, 18, false};
  if (o.method != "explicit_rk" &&
      (o.order < orders.low || o.order > orders.high || (o.order % 2 == 1) != orders.odd))
    refuse_solver("order", o.method + (orders.odd ? " has odd orders, " : " has even orders, ") +
                               std::to_string(orders.low) + " to " + std::to_string(orders.high));
}

void check_step(const SolverOptions& o) {
  const bool fixed =
      o.method == "gauss" || o.method == "lobatto_iiic" || o.method == "generalized_alpha";
  if (fixed && o.step == 0.0)
    refuse_solver("step", o.method + " has a fixed step: give solver.step [s]");
  if (o.method == "auto" && o.step > 0.0)
    refuse_solver("step",
                  "\"auto\" takes methods that choose their steps by rtol; for a fixed step "
                  "name the method, such as method = \"generalized_alpha\"; "
                  "solver.max_step limits them");
  if (o.method == "ida" && o.step > 0.0)
    refuse_solver("step", "ida chooses its steps by rtol; solver.max_step limits them");
  if (o.step > 0.0 && o.max_step > 0.0)
    refuse_solver("max_step", "has no meaning beside a fixed step");
  if (o.step > o.end_time)
    refuse_solver("step", "is longer than the run (" + number_text(o.end_time) + " s)");
}

void check_formulation(const SolverOptions& o) {
  const bool stabilised = o.formulation == "stabilised";
  if (!stabilised && o.method == "auto")
    refuse_solver("formulation", "\"auto\" keeps to \"stabilised\", as all its methods do; for "
                                 "comparisons name the method, \"ida\" or \"radau\"");
  if (!stabilised && (o.method == "generalized_alpha" || o.method == "explicit_rk"))
    refuse_solver("formulation", o.method + " has its own: only \"stabilised\" here");
  if (o.baumgarte_time > 0.0 && o.formulation != "index_1")
    refuse_solver("baumgarte_time", "belongs to formulation \"index_1\"");
  if (o.force)
    return;
  if (o.method == "gauss" && o.formulation == "index_3")
    refuse_solver("formulation", "Gauss methods diverge on index 3, as they are not stiffly "
                                 "accurate; solver.force (--force) runs it none the less");
  if (o.method == "ida" && o.formulation == "index_3")
    refuse_solver("formulation", "BDF on index 3 loses two to three digits and often stops: its "
                                 "error test sees the velocities like multipliers; solver.force "
                                 "(--force) runs it none the less");
}

void check_coordinates(const SolverOptions& o) {
  if (o.coordinates == "reduced" && o.method != "auto" && o.method != "explicit_rk")
    refuse_solver("coordinates", "\"reduced\" goes with method = \"explicit_rk\" only; " +
                                     o.method + " takes coordinates = \"bodies\"");
}

} // namespace

void check_solver(const Scene& scene) {
  const SolverOptions& o = scene.solver;
  check_order(o);
  check_step(o);
  check_formulation(o);
  check_coordinates(o);
  check_counts(scene);
  if (o.method != "ida" && o.max_order != 5)
    refuse_solver("max_order",
                  "belongs to ida; " +
                      (o.method == "auto" ? "name the method" : o.method + " takes solver.order"));
}

} // namespace hydrodae::model
