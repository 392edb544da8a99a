#include "hydrodae/solve/consistent_start.h"

#include <Eigen/SparseLU>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::solve {

namespace {

using system::System;

constexpr double closed = 1e-6; ///< gaps above this part of their scale are refused

/// Joints must be closed, on the right branch, and stay closed with the velocities given.
void check_joints(const System& s, const VectorX& y, const VectorX& r) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (const system::JointData& j : s.joints) {
    const std::string key = "joint." + j.name;
    const auto g = system::joint_geometry<double>(j, ws.bodies);
    for (const system::RowData& row : j.rows) {
      const bool length = row.kind.kind == joint::BasicRow::Kind::span;
      if (std::abs(r[row.mu]) > closed * s.row_scale[row.mu])
        throw ModelError(key, "joint '" + j.name +
                                  "' is open at the start: " + s.row_names[row.mu] + " is " +
                                  number_text(r[row.mu]) + (length ? " m" : " rad"));
      if (std::abs(r[row.lambda]) > closed * s.row_scale[row.lambda])
        throw ModelError(key, "joint '" + j.name + "' parts at the start: " + s.row_names[row.mu] +
                                  " grows by " + number_text(r[row.lambda]) +
                                  (length ? " m/s" : " rad/s"));
    }
    // Rows of perpendicular axes also vanish when B is flipped. Axes that the joint ties stay
    // aligned.
    if (j.type->needs_axis && !j.type->motions.empty()) {
      const int z = j.type->motions[0].axis;
      if (j.A.axes.col(z).dot(g.N * j.B.axes.col(z)) < 0.0)
        throw ModelError(key, "joint '" + j.name + "' starts flipped by 180 degrees");
    }
  }
}

} // namespace

void consistent_start(const System& s, const system::Pattern& pattern, VectorX& y, VectorX& yp) {
  y.tail(s.n - s.lambda0).setZero();
  yp = VectorX::Zero(s.n);
  system::Workspace<double> ws(s);
  VectorX r(s.n);
  system::residual<double>(s, ws, 0.0, y.data(), yp.data(), r.data());
  check_joints(s, y, r);
  // Rows of q and z are y' = (explicit): with y' = 0 the residual is minus the rate.
  yp.head(s.n_q) = -r.head(s.n_q);
  yp.segment(s.z0, s.n_z) = -r.segment(s.z0, s.n_z);

  system::JacobianWorkspace jws(s);
  system::JacobianParts parts(pattern);
  system::jacobian(s, pattern, jws, 0.0, y.data(), yp.data(), parts);
  // Unknowns (u', lambda); rows: momentum, and d/dt of the velocity rows, h_q q' + G u' = 0.
  const Index m = s.n_u + s.n_rows;
  auto unknown = [&](Index i) -> Index { // place of a row or column of y in the small system
    if (i >= s.u0 && i < s.z0)
      return i - s.u0;
    if (i >= s.lambda0 && i < s.mu0)
      return i - s.lambda0 + s.n_u;
    return -1;
  };
  VectorX rhs = VectorX::Zero(m);
  rhs.head(s.n_u) = -r.segment(s.u0, s.n_u);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index column = 0; column < s.n; ++column)
    for (Index k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k) {
      const Index row = unknown(pattern.row[k]);
      if (row < 0)
        continue;
      if (row >= s.n_u && column < s.n_q)
        rhs[row] -= parts.by_y[k] * yp[column];
      const Index place = unknown(column);
      if (place < 0)
        continue;
      const bool momentum_by_rate = row < s.n_u && place < s.n_u;
      entries.emplace_back(row, place, momentum_by_rate ? parts.by_yp[k] : parts.by_y[k]);
    }
  Eigen::SparseMatrix<double> matrix(m, m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
  const VectorX x = lu.info() == Eigen::Success ? VectorX(lu.solve(rhs)) : VectorX();
  const double size = rhs.cwiseAbs().maxCoeff();
  if (x.size() == 0 || !x.allFinite() ||
      (matrix * x - rhs).cwiseAbs().maxCoeff() > 1e-6 * std::max(size, 1e-300))
    throw SolverError(
        0.0, "the accelerations and reactions at the start are not unique: the constraints "
             "are redundant or a body that moves has no mass");
  yp.segment(s.u0, s.n_u) = x.head(s.n_u);
  y.segment(s.lambda0, s.n_rows) = x.tail(s.n_rows);
}

} // namespace hydrodae::solve
