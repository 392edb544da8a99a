/// Events of a Switching: impacts, and the rows that hold afterwards.

#include <algorithm>
#include <cmath>

#include "hydrodae/events/switching.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::events {

namespace {

constexpr int rebound_halvings = 50; ///< halvings of a rebound

} // namespace

/// Returns whether an open stop is at one of its bounds.
bool Switching::touches(std::size_t k) const {
  const Data& element = s_.switches[k];
  const double s = motion(element).value, gap = touching * size_[k].length;
  return element.kind == Kind::stop && (element.upper - s <= gap || s - element.lower <= gap);
}

/// Impulses that change the velocities u, into y. Where they and friction would give energy, all
/// rebounds in `rates` are lowered alike until they do not: without rebound they never do.
linalg::SaddlePoint::Strike Switching::strike(double t, linalg::SaddlePoint& saddle,
                                              const VectorX& u, VectorX& y, VectorX& rates) {
  const auto lowered = [&](double part) {
    y.segment(s_.u0, s_.n_u) = u;
    linalg::SaddlePoint::Strike out = saddle.strike(t, y, part * rates);
    if (!out.balanced)
      fail(t, Reason::friction, std::string(linalg::SaddlePoint::no_friction_fits));
    return out;
  };
  const auto gains = [&](const linalg::SaddlePoint::Strike& x, double part) {
    return x.rubbed + 0.5 * x.impulses.dot(x.before + part * rates) > 0.0;
  };
  linalg::SaddlePoint::Strike out = lowered(1.0);
  if (out.rubbed == 0.0 || !gains(out, 1.0))
    return out;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < rebound_halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (gains(lowered(middle), middle) ? high : low) = middle;
  }
  out = lowered(low);
  rates *= low;
  return out;
}

