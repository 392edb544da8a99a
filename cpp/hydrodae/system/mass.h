#pragma once
/// The mass matrix of the momentum rows, M + D A D^T (system.h).

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

/// Mass plus added mass along one coordinate of a body [kg or kg m2]; zero if it does not move in
/// the water.
inline double wet_mass(const System& s, int body, int c) {
  for (const HydroBody& hb : s.hydro.bodies)
    if (const int u = hb.moving[static_cast<std::size_t>(c)]; hb.body == body && u >= 0)
      return s.hydro.added_mass.own(s.hydro, u) +
             rigid_mass(s.bodies[static_cast<std::size_t>(body)])(c, c);
  return 0.0;
}

/// Values of a pose table at the pose of its body.
struct TableHere {
  water::PoseCoordinate<double> pose;
  double rate = 0.0;  ///< rate s' of the pose
  Matrix6 A, A_slope; ///< A, dA/ds; rows and columns that do not move are zero
};

inline TableHere table_here(const Regime& s, Workspace<double>& ws, const HydroBody& hb) {
  const water::PoseTable& table = s.hydro.added_mass.tables[static_cast<std::size_t>(hb.table)];
  TableHere out;
  out.pose = read_pose(s, ws, table);
  out.rate = out.pose.rate(ws.bodies[hb.body]);
  const double *w = ws.weights.data() + table.first_weight,
               *slopes = ws.weight_slopes.data() + table.first_weight;
  out.A = water::moving_rows(hb, water::blend(table.added_mass, w));
  out.A_slope = water::moving_rows(hb, water::blend(table.added_mass, slopes));
  return out;
}

/// Derivatives of momentum and force of body i by the motion of body j, along the hydrodynamic axes
/// of both.
struct HydroPair {
  Matrix6 momentum;                  ///< by U
  Matrix6 inertia;                   ///< of the force, by U'
  Matrix6 damping = Matrix6::Zero(); ///< of the force, by U
  bool damps = false;                ///< false: `damping` is zero
};

inline HydroPair hydro_pair(const Regime& s, Workspace<double>& ws, std::size_t i, std::size_t j) {
  const HydroBody &a = s.hydro.bodies[i], &b = s.hydro.bodies[j];
  HydroPair out;
  out.momentum = water::hydro_block(s.hydro.added_mass.moving, a, b);
  if (i == j && a.table >= 0) {
    const TableHere here = table_here(s, ws, a);
    out.momentum += here.A;
    out.damping = here.rate * here.A_slope;
    out.damps = true;
  }
  out.inertia = out.momentum;
  const water::WaterMotion<double> motion = water_motion<double>(s, ws, nullptr);
  out.damps |= s.hydro.visit(
      [&](const auto& rung) { return rung.add_gradient(motion, i, j, out.inertia, out.damping); });
  return out;
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

/// Mass matrix M + D A D^T in the poses of the workspace, by pairs of bodies. visit(i, j,
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
    for (const int partner : s.hydro.partners[i]) {
      const auto j = static_cast<std::size_t>(partner);
      Matrix6 block = hydro_pair(s, ws.state, i, j).inertia;
      turn_columns(D[j], forces(wet[j]), block);
      turn_rows(D[i], forces(wet[i]), block);
      visit(wet[i].body, wet[j].body, block);
    }
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i)
    visit(i, i, rigid_mass(s.bodies[i]));
}

} // namespace hydrodae::system
