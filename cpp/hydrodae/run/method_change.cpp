#include "hydrodae/run/method_change.h"

#include "hydrodae/core/text.h"

namespace hydrodae::run {

void MethodChange::remember(Archive& a) {
  a(cause, time);
  for (std::string* text : {&method, &reason}) {
    std::vector<double> letters; // of UTF-8
    for (const char c : *text)
      letters.push_back(static_cast<unsigned char>(c));
    a(letters);
    if (a.saves())
      continue;
    text->clear();
    for (const double letter : letters)
      *text += static_cast<char>(static_cast<unsigned char>(letter));
  }
}

std::string in_words(const MethodChange& change) {
  switch (change.cause) {
  case MethodChange::Cause::stop:
    return change.method + " gave up: " + change.reason;
  case MethodChange::Cause::guard:
    return "a step of " + change.method + " was refused: " + change.reason;
  case MethodChange::Cause::cost:
    break;
  }
  return change.reason;
}

std::string with_time(const MethodChange& change) {
  return change.method + " at t = " + number_text(change.time) + " s: " + change.reason;
}

} // namespace hydrodae::run
