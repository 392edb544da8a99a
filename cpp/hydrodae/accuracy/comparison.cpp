#include "hydrodae/accuracy/comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hydrodae/system/motion_scale.h"

namespace hydrodae::accuracy {

namespace {

/// Error as part of the motion above which it is visible in plots and in statistics of single
/// events. Growing errors pass from here to the whole motion within a few time constants.
constexpr double reproducible = 0.05;

constexpr std::chrono::milliseconds patience{100}; ///< time between two checks of a request to stop

} // namespace

const MoverError* Estimate::worst() const {
  const auto found =
      std::max_element(movers.begin(), movers.end(), [](const MoverError& a, const MoverError& b) {
        return a.largest < b.largest;
      });
  return known() && found != movers.end() ? &*found : nullptr;
}

Comparison::Comparison(const system::Regime& first, bool in_turn)
    : movers_(first), in_turn_(in_turn) {
  state_.motion.resize(movers_.n_groups());
  state_.apart.resize(movers_.size());
}

void Comparison::moved(const VectorX& y, const std::vector<double>& turns) {
  movers_.places(y, now_);
  if (state_.start.size() == 0) {
    state_.start = now_;
    state_.turns0 = turns;
  }
  for (std::size_t m = 0; m < movers_.size(); ++m)
    state_.motion[movers_.group(m)].widen(movers_.apart(m, state_.start, now_));
  movers_.widen(turns, state_.turns0, state_.motion);
}

void Comparison::first(double time, const VectorX& y, const std::function<bool()>& go_on) {
  std::unique_lock lock(mutex_);
  if (state_.second_ended && state_.second.empty())
    return;
  state_.first.emplace_back(time, VectorX());
  movers_.places(y, state_.first.back().second);
  compare();
  const auto near = [&] {
    return in_turn_ || state_.first.size() < most_ahead || state_.second_ended;
  };
  while (!changed_.wait_for(lock, patience, near) && go_on())
    ;
}

bool Comparison::second(const VectorX& places) {
  std::unique_lock lock(mutex_);
  state_.second.push_back(places);
  compare();
  changed_.wait(lock, [&] {
    return in_turn_ || state_.second.size() < most_ahead || first_ended_ || second_passes_;
  });
  return !first_ended_ || !state_.first.empty();
}

void Comparison::end_first() {
  const std::lock_guard lock(mutex_);
  first_ended_ = true;
  changed_.notify_all();
}

void Comparison::end_second() {
  const std::lock_guard lock(mutex_);
  state_.second_ended = true;
  changed_.notify_all();
}

bool Comparison::wait_for_second() {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [&] { return state_.second_ended; });
}

void Comparison::let_pass(bool second) {
  const std::lock_guard lock(mutex_);
  second_passes_ = second;
  changed_.notify_all();
}

Comparison::State Comparison::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void Comparison::set(State state) {
  const std::lock_guard lock(mutex_);
  state_ = std::move(state);
}

/// Compares all samples that both runs have given.
void Comparison::compare() {
  while (!state_.first.empty() && !state_.second.empty()) {
    state_.until = state_.first.front().first;
    const bool begins = state_.compared++ % state_.span == 0;
    if (begins)
      state_.time.push_back(state_.until);
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      const Apart apart = movers_.apart(m, state_.first.front().second, state_.second.front());
      if (begins)
        state_.apart[m].push_back(apart);
      else
        state_.apart[m].back().widen(apart);
    }
    if (state_.compared == most_spans * state_.span)
      double_spans();
    state_.first.pop_front();
    state_.second.pop_front();
    changed_.notify_all();
  }
}

void Comparison::double_spans() {
  state_.span *= 2;
  for (std::size_t k = 0; k < most_spans / 2; ++k) {
    state_.time[k] = state_.time[2 * k];
    for (std::vector<Apart>& apart : state_.apart) {
      apart[k] = apart[2 * k];
      apart[k].widen(apart[2 * k + 1]);
    }
  }
  state_.time.resize(most_spans / 2);
  for (std::vector<Apart>& apart : state_.apart)
    apart.resize(most_spans / 2);
}

/// Sizes that errors of a group are compared with: for rotations its largest motion; for
/// displacements their own largest, but at least the one that the tolerance follows (MotionScale),
/// or that counts as rest.
std::vector<Apart> Comparison::measures() const {
  std::vector<Apart> out = state_.motion;
  std::vector<double> rest(out.size(), 1e-300);
  for (std::size_t m = 0; m < movers_.size(); ++m)
    rest[movers_.group(m)] =
        std::max(rest[movers_.group(m)], system::rest_motion * movers_.lever(m));
  for (std::size_t g = 0; g < out.size(); ++g)
    out[g] = {std::max({out[g].moved, system::least_translation * out[g].both(), rest[g]}),
              std::max(out[g].both(), rest[g])};
  return out;
}

Estimate Comparison::estimate(double divisor) const {
  const std::lock_guard lock(mutex_);
  Estimate out;
  out.time = state_.time;
  out.until = state_.until;
  const std::vector<Apart> measures = this->measures();
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    MoverError error;
    error.name = movers_.name(m);
    error.motion = state_.motion[movers_.group(m)].both();
    const Apart& measure = measures[movers_.group(m)];
    for (std::size_t k = 0; k < state_.time.size(); ++k) {
      const Apart& apart = state_.apart[m][k];
      const double part = std::max(apart.moved / measure.moved, apart.turned / measure.turned);
      if (part > reproducible)
        error.parted = std::min(error.parted, state_.time[k]);
      if (part / divisor > reproducible)
        error.reproducible_until = std::min(error.reproducible_until, state_.time[k]);
      // From there on errors are not small, and their ratio is unknown.
      const double by = std::isfinite(error.reproducible_until) ? 1.0 : divisor;
      error.error.push_back(apart.both() / by);
      error.part.push_back(part / by);
      if (error.part.back() > error.largest) {
        error.largest = error.part.back();
        error.when = state_.time[k];
      }
    }
    out.movers.push_back(std::move(error));
  }
  return out;
}

} // namespace hydrodae::accuracy
