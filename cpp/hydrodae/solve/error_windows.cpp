/// The error of a run with its signs: ErrorGrowth::Way::with_signs.

#include <algorithm>
#include <cmath>

#include "hydrodae/solve/error_growth.h"

namespace hydrodae::solve {

namespace {
constexpr double window_length = 30.0;                   // rad
constexpr double first_substep = 1.0 / 3.0;              // rad of the motion at its size
constexpr double much_turned = 0.6, little_turned = 0.3; // of the vector in a substep
// Part of the vector by which the change of the equations between two looks may alter it.
constexpr double much_altered = 0.6, little_altered = 0.2;
// Times by which looks are closer where nothing floats: radiation damps what does, but an undamped
// swing whose frequency depends on its amplitude gets ever more out of step, and slow growth is not
// to be lost in doubts.
constexpr double closer = 3.0;
constexpr double doubtful_of_altered = 0.15; // growth between looks, of the square of that
} // namespace

bool ErrorGrowth::add_with_signs(double t, const VectorX& step_error, const VectorX& unit,
                                 const VectorX& rate, const VectorX& motion, bool last,
                                 const Interpolant& at) {
  const Index most = bins_.cols();
  if (substep_ <= 0.0)
    substep_ =
        rate.size() > 0 && rate.maxCoeff() > 0.0 ? first_substep / rate.maxCoeff() : INFINITY;
  error_.fresh += step_error;
  bins_.col(bin_) += step_error;
  const bool full = t - bin_start_ >= substep_;
  if (++steps_ < every_ && !last && !(full && bin_ + 1 == most)) {
    if (full) {
      bins_.col(++bin_).setZero();
      bin_start_ = t;
    }
    return false;
  }
  steps_ = 0;
  at(t, y_, yp_);
  error_.window += rate * (t - since_);
  carry_with_signs(t, unit);
  flow_.compare(rate, change_, error_.change);
  for (int i = 0; i <= bin_; ++i)
    error_.plain += sizes(bins_.col(i), unit);
  for (VectorX* vector : {&error_.vector, &error_.middle, &error_.old})
    limit(*vector, unit, motion.cwiseMax(1.0), 1.0);
  error_.piled = error_.old_piled + sizes(error_.middle, unit) + sizes(error_.vector, unit);
  error_.fresh.setZero();
  bins_.col(0).setZero();
  bin_ = 0;
  since_ = bin_start_ = window_ = t;
  return true;
}

/// Carries the errors of all windows to a look at t; where it cannot be they stay what they were.
void ErrorGrowth::carry_with_signs(double t, const VectorX& unit) {
  const int substeps = bin_ + 1;
  const double h = (t - since_) / substeps;
  if (h <= 0.0 || !flow_.look(t, y_, yp_, substeps)) {
    for (int i = 0; i < substeps; ++i)
      error_.vector += bins_.col(i);
    return;
  }
  const VectorX old = sizes(error_.old, unit);
  const double turned = carry_window(substeps, unit);
  for (VectorX* vector : {&error_.middle, &error_.old})
    for (int i = 0; i < substeps && !vector->isZero(0.0); ++i)
      flow_.step(*vector);
  if (turned > much_turned)
    substep_ = 0.5 * h;
  else if (turned < little_turned)
    substep_ = std::min(1.5 * h, substep_ * 1.5);
  take_old(unit, old);
}

/// The window that is open, and the errors that have come since the last look.
/// @returns by what part of itself the last substep has turned it
double ErrorGrowth::carry_window(int substeps, const VectorX& unit) {
  VectorX& e = error_.vector;
  VectorX before;
  for (int i = 0; i < substeps; ++i) {
    e += bins_.col(i);
    if (i + 1 == substeps)
      before = e;
    flow_.step(e);
  }
  const VectorX size = sizes(e, unit);
  const auto part = [&](const VectorX& change, double of_dry) {
    const VectorX changed = sizes(change, unit);
    double out = 0.0;
    for (Index g = 0; g < size.size(); ++g)
      if (size[g] > 0.0)
        out = std::max(out,
                       (dry_[static_cast<std::size_t>(g)] ? of_dry : 1.0) * changed[g] / size[g]);
    return out;
  };
  const VectorX effect = flow_.effect(e);
  altered_ = substeps * part(effect, 1.0);
  look_again(substeps * part(effect, closer), much_altered, little_altered);
  return part(e - before, 1.0);
}

/// The oldest grow and fade with their sum, whose size was `before`, but for the growth that may
/// come of looks too far apart, of second order in what the change of the equations alters; windows
/// that are full are closed, group by group, as the parts of a linear sum may be.
void ErrorGrowth::take_old(const VectorX& unit, const VectorX& before) {
  constexpr double deepest = -4.0; // levels below are not come back from
  const double doubt = doubtful_of_altered * altered_ * altered_;
  const VectorX after = sizes(error_.old, unit), middle = sizes(error_.middle, unit);
  for (Index g = 0; g < before.size(); ++g) {
    if (before[g] > 0.0) {
      double& level = error_.level[g];
      const double seen = level + std::log(std::clamp(after[g] / before[g], 1e-12, 1e6)),
                   now = seen > 0.0 ? std::max(0.0, seen - doubt) : seen;
      error_.old_piled[g] *= std::exp(now - level);
      level = std::max(now, deepest);
    }
    if (error_.window[g] < window_length)
      continue;
    error_.window[g] = 0.0;
    error_.old_piled[g] += middle[g];
    for (Index i = 0; i < s_.lambda0; ++i)
      if (s_.error_group[static_cast<std::size_t>(i)] == g) {
        error_.old[i] += error_.middle[i];
        error_.middle[i] = error_.vector[i];
        error_.vector[i] = 0.0;
      }
  }
}

} // namespace hydrodae::solve
