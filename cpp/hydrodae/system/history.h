#pragma once
/// What has happened up to the last accepted step, for loads that depend on the past: radiation by
/// convolution, and delays. Changes on accepted steps only; what it answers is a function of the
/// time asked for, so that residual and Jacobian stay pure.
///
///   f_rad(t) = -int_0^min(t,T) K(tau) U(t - tau) dtau,   U = 0 before the start
///
/// Between accepted steps U is the cubic Hermite polynomial through U and U' at both ends (error
/// (w h)^4 / 384), also from the last of them to the trial time t, where U(t) and U'(t) are those
/// of the trial. The product with the kernel's spline is summed by three Gauss points on pieces of
/// at most two steps of the kernel's grid (error below 1e-7). Delayed motions are cubic as well: s
/// through s, s', and s' through s', s''.

#include <array>
#include <vector>

#include "hydrodae/model/solver_options.h"
#include "hydrodae/system/kinematics.h"

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
  /// Of a system whose layout does not change any more.
  explicit History(const Regime& system);

  /// Takes in an accepted point (t not before the last one). At the same time as the last one: the
  /// velocities have jumped there, and the new ones hold from now on.
  void append(double t, const VectorX& y, const VectorX& yp);

  /// The past of `t`, at or after the last accepted point but one. Steps completed before t count
  /// with what was accepted, the piece from there to t by factors of U(t), U'(t). `locked`: for the
  /// rows that do not move as well. Valid until the next calls; remembers several times (stages).
  /// Not for two threads at once.
  const Past& at(double t, bool locked = false) const;

  double last_time() const { return nodes_.back().t; }

  void remember(Archive& a);

private:
  struct Node {
    double t = 0.0;
    VectorX value, rate;    ///< (n_signals,) U and U'; of each delay s and s', then s' and s''
    std::size_t points = 0; ///< quadrature points up to here, since the start
    void remember(Archive& a) { a(t, value, rate, points); }
  };
  void forget();
  void signals(double t, const VectorX& y, const VectorX& yp, Node& node);
  void add_points(const Node& from, const Node& to);
  void evaluate(double t, bool locked, Past& out) const;
  std::size_t node_before(double t) const;
  Eigen::Index gather_steps(double t, std::size_t node) const;
  Eigen::Index gather_piece(double t, std::size_t node, Eigen::Index rows) const;
  void sum_pairs(bool locked, Eigen::Index rows, Eigen::Index piece_rows, Past& out) const;
  void scatter(double x, double weight, double* column) const;
  std::array<double, 2> delayed(int delay, double t) const;

  const Regime& s_;
  Workspace<double> ws_;
  int n_U_ = 0;             ///< channels of the convolution
  double keep_ = 0.0;       ///< longest delay [s]
  std::vector<Node> nodes_; ///< accepted points
  VectorX first_;           ///< signals at the start
  double start_ = 0.0;      ///< [s]
  std::vector<double> point_time_;
  std::vector<std::vector<double>> point_value_; ///< per channel: weight times U
  std::size_t dropped_ = 0;                      ///< points forgotten since the start
  // Memory of recent times, and scratch: U scattered onto the kernel's grid.
  mutable std::vector<Past> memo_;
  mutable std::size_t next_ = 0;
  mutable MatrixX grid_;       ///< (n_grid + 2, n_U)
  mutable MatrixX piece_grid_; ///< (n_grid + 2, 2) factors of U(t), U'(t)
};

/// Does anything in the system depend on its past?
inline bool has_past(const System& s) { return !s.hydro.convolution.empty() || !s.delays.empty(); }

/// The past of t, or null.
inline const Past* past_at(const Regime& s, double t) {
  return s.history ? &s.history->at(t) : nullptr;
}

/// Shortens the longest step to what the history carries: a step may not be longer than a delay,
/// and the interpolation of the velocities at the kernels' own frequency w has to meet the
/// tolerance, (w h)^4 / 384 <= rtol (and w h <= 1). Returns what it did, in words, empty: nothing.
/// Throws ModelError (solver.step) for a fixed step that is too long.
std::string limit_steps(const System& system, model::SolverOptions& options);

} // namespace hydrodae::system
