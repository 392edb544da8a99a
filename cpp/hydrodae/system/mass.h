#pragma once
/// The mass matrix of the momentum rows, M + D A_inf D^T (system.h).

#include "hydrodae/system/hydrodynamics.h"
#include "hydrodae/system/jacobian.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::system {

/// Mass matrix of a body: mass and moments of inertia.
inline Matrix6 rigid_mass(const BodyData& b) {
  Matrix6 out = Matrix6::Zero();
  out.topLeftCorner<3, 3>().diagonal().setConstant(b.mass);
  out.bottomRightCorner<3, 3>() = b.inertia;
  return out;
}

/// Block of a matrix (n_moving, n_moving) between two hydrodynamic bodies. Entries of coordinates
/// that do not move are zero.
inline Matrix6 hydro_block(const MatrixX& matrix, const HydroBody& i, const HydroBody& j) {
  Matrix6 block = Matrix6::Zero();
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n)
      if (i.moving[m] >= 0 && j.moving[n] >= 0)
        block(m, n) = matrix(i.moving[m], j.moving[n]);
  return block;
}

/// Values of a pose table at the pose of its body.
struct TableHere {
  water::PoseCoordinate<double> pose;
  double rate = 0.0;           ///< rate s' of the pose
  Matrix6 A, A_slope, damping; ///< A, dA/ds, B; rows and columns that do not move are zero
};

/// Matrix with zeros in the rows of coordinates that do not move.
inline Matrix6 moving_rows(const HydroBody& hb, Matrix6 matrix) {
  for (int c = 0; c < 6; ++c)
    if (hb.moving[c] < 0)
      matrix.row(c).setZero();
  return matrix;
}

inline TableHere table_here(const Regime& s, Workspace<double>& ws, const HydroBody& hb) {
  const water::PoseTable& table = s.hydro.tables[static_cast<std::size_t>(hb.table)];
  TableHere out;
  out.pose = read_pose(s, ws, table);
  out.rate = out.pose.rate(ws.bodies[hb.body]);
  const double *w = ws.weights.data() + table.first_weight,
               *slopes = ws.weight_slopes.data() + table.first_weight;
  out.A = moving_rows(hb, water::blend(table.added_mass, w));
  out.A_slope = moving_rows(hb, water::blend(table.added_mass, slopes));
  out.damping = moving_rows(hb, water::blend(table.damping, w));
  return out;
}

/// Added mass of the motion of body j on body i, along the hydrodynamic axes of both. A convolution
/// adds a part by the acceleration at the end of its last piece.
inline Matrix6 added_mass(const Regime& s, Workspace<double>& ws, const HydroBody& i,
                          const HydroBody& j) {
  Matrix6 A = hydro_block(s.hydro.added_mass, i, j);
  if (&i == &j && i.table >= 0)
    A += table_here(s, ws, i).A;
  if (!s.hydro.convolution.empty() && ws.past)
    A += hydro_block(ws.past->by_U_dot, i, j);
  return A;
}

/// Products a D^T and D a; `forces`: the force block of D is not the identity.
inline void turn_columns(const Matrix6& D, bool forces, Matrix6& a) {
  a.rightCols<3>() *= D.bottomRightCorner<3, 3>().transpose();
  if (forces)
    a.leftCols<3>() *= D.topLeftCorner<3, 3>().transpose();
}
inline void turn_rows(const Matrix6& D, bool forces, Matrix6& a) {
  a.bottomRows<3>().applyOnTheLeft(D.bottomRightCorner<3, 3>());
  if (forces)
    a.topRows<3>().applyOnTheLeft(D.topLeftCorner<3, 3>());
}

/// Mass matrix M + D A_inf D^T in the poses of the workspace, by pairs of bodies. visit(i, j,
/// block): `block` is the load on body i per acceleration [v'; w'] of body j.
template <class Visit> void mass(const Regime& s, JacobianWorkspace& ws, Visit&& visit) {
  const std::vector<HydroBody>& wet = s.hydro.bodies;
  const auto forces = [&](const HydroBody& hb) { // axes that turn forces, not only moments
    return s.hydro.axes != HydroAxes::mean || hb.turned;
  };
  std::vector<Matrix6>& D = ws.hydro_axes;
  for (std::size_t i = 0; i < wet.size(); ++i)
    D[i] = water::hydro_axes(s.hydro.axes, wet[i], ws.state.bodies[wet[i].body]);
  for (std::size_t i = 0; i < wet.size(); ++i)
    for (const int j : s.hydro.links[i].partners) {
      Matrix6 block = added_mass(s, ws.state, wet[i], wet[j]);
      turn_columns(D[j], forces(wet[j]), block);
      turn_rows(D[i], forces(wet[i]), block);
      visit(wet[i].body, wet[j].body, block);
    }
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
    visit(i, i, rigid_mass(s.bodies[i]));
}

} // namespace hydrodae::system
