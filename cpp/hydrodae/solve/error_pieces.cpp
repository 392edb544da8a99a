/// The growth of the error in groups that looks can follow, as close as the motion asks.

#include <algorithm>
#include <cmath>

#include "hydrodae/solve/error_growth.h"

namespace hydrodae::solve {

namespace {

// Growth per radian of the motion that may come of the pieces' length, and the change of the
// equations from which on it is that much.
constexpr double doubtful_of_pieces = 0.3, much_changed = 0.5;
constexpr double piece_length = 0.15; // lever or rad, once growth has been seen

} // namespace

/// The end of a step, and once growth has been seen what lies inside it.
void ErrorGrowth::keep(double t, const VectorX& step_error, const VectorX& rate,
                       const VectorX& motion, const Interpolant& at) {
  constexpr double most = 24.0;
  constexpr int to_find_kinks = 16;
  const double start = n_pieces_ > 0 ? pieces_[n_pieces_ - 1].time : since_;
  double moved = 0.0;
  for (Index g = 0; g < rate.size() && fine_; ++g)
    if (is_smooth(g))
      moved = std::max(moved, motion[g] * rate[g] * (t - start));
  int n = static_cast<int>(std::clamp(std::ceil(moved / piece_length), 1.0, most));
  if (fine_ && any_kinks_)
    n = std::max(n, to_find_kinks);
  for (int i = 1; i < n; ++i)
    keep_piece(start + (t - start) * i / n, VectorX(), at);
  keep_piece(t, step_error, at);
}

void ErrorGrowth::keep_piece(double t, const VectorX& error, const Interpolant& at) {
  if (pieces_.size() <= n_pieces_)
    pieces_.emplace_back();
  Piece& out = pieces_[n_pieces_++];
  out.time = t;
  out.error = error;
  at(t, out.y, out.yp);
}

/// Have the equations of a smooth group changed much, or come back to what they were? Those without
/// kinks that float are linear in all they may do, and damped by radiation; fixed steps are short.
bool ErrorGrowth::is_doubtful(const VectorX& moved) const {
  constexpr double changed = 0.25, far = 0.5; // of them, levers or rad
  for (Index g = 0; g < s_.n_error_groups(); ++g) {
    const bool may_jump = kinks_[static_cast<std::size_t>(g)] && error_.change[g] > changed;
    const bool far_off = is_dry(g) && way_ == Way::sizes && moved[g] > far;
    if (is_smooth(g) && (change_[g] > changed || may_jump || far_off))
      return true;
  }
  return false;
}

/// How long a substep of the linear flow may be, before one was made: a third of a radian of the
/// motion at its size.
void ErrorGrowth::expect_substep(const VectorX& rate) {
  constexpr double first = 1.0 / 3.0;
  if (substep_ <= 0.0)
    substep_ = rate.size() > 0 && rate.maxCoeff() > 0.0 ? first / rate.maxCoeff() : INFINITY;
}

/// And after one that has turned the vector by this part of itself.
void ErrorGrowth::take_turn(double substep, double turned) {
  constexpr double much = 0.6, little = 0.3;
  if (turned > much)
    substep_ = 0.5 * substep;
  else if (turned < little)
    substep_ = std::max(substep_, 1.5 * std::min(substep, substep_));
}

/// Carries the vector over a piece by the mean of the equations at its ends. False where it is
/// lost.
bool ErrorGrowth::carry_piece(const Piece& piece, const VectorX& unit, VectorX& vector) {
  constexpr double most = 16.0;
  const double h = piece.time - flow_.time();
  const int substeps = static_cast<int>(std::clamp(std::ceil(h / substep_ - 1e-6), 1.0, most));
  if (!flow_.look(piece.time, piece.y, piece.yp, substeps))
    return false;
  VectorX before;
  for (int i = 0; i < substeps; ++i) {
    before = vector;
    if (!flow_.step(vector))
      return false;
  }
  const VectorX turn = sizes(vector - before, unit), size = sizes(vector, unit);
  double turned = 0.0;
  for (Index g = 0; g < size.size(); ++g)
    if (is_smooth(g) && size[g] > 0.0)
      turned = std::max(turned, turn[g] / size[g]);
  take_turn(h / substeps, turned);
  return true;
}

/// Over the same interval again for smooth groups, piece by piece, with the errors of its steps
/// from where they arise. As looks are no further apart than steps growth and fading is believed,
/// but not beside a singular pose, where it comes and goes.
/// @param vector  that of the run at the start of the interval (lambda0,)
void ErrorGrowth::look_closely(const VectorX& unit, const VectorX& rate, const VectorX& motion,
                               VectorX vector) {
  const VectorX start = vector, level = error_.level, piled = error_.piled;
  Closely now{unit,
              rate,
              motion,
              VectorX::Zero(rate.size()),
              std::move(vector),
              std::vector<bool>(smooth_.size(), false)};
  for (std::size_t i = 0; i < n_pieces_; ++i)
    if (pieces_[i].error.size() > 0)
      now.total += sizes(pieces_[i].error, unit);
  expect_substep(rate);
  flow_.go_back(last_look_);
  for (std::size_t i = 0, n = 1; i < n_pieces_; i += n) {
    for (n = 1; any_kinks_ && pieces_[i + n - 1].error.size() == 0;)
      ++n; // up to the end of the step
    follow_pieces(i, n, now);
  }
  for (Index g = 0; g < rate.size(); ++g)
    if (!is_smooth(g) || now.lost[static_cast<std::size_t>(g)]) {
      error_.level[g] = level[g];
      error_.piled[g] = piled[g];
    } else {
      error_.plain[g] += error_.added[g];
      error_.added[g] = 0.0;
    }
  for (Index i = 0; i < s_.lambda0; ++i) {
    const auto g = static_cast<std::size_t>(s_.error_group[static_cast<std::size_t>(i)]);
    if (!smooth_[g])
      continue;
    error_.vector[i] = now.lost[g] ? start[i] : now.vector[i];
    if (!now.lost[g])
      error_.fresh[i] = 0.0; // it is in the vector
  }
}

/// Over `n` pieces from the first of them by one look, or by halves of these while the change of
/// the equations alters the vector much, so that a kink is found within them, or once growth has
/// been seen and they are long.
void ErrorGrowth::follow_pieces(std::size_t first, std::size_t n, Closely& now) {
  constexpr double most_grown = 2.0;    // ln of it in a piece
  constexpr double longest = 2.0;       // lever or rad: a piece beyond tells nothing of growth
  constexpr double much_altered = 0.05; // of the vector
  const Piece& end = pieces_[first + n - 1];
  const double h = end.time - flow_.time();
  LinearFlow::Look start;
  VectorX vector_before;
  if (n > 1) {
    flow_.keep(start);
    vector_before = now.vector;
  }
  const VectorX before = sizes(now.vector, now.unit);
  const bool carried = carry_piece(end, now.unit, now.vector);
  const VectorX after = sizes(now.vector, now.unit);
  VectorX altered = VectorX::Zero(after.size());
  if (carried)
    altered = sizes(flow_.effect(now.vector), now.unit).cwiseQuotient(after.cwiseMax(1e-300));
  bool whole = carried || n == 1;
  for (Index g = 0; g < after.size() && n > 1; ++g)
    if (is_smooth(g) &&
        (altered[g] > much_altered || now.motion[g] * now.rate[g] * h > piece_length))
      whole = false;
  if (!whole) {
    flow_.go_back(start);
    now.vector = vector_before;
    follow_pieces(first, n / 2, now);
    follow_pieces(first + n / 2, n - n / 2, now);
    return;
  }
  flow_.compare(now.rate, change_, error_.change);
  VectorX own = VectorX::Zero(after.size());
  if (end.error.size() > 0) {
    own = sizes(end.error, now.unit);
    take_in(end.error, now.unit, now.vector);
  }
  for (Index g = 0; g < after.size(); ++g) {
    const double seen = before[g] > 0.0 ? std::log(after[g] / before[g]) : 0.0;
    if (!carried || !(std::abs(seen) < most_grown))
      now.lost[static_cast<std::size_t>(g)] = true;
    const double doubt = doubt_of(g, now.rate[g] * h, altered[g]);
    if (now.motion[g] * now.rate[g] * h < longest)
      grow(g, seen, doubt);
    suspect(g, seen - doubt);
    error_.piled[g] += now.total[g] > 0.0 ? error_.added[g] * own[g] / now.total[g] : 0.0;
  }
}

/// Adds the error of a step to a vector. Where forces jump, a step adds errors of the velocity
/// whose growth, as they become displacements, is not that of what has piled up: there the vector
/// keeps its direction but for a little, lest it tells the growth of the last errors only.
void ErrorGrowth::take_in(const VectorX& fresh, const VectorX& unit, VectorX& vector) const {
  constexpr double little = 0.1;
  if (!any_kinks_) {
    vector += fresh;
    return;
  }
  const VectorX own = sizes(fresh, unit), size = sizes(vector, unit);
  for (Index i = 0; i < s_.lambda0; ++i) {
    const int g = s_.error_group[static_cast<std::size_t>(i)];
    if (!kinks_[static_cast<std::size_t>(g)] || size[g] <= 0.0) {
      vector[i] += fresh[i];
    } else if (own[g] > 0.0) {
      if (size[g] < own[g]) // its direction alone tells
        vector[i] *= own[g] / size[g];
      vector[i] += little * std::min(std::max(size[g] / own[g], 1.0), 1.0 / little) * fresh[i];
    }
  }
}

/// Growth over `phase` radians of the motion that may come of the length of a piece, in which the
/// change of the equations alters the vector by this part of itself.
double ErrorGrowth::doubt_of(Index g, double phase, double altered) const {
  constexpr double of_square = 0.15; // the mean of the equations is of second order
  return std::min(doubtful_of_pieces * std::min(change_[g] / much_changed, 1.0) * phase,
                  of_square * altered * altered);
}

/// Lets what has piled up follow the vector, whose size has grown by e^seen. The level leaks to
/// zero as fast as growth may come of looks far apart.
void ErrorGrowth::grow(Index g, double seen, double doubt) {
  const double before = error_.level[g], level = before + seen,
               now = level > 0.0 ? std::max(0.0, level - doubt) : std::min(0.0, level + doubt);
  error_.piled[g] *= std::exp(now - before);
  error_.level[g] = now;
}

/// Much growth, if only over pieces that are too long to tell, asks for looks inside them.
void ErrorGrowth::suspect(Index g, double seen) {
  constexpr double much_grown = 3.0;
  if (std::isfinite(seen))
    suspected_[g] = std::max(0.0, suspected_[g] + seen);
  fine_ = fine_ || (is_smooth(g) && std::max(suspected_[g], error_.level[g]) > much_grown);
}

} // namespace hydrodae::solve
