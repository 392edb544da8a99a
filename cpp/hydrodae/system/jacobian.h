#pragma once
/// The Jacobian dF/dy + alpha dF/dy' on a pattern that is fixed when the system is built.

#include <utility>
#include <vector>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// Part of the Jacobian. `whole`: all rows. `condensed`: memory rows are rows of the identity
/// (linalg/newton_matrix.h eliminates them by JacobianParts::memory). `accelerations`: mass matrix,
/// velocity rows of constraints and their derivatives by multipliers.
enum class Part { whole, condensed, accelerations };

/// Compressed columns of the Jacobian. The assembly always visits the same entries in the same
/// order; `slots[k]` is the place of the k-th visit in the values array.
struct Pattern {
  Index n = 0;
  Part part = Part::whole;
  std::vector<Index> column_start; ///< (n + 1,)
  std::vector<Index> row;          ///< (nonzeros,) ascending in each column
  std::vector<Index> slots;
  std::vector<bool> has_rate; ///< (nonzeros,) true if dF/dy' has the entry, too
  Index nonzeros() const { return static_cast<Index>(row.size()); }
};

/// Entries (column, row) in the order in which the assembly visits them.
using Visits = std::vector<std::pair<Index, Index>>;

/// Pattern of the entries `visits`; `rates`: entries of dF/dy'.
Pattern make_pattern(Index n, const Visits& visits, const Visits& rates);

/// Runs the assembly once without values to find the pattern.
Pattern find_pattern(const Regime& system, Part part = Part::whole);

/// Coupling of a body with the memory states: their load L C z on it, its drive z' = ... + B dU.
struct MemoryPort {
  Matrix6 L;
  /// dU by the unknowns of the rotation (columns 0 to 3), and by the velocities (from column 4 on).
  Eigen::Matrix<double, 6, 10> by_unknown;
};

/// Parts dF/dy and dF/dy' of the Jacobian, kept apart so that any real or complex alpha can join
/// them.
struct JacobianParts {
  std::vector<double> by_y, by_yp; ///< (nonzeros,) dF/dy and dF/dy'
  std::vector<MemoryPort> memory;  ///< coupling of each hydrodynamic body; with Part::condensed
  /// (n_states,) weights of C z if they follow poses; with Part::condensed
  VectorX memory_weights;
  /// (n_lambda,) rates (dG/dt) u of the velocity rows; with Part::accelerations
  VectorX row_rates;
  /// Mass matrix without elements, which holds while the axes of the water are these; with
  /// Part::accelerations
  struct Mass {
    std::vector<Matrix6> axes;
    std::vector<double> values; ///< (nonzeros,); empty: none
    Index visits = 0;           ///< number of entries that the assembly visits
  } mass;
  explicit JacobianParts(const Pattern& pattern)
      : by_y(pattern.row.size()), by_yp(pattern.row.size()) {}
};

/// Scratch of the Jacobian: the kinematics of the residual and the tangent maps.
struct JacobianWorkspace {
  explicit JacobianWorkspace(const Regime& system);
  Workspace<double> state;
  std::vector<Eigen::Matrix<double, 3, 4>> rotation; ///< d phi / d p of each body
  std::vector<double> element_jacobian;              ///< Jacobians of the laws of one list
  std::vector<Matrix6> hydro_axes;                   ///< L of each hydrodynamic body
  std::vector<double> table_curvatures;              ///< curvatures of the weights of one table
};

/// Derivatives dF/dy and dF/dy' at (t, y, y'), for the part of the pattern. Part::accelerations
/// uses the rows of the stabilised formulation. Pure apart from the scratch; allocates nothing.
void jacobian(const Regime& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
              const double* y, const double* yp, JacobianParts& out);

} // namespace hydrodae::system
