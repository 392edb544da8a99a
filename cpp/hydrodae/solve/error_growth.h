#pragma once
/// The error that a run has piled up. The estimated errors of its steps add up in size, group by
/// group of bodies and line by line, and grow or fade as the equations linearised about the motion
/// carry an error along: E <- g E + |d|, where g comes of the size of a vector carried from look to
/// look. Between looks swings are followed roughly: growth counts as far as it exceeds the doubtful
/// (Page's cumulative sums, Biometrika 41 (1954) 100), and what was not believed of it is taken off
/// from the next fading, lest a size that goes up and down seems to fade. (Skeel, Math. Comput. 46
/// (1986) 577, carries the errors themselves; over thousands of periods they would have to keep
/// their phase.)

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
    VectorX gathered;     ///< those of them whose size was added (lambda0,)
    VectorX added;        ///< sizes of these (n_error_groups,)
    VectorX piled, plain; ///< E and the sum without growth, by group (n_error_groups,)
    VectorX level;        ///< ln of the factor by which the oldest of E has grown (n_error_groups,)
    VectorX change;       ///< of the equations, the largest so far (n_error_groups,)
    VectorX rough_level;  ///< `level` where the equations changed much last (n_error_groups,)
    VectorX since_rough;  ///< looks since then (n_error_groups,)
    void remember(Archive& a) {
      a(vector, fresh, gathered, added, piled, plain, level, change, rough_level, since_rough);
    }
  };

  /// @param y, yp state at t, from which on these rows hold
  /// @param error that the run has so far; empty: none
  /// @param coherent the errors of steps are of one kind, as those of fixed steps:
  ///   they add up in size radian by radian of the motion; otherwise look by look
  /// @param every so many steps the error is carried along at first; where the equations change
  ///   much between two such looks, down to a quarter of that, where little, up to four times as
  ///   many
  ErrorGrowth(const system::Regime& system, const system::Pattern& pattern, double t,
              const VectorX& y, const VectorX& yp, Error error, bool coherent, int every);

  /// y and y' at a time inside the last step.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

  /// Adds the error of an accepted step that ends at t. True when the error was carried along.
  /// @param last of these rows: carries it along in any case
  /// @param unit what counts as one of each position and velocity, those of points too (lambda0,)
  /// @param rate of the motion of each group [1/s] (n_error_groups,)
  bool add(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate, bool last,
           const Interpolant& at);

  const Error& error() const { return error_; }

  /// By how much E has faded for good between these looks (n_error_groups,): 1 where nothing damps.
  const VectorX& fade() const { return fade_; }

  /// Fades E where the equations changed too much between these looks to tell.
  void fade(Index group, double factor);

  /// Largest change of stiffness and gyroscopic moments against those of the start, by group,
  /// relative to their own size (n_error_groups,): 0 where frequencies do not depend on amplitudes.
  const VectorX& change() const { return error_.change; }

  /// Do the rows that hold, those of drives among them, leave a group no motion of its own? Then
  /// errors of its steps are gone once the constraints take part.
  bool is_guided(Index group) const { return guided_[static_cast<std::size_t>(group)]; }

  void remember(Archive& a) {
    a(error_, by_y_, by_rate_, first_by_y_, first_u_, growth_, fade_, change_, since_, window_,
      every_, steps_);
  }

private:
  bool carry(double t, const VectorX& rate, VectorX& fresh);
  void linearise(double t);
  void find_change(const VectorX& rate);
  void follow(Index group, double phase);
  double between_rough(Index group, double level);
  VectorX sizes(const VectorX& vector, const VectorX& unit) const;
  VectorX place_sizes(VectorX vector, const VectorX& unit) const;

  const system::Regime& s_;
  Equations e_;
  std::unique_ptr<SparseLu<double>> lu_;
  Error error_;
  std::vector<bool> guided_;           ///< (n_error_groups,)
  std::vector<double> by_y_, by_rate_; ///< derivatives at the last look
  std::vector<double> first_by_y_;     ///< at the first
  VectorX first_u_;                    ///< velocities there (n_u,)
  VectorX rhs_, y_, yp_, growth_, fade_, change_, row_size_;
  double since_ = 0.0; ///< time up to which the error was carried [s]
  double window_;      ///< time up to which errors were added in size [s]
  bool coherent_;
  int fewest_, most_, every_, steps_ = 0;
};

} // namespace hydrodae::solve
