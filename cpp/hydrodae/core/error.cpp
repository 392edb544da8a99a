#include "hydrodae/core/error.h"

#include <array>

#include "hydrodae/core/text.h"

namespace hydrodae {

std::string_view name_of(Reason reason) {
  constexpr std::array<std::string_view, 16> names = {
      "start",  "step",   "jacobian", "not_finite", "progress",   "drift",  "branch", "energy",
      "growth", "impact", "friction", "range",      "controller", "output", "state",  "solver"};
  return names[static_cast<std::size_t>(reason)];
}

std::string message_of(double time, const Halt& halt) {
  return "stopped at t = " + number_text(time) + " s: " + halt.what +
         (halt.advice.empty() ? "" : "; " + halt.advice) + halt.details;
}

std::string text_of(const FilePlace& place) {
  std::string text = place.file;
  for (const int number : {place.line, place.column})
    if (number > 0)
      text += ":" + std::to_string(number);
  return text;
}

CaseError::CaseError(FilePlace at, std::string key_path, const std::string& what_is_wrong)
    : Error((at.file.empty() ? "" : text_of(at) + ": ") + what_is_wrong), place(std::move(at)),
      key(std::move(key_path)), fault(what_is_wrong) {}

SolverError::SolverError(double at_time, Halt why)
    : Error(message_of(at_time, why)), time(at_time), halt(std::move(why)) {}

} // namespace hydrodae
