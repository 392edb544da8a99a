#pragma once
/// First root of several functions of time inside a step.

#include <functional>
#include <optional>
#include <span>

#include "hydrodae/core/types.h"

namespace hydrodae::events {

/// Margins at time t [s], positive until their event; finite. They may jump.
using Margins = std::function<void(double t, std::span<double> out)>;

struct Root {
  std::size_t which = 0; ///< margin
  double before = 0.0;   ///< last time at which it was seen positive [s]
  double time = 0.0;     ///< first time at which it was seen to be no longer so [s]
};

/// The first root of `count` margins in (t0, t1].
///
/// Each margin is sampled at degree + 1 Chebyshev points. Of the polynomial through them the
/// Bernstein coefficients bound it from below: where all are positive there is no root (Farouki,
/// Computer Aided Geometric Design 29 (2012) 379); else the interval is halved until the roots are
/// apart. So no pair of roots between two samples is missed, as long as the polynomial is as exact
/// as the dense output whose margins it goes through. What it finds is confirmed on the margins
/// themselves, and a sign that changes between two samples is a root whatever the polynomial says,
/// so that margins that jump are found as well.
///
/// A margin that is not positive at t0 counts from where it becomes so; one that stays so has its
/// root at once.
std::optional<Root> first_root(const Margins& margins, std::size_t count, double t0, double t1,
                               int degree);

} // namespace hydrodae::events
