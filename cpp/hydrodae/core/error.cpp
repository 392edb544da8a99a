#include "hydrodae/core/error.h"

#include <array>

#include "hydrodae/core/text.h"

namespace hydrodae {

std::string_view name_of(Reason reason) {
  constexpr std::array<std::string_view, 17> names = {
      "start",  "step",       "jacobian", "not_finite", "progress", "drift",
      "branch", "energy",     "growth",   "impact",     "friction", "range",
      "labour", "controller", "output",   "state",      "solver"};
  return names[static_cast<std::size_t>(reason)];
}

std::string message_of(double time, const Halt& halt) {
  return "stopped at t = " + number_text(time) + " s: " + halt.what +
         (halt.advice.empty() ? "" : "; " + halt.advice) + halt.details;
}

SolverError::SolverError(double at_time, Halt why)
    : Error(message_of(at_time, why)), time(at_time), halt(std::move(why)) {}

} // namespace hydrodae
