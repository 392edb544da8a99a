/// Derivatives of the equations of a line, block by block.

#include <algorithm>

#include "hydrodae/line/line_model.h"

namespace hydrodae::line {

namespace {

/// Visits the blocks (row node i, column node j, by velocity?) in a fixed order.
template <class Visit> void for_each_line_block(const LineModel& m, Visit&& visit) {
  const int n = m.n(), far = m.bends ? 2 : 1;
  for (int i = 0; i <= n; ++i) {
    for (int j = std::max(0, i - far); j <= std::min(n, i + far); ++j)
      visit(i, j, false);
    for (int j = std::max(0, i - 1); j <= std::min(n, i + 1); ++j)
      visit(i, j, true);
  }
}

/// Adds the bending force f_a[m] q_a ..., with a = x_i - x_(i-1) and b = x_(i+1) - x_i, of the
/// energy c (1 - e_a . e_b):
///   H_aa = c (s P_a + e_a p^T + p e_a^T) / a^2,   p = P_a e_b,   H_ab = -c P_a P_b / (a b)
void add_bending(double c, int i, const SegmentPull<double>& a, const SegmentPull<double>& b,
                 LineBlocks& K) {
  const Matrix3 I = Matrix3::Identity(), P_a = I - a.e * a.e.transpose(),
                P_b = I - b.e * b.e.transpose();
  const double s = a.e.dot(b.e);
  const Vector3 p_a = P_a * b.e, p_b = P_b * a.e;
  const Matrix3 turn_a = a.e * p_a.transpose(), turn_b = b.e * p_b.transpose();
  const Matrix3 H[2][2] = {{c / (a.length * a.length) * (s * P_a + turn_a + turn_a.transpose()),
                            -c / (a.length * b.length) * P_a * P_b},
                           {-c / (a.length * b.length) * P_b * P_a,
                            c / (b.length * b.length) * (s * P_b + turn_b + turn_b.transpose())}};
  constexpr double sign[2][3] = {{1, -1, 0}, {0, 1, -1}};
  for (int m = 0; m < 3; ++m)
    for (int j = 0; j < 3; ++j)
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          if (const double w = sign[p][m] * sign[q][j]; w != 0.0)
            K.by_place[static_cast<std::size_t>(i - 1 + m)][static_cast<std::size_t>(j - m + 2)] -=
                w * H[p][q];
}

void add_segments(const LineView<double>& at, LineBlocks& K) {
  SegmentPull<double> before{};
  for (int k = 0; k < at.m.n(); ++k) {
    const LineSegment& seg = at.m.segments[static_cast<std::size_t>(k)];
    const SegmentPull<double> p = segment_pull<double>(at, k);
    const Matrix3 P = Matrix3::Identity() - p.e * p.e.transpose();
    const Plus<double> s = at.stretch(k, p.length);
    const Plus<double> damped = at.damped(k, s);
    const double c = seg.damping / seg.length;
    const Vector3 turned = P * (at.velocity(k + 1) - at.velocity(k)) / p.length;
    const Vector3 T_d =
        (seg.stiffness * at.pulled(k, s).slope + c * p.rate * damped.curvature) / seg.length * p.e +
        c * damped.slope * turned;
    const Matrix3 B = p.e * T_d.transpose() + p.tension / p.length * P,
                  D = c * damped.slope * p.e * p.e.transpose();
    const auto here = static_cast<std::size_t>(k), next = here + 1;
    K.by_place[here][3] += B;
    K.by_place[here][2] -= B;
    K.by_place[next][2] -= B;
    K.by_place[next][1] += B;
    K.by_velocity[here][2] += D;
    K.by_velocity[here][1] -= D;
    K.by_velocity[next][1] -= D;
    K.by_velocity[next][0] += D;
    if (const double bending = at.bending(k); k > 0 && bending > 0.0)
      add_bending(bending, k, before, p, K);
    before = p;
  }
}

void add_bed(const LineModel& m, const LineNode& node, const Vector3& x, const Vector3& v,
             Matrix3& by_x, Matrix3& by_v) {
  const Plus<double> s = plus<double>(m.bed + node.axis_height - x[2], node.bed_width);
  if (!(s.value > 0.0))
    return;
  const Plus<double> down = down_rate<double>(-v[2], m.bed_damps_up);
  const double k = node.bed_stiffness, c = node.bed_damping;
  by_x(2, 2) -= k * s.slope + c * s.curvature * down.value;
  by_v(2, 2) -= c * s.slope * down.slope;
  const double r = std::sqrt(v.head<2>().squaredNorm() + slip_speed * slip_speed);
  const Eigen::Vector2d h = v.head<2>() / r;
  by_x.block<2, 1>(0, 2) += node.friction * k * s.slope * h;
  by_v.topLeftCorner<2, 2>() -=
      node.friction * k * s.value / r * (Eigen::Matrix2d::Identity() - h * h.transpose());
}

/// Adds a bed that is not flat: d g = -H dx with the second derivatives H of the bed, q = |g|.
void add_slope(const LineModel& m, const LineNode& node, const Vector3& x, const Vector3& v,
               Matrix3& by_x, Matrix3& by_v) {
  const BedContact<double> at = bed_contact<double>(m, node, x);
  const Plus<double>& s = at.s;
  if (!(s.value > 0.0))
    return;
  const Vector3& g = at.up;
  Matrix3 H = Matrix3::Zero();
  H.topLeftCorner<2, 2>() << at.bed.xx, at.bed.xy, at.bed.xy, at.bed.yy;
  const double into = -g.dot(v), square = g.squaredNorm(), q = std::sqrt(square);
  const Plus<double> down = down_rate<double>(into, m.bed_damps_up);
  const double k = node.bed_stiffness, c = node.bed_damping, rub = node.friction * k;
  const Vector3 turned = H * v, tilted = H * g;
  by_x += g * (c * s.slope * down.slope * turned - (k * s.slope + c * s.curvature * down.value) * g)
                  .transpose() -
          (k * s.value + c * s.slope * down.value) * H;
  by_v -= c * s.slope * down.slope * g * g.transpose();
  const Vector3 slip = v + into / square * g;
  const double r = std::sqrt(slip.squaredNorm() + slip_speed * slip_speed);
  const Vector3 h = slip / r;
  const Matrix3 turn = rub * s.value * q / r * (Matrix3::Identity() - h * h.transpose());
  by_x += rub * h * (s.slope * q * g + s.value / q * tilted).transpose() -
          turn * (g * (turned / square + 2.0 * into / (square * square) * tilted).transpose() -
                  into / square * H);
  by_v -= turn * (Matrix3::Identity() - g * g.transpose() / square);
}

/// Derivatives of the water force by the node's place, velocity and tangent.
struct WaterGradient {
  Matrix3 by_x = Matrix3::Zero(), by_v = Matrix3::Zero(), by_t = Matrix3::Zero();
};

void add_morison(const water::MorisonSegment& law, double lift, double displaced, const Vector3& t,
                 double above, const Vector3& u, const Vector3& a, const sea::FluidPoint<double>& f,
                 const sea::FluidGradient& g, WaterGradient& out) {
  if (law.radius == 0.0)
    return;
  double by_height = 0.0, by_axis_z = 0.0;
  const double wet = water::wet_part<double>(law, above, t[2], &by_height, &by_axis_z);
  water::MorisonGradient d = water::morison_gradient(law, t, u, f.acceleration, a);
  Vector3 dry =
      water::morison_force<double>(law, t, u, f.acceleration, a) + lift * Vector3::UnitZ();
  if (displaced > 0.0) { // pressure along the line: rho V (t . a_f) t
    const double along = t.dot(f.acceleration);
    dry += displaced * along * t;
    d.by_fluid += displaced * t * t.transpose();
    d.by_axis += displaced * (along * Matrix3::Identity() + t * f.acceleration.transpose());
  }
  const Vector3 up = Vector3::UnitZ() - g.elevation;
  out.by_x += wet * (d.by_velocity * g.velocity + d.by_fluid * g.acceleration) +
              by_height * dry * up.transpose();
  out.by_v -= wet * d.by_velocity;
  out.by_t += wet * d.by_axis + by_axis_z * dry * Vector3::UnitZ().transpose();
}

/// Adds the water force on node i, which has the acceleration a.
/// @returns the water at the node
NodeWater<double> add_water(const LineView<double>& at, const sea::WaveField& sea, double t, int i,
                            const Vector3& a, LineBlocks& K) {
  const auto k = static_cast<std::size_t>(i);
  const LineNode& node = at.m.nodes[k];
  sea::FluidGradient g;
  const NodeWater<double> w = node_water<double>(at, sea, t, i, &g);
  const Vector3 u = w.fluid.velocity - at.velocity(i);
  const double above = at.place(i)[2] - w.fluid.elevation;
  WaterGradient d, attached;
  add_morison(node.line, node.lift, node.displaced, w.t, above, u, a, w.fluid, g, d);
  add_morison(node.body, node.body_lift, 0.0, Vector3::Zero(), above, u, a, w.fluid, g, attached);
  K.by_place[k][2] += d.by_x + attached.by_x;
  K.by_velocity[k][1] += d.by_v + attached.by_v;
  const int low = node_before(at, i), high = node_behind(at, i);
  const double length = (at.place(high) - at.place(low)).norm();
  const Matrix3 turn = d.by_t * (Matrix3::Identity() - w.t * w.t.transpose()) / length;
  K.by_place[k][static_cast<std::size_t>(high - i + 2)] += turn;
  K.by_place[k][static_cast<std::size_t>(low - i + 2)] -= turn;
  return w;
}

} // namespace

std::vector<std::array<int, 2>> line_sparsity(const LineModel& m) {
  const int w = 3 * m.n_points();
  const auto row = [&](int i) { return i == 0 ? 0 : m.is_end(i) ? 3 : w + 6 * (i - 1) + 3; };
  const auto column = [&](int j, bool velocity) {
    if (m.is_end(j))
      return (j == 0 ? 0 : 3) + (velocity ? w : 0);
    return 2 * w + 6 * (j - 1) + (velocity ? 3 : 0);
  };
  std::vector<std::array<int, 2>> out;
  for (int i = 1; i <= m.n_unknown(); ++i)
    for (int c = 0; c < 3; ++c)
      out.push_back({w + 6 * (i - 1) + c, 2 * w + 6 * (i - 1) + 3 + c});
  for_each_line_block(m, [&](int i, int j, bool velocity) {
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        out.push_back({row(i) + r, column(j, velocity) + c});
  });
  return out;
}

double* line_jacobian(const LineView<double>& at, const sea::WaveField& sea, double t,
                      const double* rates, LineBlocks& K, double* values) {
  const LineModel& m = at.m;
  const auto n = static_cast<std::size_t>(m.n() + 1);
  K.by_place.resize(n);
  K.by_velocity.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    K.by_place[i].fill(Matrix3::Zero());
    K.by_velocity[i].fill(Matrix3::Zero());
  }
  add_segments(at, K);
  values = std::fill_n(values, 3 * m.n_unknown(), 1.0);
  for (int i = 0; i <= m.n(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const LineNode& node = m.nodes[k];
    const bool end = m.is_end(i);
    (m.surface ? add_slope : add_bed)(m, node, at.place(i), at.velocity(i), K.by_place[k][2],
                                      K.by_velocity[k][1]);
    NodeWater<double> w{Vector3::Zero(), {}, 0.0, 0.0};
    const Vector3 a =
        end ? Vector3(Vector3::Zero()) : Vector3(Eigen::Map<const Vector3>(rates + 6 * i - 3));
    if (m.wet)
      w = add_water(at, sea, t, i, a, K);
    if (end)
      continue;
    const NodeMass<double> mass = node_mass<double>(node, w.line, w.body);
    const Matrix3 inverse = Matrix3::Identity() / mass.across +
                            (1.0 / mass.along - 1.0 / mass.across) * w.t * w.t.transpose();
    for (Matrix3& block : K.by_place[k])
      block = (inverse * block).eval();
    for (Matrix3& block : K.by_velocity[k])
      block = (inverse * block).eval();
  }
  for_each_line_block(m, [&](int i, int j, bool velocity) {
    const auto k = static_cast<std::size_t>(i);
    const Matrix3& block = velocity ? K.by_velocity[k][static_cast<std::size_t>(j - i + 1)]
                                    : K.by_place[k][static_cast<std::size_t>(j - i + 2)];
    values = std::copy(block.data(), block.data() + 9, values);
  });
  return values;
}

} // namespace hydrodae::line
