#pragma once
/// Sources of events: stops and dry friction, ropes that part or slip, kinks of laws, zero
/// crossings of rates.

#include <functional>
#include <optional>
#include <span>

#include "hydrodae/core/types.h"
#include "hydrodae/events/locator.h"

namespace hydrodae::events {

/// y and y' at a time inside a step.
using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

class Source {
public:
  virtual ~Source() = default;

  /// Number of margins now; it may change from step to step.
  virtual std::size_t count() const = 0;

  /// Margins at a state inside the step, positive until their event.
  /// @param out  (count,)
  virtual void margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) = 0;

  /// The first event of the step is one of this source. @returns the time at which the step is to
  /// end [s]
  /// @param root  `which` among the margins of this source
  virtual double found(const Root& root, const Interpolant&) { return root.time; }
};

/// The first event in (t0, t1] of all sources, if any.
/// @param degree  degree of the polynomial `at`
std::optional<double> locate(std::span<Source* const> sources, double t0, double t1, int degree,
                             const Interpolant& at);

} // namespace hydrodae::events