/// Impulses at all stops that are hit at once. Leaves the stops closed that do not rebound.
/// @returns the work of all rows, where anything was hit [J]
std::optional<double> Switching::impacts(double t, VectorX& y, VectorX& yp) {
  const std::size_t count = size_.size();
  std::vector<double> after(count, 0.0); // rate that a stop is left with
  std::vector<bool> acts(count, false);
  unpack(t, y, yp);
  bool any = false;
  hit_.reset();
  const auto hit = [&](std::size_t k) {
    if (!hit_)
      hit_ = k;
    const Motion m = motion(s_.switches[k]);
    const bool upper = approach(k) == m.rate;
    const double rebound = -s_.switches[k].restitution * m.rate;
    // A rebound of a height below the tolerance, rtol times the motion, is zero: v^2 / 2 a
    // under the acceleration towards the stop. Nothing else brings a slow one back.
    const Size& size = size_[k];
    const double pressed = (upper ? m.acceleration : -m.acceleration) * size.length,
                 part = std::clamp(pressed / (size.rate * size.rate), 0.0, 1.0),
                 slow = std::max(3.0 * std::sqrt(rtol_ * part) * motion_scale(s_.switches[k]),
                                 resting) *
                        size.rate;
    after[k] = std::abs(rebound) > slow ? rebound : 0.0;
    acts[k] = true;
    put(k, upper ? Mode::upper : Mode::lower);
  };
  for (std::size_t k = 0; k < count; ++k) {
    const Data& element = s_.switches[k];
    if (element.kind == Kind::friction) {
      put(k, Mode::open); // the motion jumps: it slips, or sticks again
    } else if (s_.holds(element)) {
      acts[k] = true;
    } else if (touches(k) && approach(k) > resting * size_[k].rate) {
      hit(k);
      any = true;
    }
  }
  const VectorX u = y.segment(s_.u0, s_.n_u);
  double work = 0.0;
  for (std::size_t pass = 0; any; ++pass) {
    if (pass > 4 * count + 4)
      fail(t, Reason::impact, "no impulses fit the impact");
    lay_out(s_);
    Present present(s_);
    system::resize(s_, y);
    system::resize(s_, yp);
    y.segment(s_.u0, s_.n_u) = u;
    if (!present.saddle.accelerations(t, y, yp))
      fail(t, Reason::not_finite, "no finite accelerations at the impact");
    VectorX rates = VectorX::Zero(s_.n_lambda);
    const auto row = [&](std::size_t k) {
      return s_.lambda(s_.couplers[static_cast<std::size_t>(s_.switches[k].coupler)]) - s_.lambda0;
    };
    for (std::size_t k = 0; k < count; ++k)
      if (acts[k])
        rates[row(k)] = after[k];
    const linalg::SaddlePoint::Strike struck = strike(t, present.saddle, u, y, rates);
    unpack(t, y, yp);
    bool good = true;
    for (std::size_t k = 0; k < count && good; ++k) {
      const Data& element = s_.switches[k];
      if (acts[k]) {
        const double push =
            struck.impulses[row(k)] * (s_.mode(element) == Mode::upper ? -1.0 : 1.0);
        after[k] = rates[row(k)];
        if (push < -resting * size_[k].load * time_scale_) {
          acts[k] = good = false;
          put(k, Mode::open);
        }
      } else if (element.kind == Kind::stop && touches(k) &&
                 approach(k) > resting * size_[k].rate) {
        hit(k); // struck by what another stop did
        after[k] = 0.0;
        good = false;
      }
    }
    if (!good)
      continue;
    work = struck.rubbed + take_impact(t, struck.impulses, struck.before, rates);
    break;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (acts[k] && after[k] != 0.0)
      put(k, Mode::open);
  return any ? std::optional(work) : std::nullopt;
}

/// Sums up the impulses on the stops, and the work of all rows: an impulse acts over the mean of
/// the rates before and after, those of a drive among them.
double Switching::take_impact(double t, const VectorX& impulses, const VectorX& before,
                              const VectorX& after) {
  double work = 0.5 * impulses.dot(before + after);
  for (const system::CouplerData& c : s_.couplers)
    if (s_.holds(c))
      work += impulses[s_.lambda(c) - s_.lambda0] * s_.drive(c, t)[c.velocity_level ? 0 : 1];
  for (std::size_t k = 0; k < size_.size(); ++k) {
    const system::CouplerData& c = s_.couplers[static_cast<std::size_t>(s_.switches[k].coupler)];
    if (!s_.holds(c) || s_.switches[k].kind != Kind::stop)
      continue;
    const Index row = s_.lambda(c) - s_.lambda0;
    if (impulses[row] == 0.0)
      continue;
    const Impact impact{t, std::abs(impulses[row]),
                        -0.5 * impulses[row] * (before[row] + after[row])};
    state_.struck[k].impulse += impact.impulse;
    state_.struck[k].energy_lost += impact.energy_lost;
    state_.struck[k].impacts.push_back(impact);
  }
  return work;
}

/// The state that contradicts its own load or acceleration most is changed; false when none does.
bool Switching::correct(const VectorX& y, std::vector<int>& changes) {
  double worst = 0.0;
  std::size_t which = 0;
  Mode next = Mode::open;
  for (std::size_t k = 0; k < size_.size(); ++k) {
    const Data& element = s_.switches[k];
    const Size& size = size_[k];
    double wrong = 0.0;
    Mode wanted = Mode::open;
    if (s_.mode(element) == Mode::upper || s_.mode(element) == Mode::lower) {
      const double f = load(element, y);
      wrong = (s_.mode(element) == Mode::upper ? f : -f) / size.load;
    } else if (s_.mode(element) == Mode::stick) {
      const double f = load(element, y);
      wrong = (std::abs(f) - system::sticking_load(s_, element, y.data())) / size.load;
      wanted = f > 0.0 ? Mode::backward : Mode::forward;
    } else if (element.kind == Kind::stop && touches(k)) {
      const Motion m = motion(element);
      const bool upper = element.upper - m.value < m.value - element.lower;
      const double outward = upper ? m.acceleration : -m.acceleration;
      if (std::abs(m.rate) <= resting * size.rate)
        wrong = outward * time_scale_ / size.rate;
      wanted = upper ? Mode::upper : Mode::lower;
    }
    if (wrong > resting && wrong > worst && changes[k] < 4) {
      worst = wrong;
      which = k;
      next = wanted;
    }
  }
  if (worst == 0.0)
    return false;
  ++changes[which];
  put(which, next);
  return true;
}

std::optional<double> Switching::settle(double t, VectorX& y, VectorX& yp) {
  const Stabilised lock(s_);
  present_.reset();
  count(t);
  unpack(t, y, yp);
  const std::optional<double> struck = impacts(t, y, yp);
  for (std::size_t k = 0; k < size_.size(); ++k) {
    const Data& element = s_.switches[k];
    if (element.kind != Kind::friction)
      continue;
    const double rate = motion(element).rate;
    const bool rests = std::abs(rate) <= 10.0 * resting * size_[k].rate;
    put(k, rests ? Mode::stick : rate > 0.0 ? Mode::forward : Mode::backward);
  }
  std::vector<int> changes(size_.size(), 0);
  for (std::size_t pass = 0;; ++pass) {
    if (pass > 8 * size_.size() + 8)
      fail(t, Reason::impact, "no set of stops and sticking joints agrees with its loads");
    lay_out(s_);
    present_ = std::make_unique<Present>(s_);
    system::resize(s_, y);
    system::resize(s_, yp);
    linalg::SaddlePoint& saddle = present_->saddle;
    const bool good =
        saddle.accelerations(t, y, yp) && saddle.project(t, y) && saddle.accelerations(t, y, yp);
    if (!saddle.jam().empty())
      fail(t, Reason::friction, saddle.jam());
    if (!good)
      fail(t, Reason::impact,
           struck ? "no motion goes on from the impact" : "the constraints contradict a stop");
    unpack(t, y, yp);
    if (!correct(y, changes))
      break;
  }
  // the projection may have increased the penetration
  for (std::size_t k = 0; k < size_.size(); ++k)
    state_.depth[k] = s_.switches[k].kind == Kind::stop && s_.mode(s_.switches[k]) == Mode::open
                          ? std::max(0.0, -gap(k))
                          : 0.0;
  state_.holding = std::any_of(s_.switches.begin(), s_.switches.end(),
                               [this](const Data& element) { return s_.holds(element); });
  return struck;
}

} // namespace hydrodae::events
