#pragma once
/// Inner table `crest` of a wave system: a crest of given height at a given time and place.

#include <optional>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/sea/component.h"

namespace hydrodae::sea {

/// Crest of the wave system: height A [m] at time t0 [s] and place x0 [m].
struct Crest {
  static constexpr std::string_view doc =
      "A crest of given height at a given time and place: of an irregular wave NewWave in a random "
      "sea (Taylor, Jonathan and Harland 1997).";
  double height = 0.0, time = 0.0;
  std::vector<double> place;

  bool given() const { return height > 0.0; }
  double x() const { return place.empty() ? 0.0 : place[0]; }
  double y() const { return place.empty() ? 0.0 : place[1]; }

  template <class W = Crest> static Fields<W> fields() {
    return {
        {"height", &W::height, "m", "Elevation of the wave system at the crest.", true,
         more_than(0, 1e6)},
        {"time", &W::time, "s", "Time of the crest.", false, at_least(0, longest_time)},
        {"place", &W::place, "m", "Where it is, [x, y]; the origin by default."},
    };
  }
};

/// Fault of the key `crest.place`: neither missing nor two numbers.
std::optional<Fault> crest_fault(const Crest& crest);

/// Gives the sum of the components a crest of height A with horizontal slope over time at t0, x0
/// (Taylor, Jonathan and Harland, J. Offshore Mech. Arct. Eng. 119 (1997) 20, equation 6):
///
///   eta = eta_r + rho (A - eta_r(0)) + rho' / lambda^2 eta_r'(0),   lambda^2 = m2 / m0
///   rho(t) = sum E_n cos(w_n t) / m0,   m_j = sum w_n^j E_n,   E_n = a_n^2 / 2
///
/// with t from the crest. Each component only changes its amplitude and phase: with the complex
/// amplitude c_n at the crest it becomes c_n + E_n ((A - eta_r(0)) / m0 + i w_n eta_r'(0) / m2).
void constrain(std::vector<Component>& components, const Crest& crest);

} // namespace hydrodae::sea
