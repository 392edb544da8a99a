#include "hydrodae/accuracy/energy_guard.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::accuracy {

namespace {

constexpr double usual = 1e-2; ///< part of the energy exchanged

/// Part of the potential energy m g L of a body that rounding may lose: 2e-16 in each of 5000
/// steps.
constexpr double rounded_off = 1e-12;

/// Energy exchanged, as far as a wrong step cannot have made it up: what was exchanged before it,
/// times ten, or what moves at its end [J].
double believed(const measure::Balance& before, const measure::Balance& now) {
  constexpr double more = 10.0;
  return std::min(now.exchanged, std::max(more * before.exchanged, now.kinetic));
}

/// Part of the energy exchanged that may be missing at a singular pose of a loop, where energy and
/// motion are lost together; of the motion, relative to its size, measured ten times (slider crank
/// with equal bars) to 200 times as much (two four-bar windows, ten seconds). Allowed are errors of
/// some sqrt(rtol), of some hundredths with fixed steps.
double guard_at_singular_poses(const SolverOptions& options) {
  return options.step > 0.0 ? 5e-4
                            : std::min(usual, 1e-2 * std::sqrt(std::max(options.rtol, 1e-6)));
}

} // namespace

EnergyGuard::EnergyGuard(const system::Regime& system, const SolverOptions& options)
    : s_(system), rtol_(options.rtol), part_(options.energy_guard.value_or(usual)),
      at_singular_(options.energy_guard ? part_ : guard_at_singular_poses(options)),
      guided_(system::guided_mechanisms(system)) {}

/// Where drives guide all, the energy measures the reactions, which are a derivative less exact,
/// and hardly the motion.
double EnergyGuard::allowed(int mechanism) const {
  constexpr double more = 10.0;
  const bool guided = mechanism >= 0
                          ? guided_[static_cast<std::size_t>(mechanism)]
                          : std::all_of(guided_.begin(), guided_.end(), [](bool g) { return g; });
  return guided ? more * part_ : part_;
}

/// Energy of errors within the tolerance, 100 rtol m v^2 with the speed that counts as one; of all
/// bodies, or of those of one mechanism [J].
double EnergyGuard::least(int mechanism) const {
  double out = 0.0;
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0 || (mechanism >= 0 && b.mechanism != mechanism))
      continue;
    const double speed = b.length_scale / b.time_scale * s_.motion_scale[b.group],
                 full = b.lever / b.time_scale; // its square is that of a fall over the lever
    out = std::max({out, std::min(100.0 * rtol_, 0.1) * b.mass * speed * speed,
                    rounded_off * b.mass * full * full});
  }
  return out;
}

std::string EnergyGuard::members(std::size_t mechanism) const {
  std::vector<std::string> names;
  for (const system::BodyData& b : s_.bodies)
    if (b.mechanism == static_cast<int>(mechanism) && names.size() < 4)
      names.push_back(in_quotes(b.name));
  return " of " + joined(names);
}

void EnergyGuard::fail(double t, double error, double part, double exchanged, const std::string& of,
                       const std::string& where, const std::string& advice,
                       const std::string& details) const {
  throw SolverError(t, {Reason::energy,
                        "the energy balance" + of + " is off by " + number_text(error) +
                            " J, more than " + number_text(part) + " of the " +
                            number_text(exchanged) + " J exchanged" + where +
                            " (solver.energy_guard): the motion is not to be trusted",
                        "",
                        {{"error", error}, {"allowed_part", part}, {"exchanged", exchanged}},
                        advice,
                        details});
}

void EnergyGuard::check(double t, const measure::Measure& measure,
                        const std::function<bool()>& at_singular_pose,
                        const std::function<std::string()>& reactions) const {
  if (part_ == 0.0)
    return;
  const std::vector<measure::Balance>& mechanisms = measure.mechanisms();
  const auto look = [&](int mechanism, double error, double exchanged) {
    if (std::abs(error) <= std::min(part_, at_singular_) * exchanged)
      return;
    const double missing = std::abs(error) - least(mechanism), part = allowed(mechanism);
    if (missing <= std::min(part, at_singular_) * exchanged)
      return;
    const bool singular = missing <= part * exchanged;
    if (singular && !at_singular_pose())
      return;
    fail(t, error, singular ? at_singular_ : part, exchanged,
         mechanism < 0 ? "" : members(static_cast<std::size_t>(mechanism)),
         singular ? ", at a singular pose" : "",
         std::string("a smaller tolerance or step, or another method may help") +
             (singular ? " (radau and explicit_rk pass singular poses)" : ""),
         reactions());
  };
  look(-1, measure.whole().error, believed(measure.whole_before(), measure.whole()));
  for (std::size_t m = 0; m < mechanisms.size(); ++m)
    look(static_cast<int>(m), mechanisms[m].error,
         believed(measure.mechanisms_before()[m], mechanisms[m]));
}

void EnergyGuard::finish(double t, const measure::Measure& measure) const {
  constexpr double little = 1e-2; // of what counts as too little during the run
  if (part_ == 0.0)
    return;
  const auto look = [&](int mechanism, double error, double exchanged) {
    const double part = std::max(allowed(mechanism), usual);
    if (std::abs(error) - little * least(mechanism) > part * exchanged)
      fail(t, error, part, exchanged,
           mechanism < 0 ? "" : members(static_cast<std::size_t>(mechanism)), " in the whole run",
           "a smaller tolerance or max_step may help", "");
  };
  look(-1, measure.whole().error, measure.whole().exchanged);
  for (std::size_t m = 0; m < measure.mechanisms().size(); ++m)
    look(static_cast<int>(m), measure.mechanisms()[m].error, measure.mechanisms()[m].exchanged);
}

} // namespace hydrodae::accuracy
