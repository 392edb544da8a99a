#include "hydrodae/solve/consistent_start.h"

#include <Eigen/QR>
#include <Eigen/SparseLU>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::solve {

namespace {

using system::System;

constexpr double closed = 1e-6; ///< gaps above this part of their scale are refused

/// Is axis `axis` of both markers held parallel? Two rows keep the other axes of A perpendicular to
/// it, or three rows tie all axes.
bool tied(const joint::JointType& type, int axis) {
  int own = 0, all = 0;
  for (const joint::BasicRow& row : type.rows) {
    if (row.kind != joint::BasicRow::Kind::perp)
      continue;
    ++all;
    if (row.j == axis && row.i != axis)
      ++own;
  }
  return own == 2 || all == 3;
}

/// Largest entry of each row, 1 for an empty one.
VectorX row_sizes(const Eigen::SparseMatrix<double>& matrix) {
  VectorX size = VectorX::Zero(matrix.rows());
  for (Eigen::Index k = 0; k < matrix.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, k); it; ++it)
      size[it.row()] = std::max(size[it.row()], std::abs(it.value()));
  return (size.array() > 0.0).select(size, 1.0);
}

/// Throws when the row at velocity level (`lambda`) or position level (`mu`) does not hold.
void check_row(const System& s, const VectorX& r, const std::string& key, Index lambda, Index mu,
               bool angle) {
  auto refuse = [&](Index row, const char* verb, const char* unit) {
    throw ModelError(key, s.row_names[row] + " " + verb + " " + number_text(r[row]) +
                              (angle ? " rad" : " m") + unit + " at the start");
  };
  if (mu >= 0 && std::abs(r[mu]) > closed * s.row_scale[mu])
    refuse(mu, "is", "");
  if (std::abs(r[lambda]) > closed * s.row_scale[lambda])
    refuse(lambda, "is", "/s");
}

/// Joints must be closed, on the right branch, and stay closed with the velocities given.
void check_constraints(const System& s, const VectorX& y, const VectorX& r) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (const system::JointData& j : s.joints) {
    const std::string key = "joint." + j.name;
    for (const system::RowData& row : j.rows)
      if (row.kept())
        check_row(s, r, key, row.lambda, row.mu, row.kind.kind == joint::BasicRow::Kind::perp);
    // Rows of perpendicular axes also vanish when B is flipped. Axes that the joint ties stay
    // aligned: those of which no row of the type measures the angle between like axes.
    const auto g = system::joint_geometry<double>(j, ws.bodies);
    for (int axis = 0; axis < 3 && j.type->has_row(joint::BasicRow::Kind::perp); ++axis)
      if (tied(*j.type, axis) && j.A.axes.col(axis).dot(g.N * j.B.axes.col(axis)) < 0.0)
        throw ModelError(key, "joint '" + j.name + "' starts flipped by 180 degrees");
  }
  for (const system::CouplerData& c : s.couplers)
    if (c.kept())
      check_row(s, r, "constraint." + c.name, c.lambda, c.velocity_level ? -1 : c.mu,
                s.motions[c.terms.front().motion].motion.is_angle());
}

/// Solves the saddle-point system; in a singular pose, where the reactions are not unique, the
/// smallest ones. Throws SolverError when no accelerations fit.
VectorX solve_saddle_point(const Eigen::SparseMatrix<double>& matrix, const VectorX& rhs) {
  // Units differ by orders of magnitude: rows and columns are brought to size one first.
  const VectorX row = row_sizes(matrix);
  Eigen::SparseMatrix<double> scaled = row.cwiseInverse().asDiagonal() * matrix;
  const VectorX column = row_sizes(scaled.transpose());
  scaled = scaled * column.cwiseInverse().asDiagonal();
  const VectorX b = rhs.cwiseQuotient(row);
  const double allowed = 1e-8 * std::max(b.cwiseAbs().maxCoeff(), 1e-300);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(scaled);
  if (lu.info() == Eigen::Success) {
    const VectorX x = lu.solve(b);
    if (x.allFinite() && (scaled * x - b).cwiseAbs().maxCoeff() <= allowed)
      return x.cwiseQuotient(column);
  }
  Eigen::CompleteOrthogonalDecomposition<MatrixX> dense;
  dense.setThreshold(1e-10);
  dense.compute(MatrixX(scaled));
  const VectorX x = dense.solve(b);
  if (!x.allFinite() || (scaled * x - b).cwiseAbs().maxCoeff() > allowed)
    throw SolverError(0.0, "no accelerations satisfy the constraints at the start: they contradict "
                           "each other, or a body that moves has no mass");
  return x.cwiseQuotient(column);
}

} // namespace

void consistent_start(const System& s, const system::Pattern& pattern, VectorX& y, VectorX& yp) {
  y.tail(s.n - s.lambda0).setZero();
  yp = VectorX::Zero(s.n);
  system::Workspace<double> ws(s);
  VectorX r(s.n);
  system::residual<double>(s, ws, 0.0, y.data(), yp.data(), r.data());
  check_constraints(s, y, r);
  // Rows of q and z are y' = (explicit): with y' = 0 the residual is minus the rate.
  yp.head(s.n_q) = -r.head(s.n_q);
  yp.segment(s.z0, s.n_z) = -r.segment(s.z0, s.n_z);

  system::JacobianWorkspace jws(s);
  system::JacobianParts parts(pattern);
  system::jacobian(s, pattern, jws, 0.0, y.data(), yp.data(), parts);
  // Unknowns (u', lambda); rows: momentum, and d/dt of the velocity rows, h_q q' + G u' = 0.
  const Index m = s.n_u + s.n_lambda;
  auto unknown = [&](Index i) -> Index { // place of a row or column of y in the small system
    if (i >= s.u0 && i < s.z0)
      return i - s.u0;
    if (i >= s.lambda0 && i < s.mu0)
      return i - s.lambda0 + s.n_u;
    return -1;
  };
  VectorX rhs = VectorX::Zero(m);
  rhs.head(s.n_u) = -r.segment(s.u0, s.n_u);
  for (const system::CouplerData& c : s.couplers)
    if (c.kept()) // the explicit time derivative of the velocity row: -f'' or -f'
      rhs[unknown(c.lambda)] += c.drive(0.0)[c.velocity_level ? 1 : 2];
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
  const VectorX x = solve_saddle_point(matrix, rhs);
  yp.segment(s.u0, s.n_u) = x.head(s.n_u);
  y.segment(s.lambda0, s.n_lambda) = x.tail(s.n_lambda);
}

} // namespace hydrodae::solve
