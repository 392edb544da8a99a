#pragma once
/// History of the motion up to the last accepted step, for loads that depend on the past: radiation
/// by convolution, and delays. It changes on accepted steps only. Its answer depends on the
/// requested time alone, so that residual and Jacobian stay pure.
///
///   f_rad(t) = -int_0^min(t,T) K(tau) U(t - tau) dtau,   U = 0 before the start
///
/// Inside an accepted step U and each delayed s, s' are the step's own polynomial, if the method
/// has one; otherwise the cubic Hermite polynomials through both ends. From the last accepted point
/// to the trial time t, U is the cubic through U and U' at both; `longest_step` keeps its error
/// below the tolerance. Three Gauss points integrate the product with the kernel's spline, on
/// pieces of at most two steps of the kernel's grid (error below 1e-7).

#include <array>
#include <functional>
#include <vector>

#include "hydrodae/core/solver_options.h"
#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/kinks.h"

namespace hydrodae::system {

/// Past of one time.
struct Past : water::ConvolvedPast {
  double t = 0.0;
  bool known = false;                         ///< the values below are those of t
  bool locked = false;                        ///< `memory_locked` and its factors are valid, too
  std::vector<std::array<double, 2>> delayed; ///< s and s' at t - tau, for each delay
};

class History {
public:
  /// y and y' at a time inside the last step; only positions and velocities are read.
  using Inside = std::function<void(double t, VectorX& y, VectorX& yp)>;

  /// @param system  its layout must not change any more
  /// @param options  rtol, and the longest step
  explicit History(const Regime& system, const SolverOptions& options = {});

  /// Appends an accepted point, at or after the last one. A point at the same time replaces the
  /// last one: velocities or loads have jumped there.
  /// @param inside  motion since the last point, a polynomial in time
  /// @param degree  degree of that polynomial; below 3 the cubic through both ends is as good
  void append(double t, const VectorX& y, const VectorX& yp, const Inside& inside = {},
              int degree = 0);

  /// Past of time t, at or after the last accepted point but one. Completed steps contribute
  /// accepted values; the piece from there to t, factors of U(t), U'(t). `locked`: also for rows
  /// that do not move. At jumps of the past, accepted points take the values after it, other times
  /// those before it. The reference is valid until the next calls (several times are remembered).
  /// Not thread-safe.
  const Past& at(double t, bool locked = false) const;

  double last_time() const { return state_.nodes.back().t; }

  /// End of the next step at a kink of the past, for a method of this order [s].
  double next_kink(int order) const { return kinks_.next(order); }

  /// Returns whether the accelerations have jumped at the last accepted point, as the past has.
  bool jumps() const { return state_.jumps; }

  /// Longest next step for which the cubic at its trial end is exact enough [s].
  double longest_step() const { return state_.longest; }

  struct Node {
    double t = 0.0;
    /// (n_signals,) values: U, then s and s' of each delay; rates: U', then s' and s''
    VectorX value, rate;
    std::size_t points = 0; ///< number of quadrature points since the start
  };
  struct Piece { ///< polynomial in time over one step
    double from = 0.0, to = 0.0;
    MatrixX value; ///< (2 n_delays, n) at Chebyshev points
  };
  struct State {
    std::vector<Node> nodes;   ///< last accepted points
    std::vector<Piece> pieces; ///< accepted steps
    VectorX first;             ///< signals at the start
    double start = 0.0;        ///< [s]
    bool jumps = false;
    double longest = INFINITY; ///< longest next step [s]
    VectorX largest;           ///< (n_U,) largest |U| so far
    std::vector<double> point_time;
    /// Weight times U at the points, for each channel
    std::vector<std::vector<double>> point_value;
    std::size_t dropped = 0; ///< number of points forgotten since the start
    Kinks::State kinks;
    Turns turns; ///< coordinates and rates at the last accepted point
  };
  State state() const;
  void set(State state);

private:
  void forget();
  void signals(double t, const VectorX& y, const VectorX& yp, Node& node);
  MatrixX follow(const Node& from, Node& to, const VectorX& y, const VectorX& yp,
                 const Inside& inside, int degree);
  static VectorX between(const Node& from, const Node& to, double x);
  void add_points(const Node& from, const Node& to, const MatrixX& value);
  void judge(const Node& from, const Node& to, const MatrixX& value);
  void evaluate(double t, bool locked, Past& out) const;
  std::size_t node_before(double t) const;
  Eigen::Index gather_steps(double t, std::size_t node) const;
  Eigen::Index gather_piece(double t, std::size_t node, Eigen::Index rows) const;
  void sum_pairs(bool locked, Eigen::Index rows, Eigen::Index piece_rows, Past& out) const;
  void scatter(double x, double weight, double* column) const;
  std::array<double, 2> delayed(int delay, double t) const;
  bool rates_jump(const VectorX& value) const;

  const Regime& s_;
  const water::Convolution& kernels_;
  const double rtol_;
  Workspace<double> ws_;
  int n_U_ = 0;       ///< number of channels of the convolution
  double keep_ = 0.0; ///< duration of the past to keep: longest delay [s]
  Kinks kinks_;
  VectorX strength_; ///< (n_U,) ratio of kernel to added mass [1/s2]
  State state_;      ///< state without kinks and turns: `kinks_` and the workspace hold these
  VectorX y_, yp_;   ///< scratch, inside a step
  // Past of recent times, and scratch: U scattered onto the kernel's grid.
  mutable std::vector<Past> memo_;
  mutable std::size_t next_ = 0;
  mutable MatrixX grid_;       ///< (n_grid + 2, n_U)
  mutable MatrixX piece_grid_; ///< (n_grid + 2, 2) factors of U(t), U'(t)
  mutable VectorX weights_;    ///< scratch: weights of the values of a piece
};

/// Returns whether the system has loads that depend on the past.
inline bool has_past(const System& s) {
  return !s.hydro.as<water::Convolution>().empty() || !s.delays.empty();
}

/// Past of time t, or null.
inline const Past* past_at(const Regime& s, double t) {
  return s.history ? &s.history->at(t) : nullptr;
}

/// Shortens the longest step to at most each delay, and to 1 / w of the mean frequency w of the
/// kernels, over which they are smooth. Returns a description of the change, or an empty string.
/// Throws ModelError (solver.step) for a fixed step that is too long.
std::string limit_steps(const System& system, SolverOptions& options);

} // namespace hydrodae::system
