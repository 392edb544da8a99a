/// Linear model about a pose at rest.

#include "hydrodae/math/dense.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::statics {

using system::Regime;

namespace {

/// Eliminates the algebraic unknowns, z_a = -A_aa^-1 (A_ad z_d + B_a xi + D_a xi'), which adds
/// their effects to stiffness, damping and the loads of the other states.
void take_out_algebraic(const Regime& s, LinearMatrices& m) {
  std::vector<Index> a, d;
  for (Index z = s.z0; z < s.memory0; ++z)
    (s.is_algebraic(z) ? a : d).push_back(z - s.z0);
  if (a.empty())
    return;
  const auto all = Eigen::all;
  const MatrixX A = m.state_by_state, B = m.state_by_xi, D = m.state_by_rate, F = m.load_by_state;
  const MatrixX own = A(a, a), by_state = -solve_square(own, A(a, d)),
                by_xi = -solve_square(own, B(a, all)), by_rate = -solve_square(own, D(a, all));
  m.stiffness -= F(all, a) * by_xi;
  m.damping -= F(all, a) * by_rate;
  m.load_by_state = F(all, d) + F(all, a) * by_state;
  m.state_by_state = A(d, d) + A(d, a) * by_state;
  m.state_by_xi = B(d, all) + A(d, a) * by_xi;
  m.state_by_rate = D(d, all) + A(d, a) * by_rate;
}

} // namespace

LinearMatrices linear_matrices(const Regime& s, const system::Pattern& pattern, const VectorX& y) {
  const VectorX rest = VectorX::Zero(s.n);
  system::JacobianWorkspace ws(s);
  system::JacobianParts parts(pattern);
  system::jacobian(s, pattern, ws, 0.0, y.data(), rest.data(), parts);
  const Index z0 = s.z0, n_z = s.memory0 - z0;
  MatrixX by_y = MatrixX::Zero(s.n, z0 + n_z), by_yp = by_y;
  for (Index c = 0; c < z0 + n_z; ++c)
    for (Index k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k) {
      by_y(pattern.row[k], c) += parts.by_y[k];
      by_yp(pattern.row[k], c) += parts.by_yp[k];
    }
  LinearMatrices out;
  const MatrixX E = -by_y.block(0, s.u0, s.n_q, s.n_u); // rows q' - E u
  out.mass = by_yp.block(s.u0, s.u0, s.n_u, s.n_u);
  out.damping = by_y.block(s.u0, s.u0, s.n_u, s.n_u);
  out.stiffness = by_y.block(s.u0, 0, s.n_u, s.n_q) * E;
  out.constraints = by_y.block(s.lambda0, s.u0, s.n_lambda, s.n_u);
  out.load_by_state = -by_y.block(s.u0, z0, s.n_u, n_z);
  out.state_by_state = -by_y.block(z0, z0, n_z, n_z);
  out.state_by_xi = -by_y.block(z0, 0, n_z, s.n_q) * E;
  out.state_by_rate = -by_y.block(z0, s.u0, n_z, s.n_u);
  take_out_algebraic(s, out);
  system::Workspace<double> state(s);
  VectorX r(s.n);
  system::residual<double>(s, state, 0.0, y.data(), rest.data(), r.data());
  out.forces = -r.segment(s.u0, s.n_u);
  return out;
}

MatrixX hydro_map(const Regime& s, const system::Workspace<double>& ws) {
  MatrixX out = MatrixX::Zero(s.hydro.n_moving, s.n_u);
  for (const system::HydroBody& hb : s.hydro.bodies) {
    const auto body = static_cast<std::size_t>(hb.body);
    const system::BodyData& b = s.bodies[body];
    const auto d = water::hydro_motion_gradient(s.hydro.axes, hb, ws.bodies[body]);
    Matrix6 by_velocity;
    by_velocity << d.U_v, d.U_w;
    for (Index c = 0; c < 6; ++c) {
      const int row = hb.moving[static_cast<std::size_t>(c)];
      for (int k = 0; k < b.n_active && row >= 0; ++k)
        out(row, b.u0 - s.u0 + k) = by_velocity(c, b.active[static_cast<std::size_t>(k)]);
    }
  }
  return out;
}

} // namespace hydrodae::statics
