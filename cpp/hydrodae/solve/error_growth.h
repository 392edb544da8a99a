#pragma once
/// The error that a run has piled up. The estimated errors of its steps add up in size, group by
/// group of bodies, and grow or fade as the equations linearised about the motion carry an error
/// along: E <- g E + |d|, where g comes of the size of a vector carried from look to look: its
/// envelope where it fades, and where it grows what exceeds the doubtful (Page's cumulative sums,
/// Biometrika 41 (1954) 100), since between looks swings are followed roughly. (Skeel,
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
    VectorX level;        ///< of the vector's size, over its envelope (n_groups,)
    VectorX excess;       ///< ln of the growth that is believed (n_groups,)
    VectorX change;       ///< of the equations, the largest so far (n_groups,)
  };

  /// @param y, yp state at t, from which on these rows hold
  /// @param error that the run has so far; empty: none
  /// @param every so many steps the error is carried along at first; where the equations change
  ///   much between two such looks, down to a quarter of that, where little, up to four times as
  ///   many
  ErrorGrowth(const system::System& system, const system::Pattern& pattern, double t,
              const VectorX& y, const VectorX& yp, Error error, int every);

  /// y and y' at a time inside the last step.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

  /// Adds the error of an accepted step that ends at t. True when the error was carried along.
  /// @param last of these rows: carries it along in any case
  /// @param unit what counts as one of each position and velocity (z0,)
  /// @param rate of the motion of each group [1/s] (n_groups,)
  bool add(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate, bool last,
           const Interpolant& at);

  const Error& error() const { return error_; }

  /// By how much the vector carried along has grown from the last look but one to the last, by
  /// group (n_groups,); 1 where there was none.
  const VectorX& growth() const { return growth_; }

  /// By how much its envelope has faded between these looks (n_groups,): 1 where nothing damps.
  const VectorX& fade() const { return fade_; }

  /// Largest change of the linearised equations from one look to the next so far, by group,
  /// relative to their own size (n_groups,): 0 of linear equations.
  const VectorX& change() const { return error_.change; }

private:
  bool carry(double t, VectorX& vector);
  void linearise(double t);
  void find_change();
  void follow(Index group, double phase);
  VectorX sizes(const VectorX& vector, const VectorX& unit) const;

  const system::System& s_;
  Equations e_;
  std::unique_ptr<SparseLu<double>> lu_;
  Error error_;
  std::vector<double> by_y_, by_rate_; ///< derivatives at the last look
  VectorX rhs_, y_, yp_, growth_, fade_, change_, row_size_;
  double since_ = 0.0; ///< time up to which the error was carried [s]
  int fewest_, most_, every_, steps_ = 0;
};

} // namespace hydrodae::solve
