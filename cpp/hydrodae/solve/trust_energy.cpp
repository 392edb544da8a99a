#include <algorithm>
#include <cmath>

#include "hydrodae/solve/trust.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::solve {

namespace {

/// d ln(frequency) / d ln(speed) by the change of the equations: 0 of a linear oscillator; of a
/// pendulum that swings by 0.5, 1 and 2.5 rad 0.03, 0.13 and 3.3, where these change by 0.2, 0.7
/// and 2; 1 of what turns round and round.
double out_of_step(double change) { return std::max(0.25 * change, 0.8 * change * change); }

} // namespace

/// Where dampers and the like work the balance has the errors of their sums of work in it, and
/// errors that keep their signs tell more. What is conservative keeps its energy longer than these
/// keep their phase: springs, which give back what they take, spend nothing after the first swings.
bool Trust::tells_less(const Energy& e) const {
  constexpr double little = 1e-2; // of 4 K, in the swings remembered
  return way_ == ErrorGrowth::Way::with_signs && e.spent > 4.0 * little * e.kinetic;
}

/// How much of what is missing a mechanism remembers until the next look. Conservative ones forget
/// nothing; dampers take errors with the energy 4 K w of a swing that they take, as an error that
/// is carried along tells, too, if only where it turns little from look to look. What drives guide
/// altogether carries none.
double Trust::remembered(Energy& e, double phase, const system::Recorder::Balance& now) {
  constexpr double held = 10.0, held_of_spent = 20.0; // radians of the motion
  const double weight = std::exp(-phase / held);
  e.kinetic = e.kinetic > 0.0 ? weight * e.kinetic + (1.0 - weight) * now.now : now.now;
  const double taken = now.given - e.given;
  e.given = now.given;
  e.spent = std::exp(-phase / held_of_spent) * e.spent + taken;
  if (e.guided || tells_less(e))
    return 0.0;
  const double damped = taken > 0.0 ? std::exp(-taken / std::max(4.0 * e.kinetic, 1e-300)) : 1.0;
  damped_[e.group] = std::max(damped_[e.group], damped);
  return growth_->is_rough(e.group) ? damped : std::max(growth_->fade()[e.group], damped);
}

/// Kinetic energy of a body that moves as its tolerance expects: less tells nothing.
double Trust::least(int mechanism) const {
  double out = 0.0;
  for (const system::BodyData& b : s_.bodies) {
    if (b.group < 0 || b.mechanism != mechanism)
      continue;
    const double speed = b.length_scale / b.time_scale * s_.motion_scale[b.group];
    out = std::max(out, 0.5 * b.mass * speed * speed);
  }
  return out;
}

/// From dE / 2 K of the speed follows the same part of the size of the motion, and of its
/// frequency.
void Trust::take_energy(double t, const system::Recorder& recorder) {
  constexpr double little = 1e-2; // kinetic energy, of all that was exchanged
  damped_.setZero(s_.n_groups);
  for (std::size_t m = 0; m < energies_.size() && s_.n_groups > 0; ++m) {
    Energy& e = energies_[m];
    const system::Recorder::Balance b =
        recorder.mechanisms().empty() ? recorder.whole() : recorder.mechanisms()[m];
    const double kinetic = std::max({b.kinetic, little * b.exchanged, least(static_cast<int>(m))}),
                 whole = size(e.group), phase = fastest_[e.group] / whole * (t - looked_),
                 kept = remembered(e, phase, b);
    e.missing = kept * e.missing + b.error - e.seen;
    e.seen = b.error;
    if (e.guided || tells_less(e))
      e.late = 0.0;
    if (e.guided || tells_less(e) || !(kinetic > 0.0))
      continue;
    const double part = std::abs(e.missing) / (2.0 * kinetic);
    const double change = growth_->change()[e.group];
    e.late = kept * e.late +
             (e.struck ? std::max(1.0, out_of_step(change)) : out_of_step(change)) * phase * part;
    missing_[e.group] = std::max(missing_[e.group], (part + e.late) * whole);
  }
  for (Index g = 0; g < s_.n_groups; ++g) // by the mechanism of the group that is damped least
    if (damped_[g] > 0.0)
      growth_->fade(g, damped_[g]);
}

void Trust::find_guided() {
  const std::vector<bool> guided = system::guided_mechanisms(s_);
  for (std::size_t m = 0; m < energies_.size(); ++m)
    energies_[m].guided = guided[m];
}

} // namespace hydrodae::solve
