#include "hydrodae/accuracy/comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hydrodae/system/motion_scale.h"

namespace hydrodae::accuracy {

namespace {

/// Part of the motion. An error above it is seen in any plot and in any statistic of single events;
/// errors that grow pass from here to the whole motion within a few time constants.
constexpr double reproducible = 0.05;

constexpr std::chrono::milliseconds patience{100}; ///< between two looks for a request to stop

} // namespace

const MoverError* Estimate::worst() const {
  const auto found =
      std::max_element(movers.begin(), movers.end(), [](const MoverError& a, const MoverError& b) {
        return a.largest < b.largest;
      });
  return known() && found != movers.end() ? &*found : nullptr;
}

Comparison::Comparison(const system::Regime& first, bool in_turn)
    : movers_(first), in_turn_(in_turn), motion_(movers_.n_groups()), apart_(movers_.size()) {}

void Comparison::moved(const VectorX& y, const std::vector<double>& turns) {
  movers_.places(y, now_);
  if (start_.size() == 0) {
    start_ = now_;
    turns0_ = turns;
  }
  for (std::size_t m = 0; m < movers_.size(); ++m)
    motion_[movers_.group(m)].widen(movers_.apart(m, start_, now_));
  movers_.widen(turns, turns0_, motion_);
}

void Comparison::first(double time, const VectorX& y, const std::function<bool()>& go_on) {
  std::unique_lock lock(mutex_);
  if (second_ended_ && second_.empty())
    return;
  first_.emplace_back(time, VectorX());
  movers_.places(y, first_.back().second);
  compare();
  const auto near = [&] { return in_turn_ || first_.size() < most_ahead || second_ended_; };
  while (!changed_.wait_for(lock, patience, near) && go_on())
    ;
}

bool Comparison::second(const VectorX& places) {
  std::unique_lock lock(mutex_);
  second_.push_back(places);
  compare();
  changed_.wait(lock, [&] {
    return in_turn_ || second_.size() < most_ahead || first_ended_ || second_passes_;
  });
  return !first_ended_ || !first_.empty();
}

void Comparison::end_first() {
  const std::lock_guard lock(mutex_);
  first_ended_ = true;
  changed_.notify_all();
}

void Comparison::end_second() {
  const std::lock_guard lock(mutex_);
  second_ended_ = true;
  changed_.notify_all();
}

bool Comparison::wait_for_second() {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [&] { return second_ended_; });
}

void Comparison::let_pass(bool second) {
  const std::lock_guard lock(mutex_);
  second_passes_ = second;
  changed_.notify_all();
}

void Comparison::remember(Archive& a) {
  const std::lock_guard lock(mutex_);
  a(first_, second_, second_ended_, start_, turns0_, motion_, span_, compared_, until_, time_,
    apart_);
}

/// All samples that are there of both.
void Comparison::compare() {
  while (!first_.empty() && !second_.empty()) {
    until_ = first_.front().first;
    const bool begins = compared_++ % span_ == 0;
    if (begins)
      time_.push_back(until_);
    for (std::size_t m = 0; m < movers_.size(); ++m) {
      const Apart apart = movers_.apart(m, first_.front().second, second_.front());
      if (begins)
        apart_[m].push_back(apart);
      else
        apart_[m].back().widen(apart);
    }
    if (compared_ == most_spans * span_)
      double_spans();
    first_.pop_front();
    second_.pop_front();
    changed_.notify_all();
  }
}

void Comparison::double_spans() {
  span_ *= 2;
  for (std::size_t k = 0; k < most_spans / 2; ++k) {
    time_[k] = time_[2 * k];
    for (std::vector<Apart>& apart : apart_) {
      apart[k] = apart[2 * k];
      apart[k].widen(apart[2 * k + 1]);
    }
  }
  time_.resize(most_spans / 2);
  for (std::vector<Apart>& apart : apart_)
    apart.resize(most_spans / 2);
}

/// What errors of a group are compared with: turns with its largest motion, displacements with
/// their own largest, but with no less than the tolerance of translations follows (MotionScale), or
/// than counts as rest.
std::vector<Apart> Comparison::measures() const {
  std::vector<Apart> out = motion_;
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
  out.time = time_;
  out.until = until_;
  const std::vector<Apart> measures = this->measures();
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    MoverError error;
    error.name = movers_.name(m);
    error.motion = motion_[movers_.group(m)].both();
    const Apart& measure = measures[movers_.group(m)];
    for (std::size_t k = 0; k < time_.size(); ++k) {
      const Apart& apart = apart_[m][k];
      const double part = std::max(apart.moved / measure.moved, apart.turned / measure.turned);
      if (part > reproducible)
        error.parted = std::min(error.parted, time_[k]);
      if (part / divisor > reproducible)
        error.reproducible_until = std::min(error.reproducible_until, time_[k]);
      // From there on errors are no longer small, and nothing is known of their ratio.
      const double by = std::isfinite(error.reproducible_until) ? 1.0 : divisor;
      error.error.push_back(apart.both() / by);
      error.part.push_back(part / by);
      if (error.part.back() > error.largest) {
        error.largest = error.part.back();
        error.when = time_[k];
      }
    }
    out.movers.push_back(std::move(error));
  }
  return out;
}

} // namespace hydrodae::accuracy
