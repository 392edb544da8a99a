#pragma once
/// Equations of a network, for doubles and dual numbers.

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/air/network.h"

namespace hydrodae::air {

/// Remaining volume V0 - sum S s [m3].
template <class S> S Network::room_left(std::size_t chamber, const S* x) const {
  S out(parts_.chambers[chamber].volume);
  for (std::size_t k = 0; k < parts_.pistons.size(); ++k)
    if (chamber_of_[k] == static_cast<int>(chamber))
      out -= S(parts_.pistons[k].area) * x[k];
  return out;
}

/// Volume of a chamber; NaN if no air is left or a piston is at the roof.
template <class S> S Network::volume(std::size_t chamber, const S* x) const {
  const S out = room_left(chamber, x);
  bool left = out > S(0);
  for (std::size_t k = 0; k < parts_.pistons.size(); ++k)
    if (chamber_of_[k] == static_cast<int>(chamber) && parts_.pistons[k].roof)
      left = left && x[k] < S(*parts_.pistons[k].roof);
  return left ? out : S(std::numeric_limits<double>::quiet_NaN());
}

template <class S> void Network::set_pressure(std::size_t chamber, Air<S>& air) const {
  using std::exp, std::log;
  const Atmosphere& a = parts_.outside;
  air.density = air.mass / air.volume;
  air.gauge = S(a.pressure) *
              (exp(S(parts_.chambers[chamber].exponent) * log(air.density / S(a.density))) - S(1));
}

template <class S> void Network::find_air(const S* in, std::vector<Air<S>>& air) const {
  air.resize(parts_.chambers.size());
  if (still_) {
    share(in, air);
    return;
  }
  const S* mass = in + 2 * shape.width;
  for (std::size_t c = 0; c < air.size(); ++c) {
    air[c].volume = volume(c, in);
    air[c].mass = mass[c];
    set_pressure(c, air[c]);
  }
}

/// Air at rest: density of the atmosphere in open chambers, else of the air that they share.
template <class S> void Network::share(const S* x, std::vector<Air<S>>& air) const {
  for (std::size_t c = 0; c < air.size(); ++c)
    air[c].volume = volume(c, x);
  for (std::size_t c = 0; c < air.size(); ++c) {
    S mass(parts_.outside.density), room(1);
    if (rest_[c] >= 0) {
      mass = room = S(0);
      for (std::size_t other = 0; other < air.size(); ++other)
        if (rest_[other] == rest_[c]) {
          mass += S(masses_[other]);
          room += air[other].volume;
        }
    }
    air[c].mass = mass / room * air[c].volume;
    set_pressure(c, air[c]);
  }
}

template <class S> S Network::drop(const Way& way, const std::vector<Air<S>>& air) const {
  const S& from = air[static_cast<std::size_t>(way.from)].gauge;
  return way.to < 0 ? from : S(from - air[static_cast<std::size_t>(way.to)].gauge);
}

inline Held Network::held_of(const Way& way, const double* held) const {
  return {held && way.kink >= 0 ? held + side_at + way.kink : nullptr,
          held && way.signal >= 0 ? held + way.signal : nullptr};
}

/// Flow through one outlet; NaN beyond the data of a turbine.
template <class S> struct Network::Stream {
  S drop;
  Inlet<S> in;
  Held held;
  S flow; ///< flow out of its chamber [kg/s]
};

/// Speed of a turbine: a state, or the held signal; NaN for a rotor at rest.
template <class S> S Network::speed(std::size_t outlet, const S* in, const double* held) const {
  const Way& way = ways_[outlet];
  return parts_.outlets[outlet].visit([&](const auto& own) {
    if constexpr (!requires { own.eta; })
      return S(0);
    else if (way.rotor < 0 || still_) {
      const Held now = held_of(way, held);
      return S(now.signal && !own.inertia ? *now.signal : own.speed);
    } else {
      const S& w = in[2 * shape.width + way.rotor];
      return w > S(0) ? w : S(std::numeric_limits<double>::quiet_NaN());
    }
  });
}

template <class S>
Network::Stream<S> Network::stream(std::size_t outlet, const S* in, const double* held,
                                   const std::vector<Air<S>>& air) const {
  const Way& way = ways_[outlet];
  Stream<S> s{drop(way, air), {}, held_of(way, held), S(0)};
  const Atmosphere& a = parts_.outside;
  s.in = {S(a.pressure), S(a.density), speed(outlet, in, held)};
  if (const int side = s.drop > S(0) ? way.from : way.to; side >= 0) {
    s.in.pressure += air[static_cast<std::size_t>(side)].gauge;
    s.in.density = air[static_cast<std::size_t>(side)].density;
  }
  s.flow = parts_.outlets[outlet].visit([&](const auto& own) {
    if constexpr (requires { own.eta; })
      if (!own.reaches(s.drop, s.in))
        return S(std::numeric_limits<double>::quiet_NaN());
    return own.flow(s.drop, s.in, s.held);
  });
  return s;
}

template <class S> void Network::answer(const S* in, const double* held, S* out) const {
  thread_local std::vector<Air<S>> air;
  find_air(in, air);
  for (std::size_t k = 0; k < parts_.pistons.size(); ++k)
    out[k] = S(-parts_.pistons[k].area) * air[static_cast<std::size_t>(chamber_of_[k])].gauge;
  if (still_)
    return;
  S* rate = out + shape.width;
  std::fill_n(rate, shape.n_states, S(0));
  for (std::size_t k = 0; k < ways_.size(); ++k) {
    const Stream<S> s = stream(k, in, held, air);
    rate[ways_[k].from] -= s.flow;
    if (ways_[k].to >= 0)
      rate[ways_[k].to] += s.flow;
    if (ways_[k].rotor >= 0)
      parts_.outlets[k].visit([&](const auto& own) {
        if constexpr (requires { own.eta; })
          rate[ways_[k].rotor] = own.acceleration(s.drop, s.flow, s.in, s.held);
      });
  }
}

} // namespace hydrodae::air
