#pragma once
/// How far a step of fixed length misses the truth, estimated from what the method has at hand.

#include "hydrodae/core/archive.h"
#include "hydrodae/solve/runge_kutta.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::solve {

/// Errors of fixed steps are summed over this many time scales of the bodies (StepGuard).
inline constexpr double summed_time_scales = 10.0;

/// Size of a small change of q, u, z (lambda0,), block by block (n_blocks,): of a body the angle,
/// or the displacement over its lever [-]; of points the largest displacement over their length; of
/// other states the largest over its scale.
VectorX block_sizes(const system::Regime& system, const VectorX& change);

/// A small change of the positions (n_q,) from one along the velocities (n_u,): quaternions change
/// by E(p) times the angle.
VectorX to_positions(const system::Regime& system, const VectorX& y, const VectorX& tangent);

/// Error of one step of a collocation method of order p, from the rates q' of its stages. In
/// Legendre polynomials on the step q' has coefficients v_k, known up to a degree d. Those of
/// A exp(i w t) fall as v_k / v_(k-1) = i w h / (2 (2 k - 1)), so that v_p, the first that the
/// quadrature misses, follows from the last two; the step's error is about h |v_p| (p - 1/2)
/// (the error constants of Radau IIA, Gauss and Lobatto IIIC, within a factor of 2). Where the
/// loads have a kink inside the step coefficients hardly fall; it shows in v_d, which changes much
/// more from the last step than usual, by about 2 (2 d + 1) v_(d+1). What turns fast but hardly
/// moves, as stiff springs do, cannot be off by more than 2 A in all.
class StageError {
public:
  explicit StageError(const RungeKutta& rk);

  /// @param h step [s]
  /// @param start y' (n,) at the start of the step; stages: Y' (n, s) at the stages
  /// @param time_scale longest of the bodies [s]; the ratio of coefficients is averaged over it
  /// @returns (n_blocks,) error as block_sizes measures it
  VectorX operator()(const system::Regime& system, double h, const VectorX& start,
                     const MatrixX& stages, double time_scale);

  /// The same as a change of q, u, z (lambda0,): the pattern of the last coefficient known, block
  /// by block.
  const VectorX& pattern() const { return pattern_; }

  /// Error of the stages inside the step, which are of order s where the method does not collocate
  /// (n_blocks,).
  const VectorX& at_stages() const { return at_stages_; }

  void remember(Archive& a) { a(before_, usual_, highest_, below_); }

private:
  VectorX find_kinks(const system::Regime& system, const VectorX& v);
  double of_turn(const system::Regime& system, const system::Block& block, const VectorX& next,
                 const MatrixX& rates, double h, VectorX& along) const;
  void take_pattern(const system::Regime& system, const VectorX& v, const VectorX& errors);

  VectorX pattern_, at_stages_;
  int order_, degree_;
  double of_stages_ = 0.0;  ///< what they miss, of h |v_d|
  bool with_start_;         ///< the start is a node of the polynomial of q'
  MatrixX last_;            ///< (2, nodes): v_(d-1) and v_d from the nodes' values
  VectorX before_, change_; ///< v_d of the last step, and how it has changed since
  VectorX usual_;           ///< fading means of the changes of v_d from step to step, by block
  VectorX highest_, below_; ///< fading sums of |v_d| and |v_(d-1)| by block
};

} // namespace hydrodae::solve
