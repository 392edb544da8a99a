#pragma once
/// The error that a run has piled up. The estimated errors of its steps add up in size, group by
/// group of bodies, and grow or fade as the equations linearised about the motion carry an error
/// along: E <- g E + |d|, where g is the growth of a vector carried from look to look. (Skeel,
/// Math. Comput. 46 (1986) 577, carries the errors themselves; over thousands of periods they would
/// have to keep their phase.)

#include <functional>
#include <memory>

#include "hydrodae/solve/equations.h"
#include "hydrodae/solve/klu.h"

namespace hydrodae::solve {

class ErrorGrowth {
public:
  /// What there is to carry on from one layout of the rows to the next.
  struct Error {
    VectorX vector;       ///< carried along, in q, u, z (lambda0,)
    VectorX fresh;        ///< errors since the last look (lambda0,)
    VectorX piled, plain; ///< E and the sum without growth, by group (n_groups,)
  };

  /// @param error that the run has so far; empty: none
  /// @param every so many steps the error is carried along; rarer costs less
  ErrorGrowth(const system::System& system, const system::Pattern& pattern, double t, Error error,
              int every);

  /// y and y' at a time inside the last step.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

  /// Adds the error of an accepted step that ends at t. True when the error was carried along.
  /// @param unit what counts as one of each position and velocity (z0,)
  bool add(double t, const VectorX& step_error, const VectorX& unit, const Interpolant& at);

  const Error& error() const { return error_; }

private:
  bool carry(double t, VectorX& vector);
  VectorX sizes(const VectorX& vector, const VectorX& unit) const;

  const system::System& s_;
  Equations e_;
  std::unique_ptr<SparseLu<double>> lu_;
  Error error_;
  VectorX rhs_, y_, yp_;
  double since_ = 0.0; ///< time up to which the error was carried [s]
  int every_, steps_ = 0;
};

} // namespace hydrodae::solve
