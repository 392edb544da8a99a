#pragma once
/// What has happened up to the last accepted step, for loads that depend on the past: radiation by
/// convolution, and delays. Changes on accepted steps only; what it answers is a function of the
/// time asked for, so that residual and Jacobian stay pure.
///
///   f_rad(t) = -int_0^min(t,T) K(tau) U(t - tau) dtau,   U = 0 before the start
///
/// Inside an accepted step U and each delayed s, s' are the step's own polynomial: as exact as what
/// the method says there. Of a step that is not known inside they are the cubic Hermite polynomials
/// through both ends. From the last accepted point to the trial time t, U is the cubic through U
/// and U' at both, U(t) and U'(t) those of the trial; `longest_step` keeps what that misses below
/// the tolerance. The product with the kernel's spline is summed by three Gauss points on pieces of
/// at most two steps of the kernel's grid (error below 1e-7).

#include <array>
#include <functional>
#include <vector>

#include "hydrodae/core/solver_options.h"
#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/kinks.h"

namespace hydrodae::system {

/// The past as seen from one time.
struct Past {
  double t = 0.0;
  bool known = false;     ///< holds the values of t
  bool locked = false;    ///< those of rows that do not move, too
  VectorX memory;         ///< (n_moving,) of int K U, without what the next two give [N, N m]
  MatrixX by_U, by_U_dot; ///< (n_moving, n_moving) factors of U(t), U'(t) [N s/m, kg]
  VectorX memory_locked;  ///< (n_locked,) the same for the rows that do not move
  MatrixX locked_by_U, locked_by_U_dot;       ///< (n_locked, n_moving)
  std::vector<std::array<double, 2>> delayed; ///< of each delay: s and s' at t - tau
};

class History {
public:
  /// y and y' at a time inside the last step; of them positions and velocities are read.
  using Inside = std::function<void(double t, VectorX& y, VectorX& yp)>;

  /// Of a system whose layout does not change any more. `options`: rtol, and the longest step.
  explicit History(const Regime& system, const SolverOptions& options = {});

  /// Takes in an accepted point (t not before the last one). At the same time as the last one: the
  /// velocities have jumped there, or the loads, and the new ones hold from now on.
  /// @param inside the motion since the last point, a polynomial in time of this `degree`; below 3
  ///   the cubic through both ends is no worse
  void append(double t, const VectorX& y, const VectorX& yp, const Inside& inside = {},
              int degree = 0);

  /// The past of `t`, at or after the last accepted point but one. Steps completed before t count
  /// with what was accepted, the piece from there to t by factors of U(t), U'(t). `locked`: for the
  /// rows that do not move as well. Where the past jumps, accepted points look ahead of it and all
  /// other times back. Valid until the next calls; remembers several times (stages). Not for two
  /// threads at once.
  const Past& at(double t, bool locked = false) const;

  double last_time() const { return state_.nodes.back().t; }

  /// Where the next step is to end for a method of this order [s]: a kink of the past comes up.
  double next_kink(int order) const { return kinks_.next(order); }

  /// Have the accelerations jumped at the last accepted point, as the past has?
  bool jumps() const { return state_.jumps; }

  /// How long the next step may be for the cubic at its trial end [s].
  double longest_step() const { return state_.longest; }

  struct Node {
    double t = 0.0;
    VectorX value, rate;    ///< (n_signals,) U and U'; of each delay s and s', then s' and s''
    std::size_t points = 0; ///< quadrature points up to here, since the start
  };
  struct Piece { ///< polynomial over a step
    double from = 0.0, to = 0.0;
    MatrixX value; ///< (2 n_delays, n) at Chebyshev points
  };
  struct State {
    std::vector<Node> nodes;   ///< the last accepted points
    std::vector<Piece> pieces; ///< accepted steps
    VectorX first;             ///< signals at the start
    double start = 0.0;        ///< [s]
    bool jumps = false;
    double longest = INFINITY; ///< step [s]
    VectorX largest;           ///< (n_U,) |U| so far
    std::vector<double> point_time;
    std::vector<std::vector<double>> point_value; ///< per channel: weight times U
    std::size_t dropped = 0;                      ///< points forgotten since the start
    Kinks::State kinks;
    Turns turns; ///< at the last accepted point
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
  const double rtol_;
  Workspace<double> ws_;
  int n_U_ = 0;       ///< channels of the convolution
  double keep_ = 0.0; ///< longest delay [s]
  Kinks kinks_;
  VectorX strength_; ///< (n_U,) kernel over added mass [1/s2]
  State state_;      ///< but for the kinks and the turns, which others keep
  VectorX y_, yp_;   ///< scratch, inside a step
  // Memory of recent times, and scratch: U scattered onto the kernel's grid.
  mutable std::vector<Past> memo_;
  mutable std::size_t next_ = 0;
  mutable MatrixX grid_;       ///< (n_grid + 2, n_U)
  mutable MatrixX piece_grid_; ///< (n_grid + 2, 2) factors of U(t), U'(t)
  mutable VectorX weights_;    ///< of the values of a piece
};

/// Does anything in the system depend on its past?
inline bool has_past(const System& s) { return !s.hydro.convolution.empty() || !s.delays.empty(); }

/// The past of t, or null.
inline const Past* past_at(const Regime& s, double t) {
  return s.history ? &s.history->at(t) : nullptr;
}

/// Shortens the longest step to what the history carries: a step may not be longer than a delay,
/// nor than 1 / w of the kernels' own frequency w, within which they are smooth. Returns what it
/// did, in words, empty: nothing. Throws ModelError (solver.step) for a fixed step that is too
/// long.
std::string limit_steps(const System& system, SolverOptions& options);

} // namespace hydrodae::system
