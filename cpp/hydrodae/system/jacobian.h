#pragma once
/// The Jacobian dF/dy + alpha dF/dy' on a pattern that is fixed when the system is built.

#include <utility>
#include <vector>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// What of the Jacobian is made: all of it; all but the radiation memory, whose rows are those of
/// the identity (linalg/newton_matrix.h puts in their place what JacobianParts::memory has); or
/// what accelerations follow from: the mass matrix, the velocity rows of the constraints and their
/// derivatives by multipliers.
enum class Part { whole, condensed, accelerations };

/// Compressed columns of the Jacobian. The assembly always visits the same entries in the same
/// order; `slots[k]` is the place of the k-th visit in the values array.
struct Pattern {
  Index n = 0;
  Part part = Part::whole;
  std::vector<Index> column_start; ///< (n + 1,)
  std::vector<Index> row;          ///< (nonzeros,) ascending in each column
  std::vector<Index> slots;
  std::vector<bool> has_rate; ///< (nonzeros,) whether dF/dy' has the entry too
  Index nonzeros() const { return static_cast<Index>(row.size()); }
};

/// Entries (column, row) in the order in which the assembly visits them.
using Visits = std::vector<std::pair<Index, Index>>;

/// The pattern that has all `visits`; `rates`: those of dF/dy'.
Pattern make_pattern(Index n, const Visits& visits, const Visits& rates);

/// Runs the assembly once without values to find the pattern.
Pattern find_pattern(const Regime& system, Part part = Part::whole);

/// How a body feels the memory states, load L C z, and drives them, z' = ... + B dU.
struct MemoryPort {
  Matrix6 L;
  /// dU by the unknowns of its rotation (columns 0 to 3), and by its velocities (from column 4 on).
  Eigen::Matrix<double, 6, 10> by_unknown;
};

/// The two parts of the Jacobian, kept apart so that any real or complex alpha can join them.
struct JacobianParts {
  std::vector<double> by_y, by_yp; ///< (nonzeros,) dF/dy and dF/dy'
  std::vector<MemoryPort> memory;  ///< of each hydrodynamic body; with Part::condensed
  VectorX memory_weights; ///< (n_states,) of C z, where tables follow poses; with Part::condensed
  VectorX row_rates;      ///< (n_lambda,) (dG/dt) u; with Part::accelerations
  explicit JacobianParts(const Pattern& pattern)
      : by_y(pattern.row.size()), by_yp(pattern.row.size()) {}
};

/// Scratch of the Jacobian: the kinematics of the residual and the tangent maps.
struct JacobianWorkspace {
  explicit JacobianWorkspace(const Regime& system);
  Workspace<double> state;
  std::vector<Eigen::Matrix<double, 3, 4>> rotation; ///< d phi / d p of each body
  std::vector<double> element_jacobian;              ///< of the laws of one list
  std::vector<Matrix6> hydro_axes;                   ///< L of each hydrodynamic body
  std::vector<double> table_curvatures;              ///< of the weights of one table
};

/// dF/dy and dF/dy' at (t, y, y'), the part that the pattern is of; accelerations take the rows as
/// they are in the stabilised formulation. Pure apart from the scratch; no allocation.
void jacobian(const Regime& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
              const double* y, const double* yp, JacobianParts& out);

} // namespace hydrodae::system
