#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {

namespace {

[[noreturn]] void refuse_solver(const std::string& key, const std::string& message) {
  throw ModelError("solver." + key, message);
}

struct Orders {
  int low, high;
  bool odd;
};

void check_order(const SolverOptions& o) {
  if (o.order == 0)
    return;
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
  if (o.method == "ida" && o.step > 0.0)
    refuse_solver("step", "ida chooses its steps by rtol; solver.max_step limits them");
  if (o.step > 0.0 && o.max_step > 0.0)
    refuse_solver("max_step", "has no meaning beside a fixed step");
  if (o.step_guard.value_or(0.0) > 0.0 && o.step == 0.0)
    refuse_solver("step_guard", "belongs to fixed steps (solver.step)");
  if (o.step > o.end_time)
    refuse_solver("step", "is longer than the run (" + number_text(o.end_time) + " s)");
}

void check_formulation(const SolverOptions& o) {
  const bool stabilised = o.formulation == "stabilised";
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

} // namespace

void check_solver(const Scene& scene) {
  const SolverOptions& o = scene.solver;
  check_order(o);
  check_step(o);
  check_formulation(o);
  if (o.method != "ida" && o.max_order != 5)
    refuse_solver("max_order", "belongs to ida; " + o.method + " takes solver.order");
}

} // namespace hydrodae::model
