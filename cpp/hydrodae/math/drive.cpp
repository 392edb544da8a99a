#include "hydrodae/math/drive.h"

#include "hydrodae/core/text.h"

namespace hydrodae {

std::string Drive::text() const {
  std::string out;
  const auto add = [&](double factor, const std::string& what) {
    const bool minus = factor < 0.0;
    out += out.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
    out += number_text(std::abs(factor)) + (what.empty() ? "" : " " + what);
  };
  if (constant != 0.0)
    add(constant, "");
  if (rate != 0.0)
    add(rate, "t");
  if (amplitude != 0.0) {
    std::string sine = "sin(2 pi t / " + number_text(period);
    if (phase != 0.0)
      sine += (phase < 0.0 ? " - " : " + ") + number_text(std::abs(phase) * 180.0 / pi) + " deg";
    sine += ramp > 0.0 ? ") grown over " + number_text(ramp) + " s" : ")";
    add(amplitude, sine);
  }
  if (!time.empty())
    out += std::string(out.empty() ? "" : " + ") + "a table of " + std::to_string(time.size()) +
           " points";
  if (python)
    out += std::string(out.empty() ? "" : " + ") + "a Python function";
  return out.empty() ? "0" : out;
}

} // namespace hydrodae
