/// The error of a run with its signs: ErrorGrowth::Way::with_signs.

#include <algorithm>
#include <cmath>

#include "hydrodae/solve/error_growth.h"

namespace hydrodae::solve {

namespace {
constexpr double window_length = 30.0; // rad
constexpr int most_substeps = 32;      // of a look
// Part of the vector by which the change of the equations between two looks may alter it.
constexpr double much_altered = 0.6, little_altered = 0.2;
// Times by which looks are closer where nothing floats, and where the equations of what floats
// change: radiation damps that, but an undamped swing whose frequency depends on its amplitude gets
// ever more out of step, and slow growth is not to be lost in doubts.
constexpr double closer = 3.0, close = 2.0, changing = 0.25;
constexpr double doubtful_of_altered = 0.15; // growth between looks, of the square of that
constexpr double kink = 0.8;                 // part altered from which on it is looked for
} // namespace

bool ErrorGrowth::add_with_signs(double t, const VectorX& step_error, const VectorX& unit,
                                 const VectorX& rate, const VectorX& motion, bool last,
                                 const Interpolant& at) {
  expect_substep(rate);
  error_.fresh += step_error;
  keep_piece(t, step_error, at);
  if (++steps_ < every_ && !last && t - since_ < most_substeps * substep_)
    return false;
  steps_ = 0;
  at(t, y_, yp_);
  error_.window += rate * (t - since_);
  add_plain(unit);
  carry_with_signs(unit);
  flow_.compare(rate, change_, error_.change);
  for (VectorX* vector : {&error_.vector, &error_.middle, &error_.old})
    limit(*vector, unit, motion.cwiseMax(1.0), 1.0);
  error_.piled = error_.old_piled + sizes(error_.middle, unit) + sizes(error_.vector, unit);
  error_.fresh.setZero();
  since_ = window_ = t;
  n_pieces_ = 0;
  return true;
}

/// Sizes of the errors since the last look, substep by substep: those of single steps cancel.
void ErrorGrowth::add_plain(const VectorX& unit) {
  VectorX sum = VectorX::Zero(s_.lambda0);
  double start = since_;
  for (std::size_t i = 0; i < n_pieces_; ++i) {
    sum += pieces_[i].error;
    if (i + 1 < n_pieces_ && pieces_[i].time - start < substep_)
      continue;
    error_.plain += sizes(sum, unit);
    sum.setZero();
    start = pieces_[i].time;
  }
}

/// Carries the errors of all windows to the last of the steps kept.
void ErrorGrowth::carry_with_signs(const VectorX& unit) {
  const VectorX old = sizes(error_.old, unit);
  doubt_ = 0.0;
  look_again(carry_pieces(0, n_pieces_, unit), much_altered, little_altered);
  take_old(unit, old);
}

/// Carries them over `n` steps from the first of them by one look, or by halves of these where the
/// equations change so much that their mean tells little; where they cannot be carried over a
/// single step they stay what they were.
/// @returns part of the errors that the change of the equations over all of them alters
double ErrorGrowth::carry_pieces(std::size_t first, std::size_t n, const VectorX& unit) {
  const Piece& end = pieces_[first + n - 1];
  const double h = end.time - flow_.time();
  const int substeps =
      static_cast<int>(std::clamp(std::ceil(h / substep_ - 1e-6), 1.0, double{most_substeps}));
  LinearFlow::Look start;
  flow_.keep(start);
  const VectorX before = error_.vector;
  const double doubt = doubt_;
  double altered = INFINITY;
  if (h > 0.0 && flow_.look(end.time, end.y, end.yp, substeps)) {
    altered = carry_window(first, n, end.time - h, h / substeps, unit);
    if (plainly_altered_ <= kink || n == 1) {
      for (VectorX* vector : {&error_.middle, &error_.old})
        for (int i = 0; i < substeps && !vector->isZero(0.0); ++i)
          flow_.step(*vector);
      return altered;
    }
  }
  flow_.go_back(start);
  error_.vector = before;
  doubt_ = doubt;
  if (n > 1) {
    carry_pieces(first, n / 2, unit);
    carry_pieces(first + n / 2, n - n / 2, unit);
  } else {
    error_.vector += end.error;
  }
  return altered;
}

/// The window that is open, and the errors of these steps, each from the substep in which it comes.
/// @returns by what part of itself the change of the equations alters it
double ErrorGrowth::carry_window(std::size_t first, std::size_t n, double start, double h,
                                 const VectorX& unit) {
  VectorX& e = error_.vector;
  VectorX before;
  const int substeps = static_cast<int>(std::lround((flow_.time() - start) / h));
  std::size_t next = first;
  for (int i = 0; i < substeps; ++i) {
    const double end = start + (i + 1) * h;
    for (; next < first + n && (i + 1 == substeps || pieces_[next].time <= end); ++next)
      e += pieces_[next].error;
    before = e;
    flow_.step(e);
  }
  const VectorX size = sizes(e, unit);
  const auto part = [&](const VectorX& change, double of_dry, double of_changing) {
    const VectorX changed = sizes(change, unit);
    double out = 0.0;
    for (Index g = 0; g < size.size(); ++g)
      if (size[g] > 0.0)
        out = std::max(out, (is_dry(g)                     ? of_dry
                             : error_.change[g] > changing ? of_changing
                                                           : 1.0) *
                                changed[g] / size[g]);
    return out;
  };
  take_turn(h, part(e - before, 1.0, 1.0));
  const VectorX effect = flow_.effect(e);
  plainly_altered_ = substeps * part(effect, 1.0, 1.0);
  doubt_ += doubtful_of_altered * plainly_altered_ * plainly_altered_;
  return substeps * part(effect, closer, close);
}

/// The oldest grow and fade with their sum, whose size was `before`, but for the growth that may
/// come of looks too far apart, of second order in what the change of the equations alters; windows
/// that are full are closed, group by group, as the parts of a linear sum may be.
void ErrorGrowth::take_old(const VectorX& unit, const VectorX& before) {
  constexpr double deepest = -4.0; // levels below are not come back from
  const VectorX after = sizes(error_.old, unit), middle = sizes(error_.middle, unit);
  for (Index g = 0; g < before.size(); ++g) {
    if (before[g] > 0.0) {
      double& level = error_.level[g];
      const double seen = level + std::log(std::clamp(after[g] / before[g], 1e-12, 1e6)),
                   now = seen > 0.0 ? std::max(0.0, seen - doubt_) : seen;
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
