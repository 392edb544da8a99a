#include "hydrodae/ensemble/lane_model.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/ensemble/lane_kernels.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::ensemble {

namespace {

/// Pivots against their entries below which rows count as dependent: above, rounding (2e-16) leaves
/// the reactions an error of 2e-8. A run alone refines such solutions.
constexpr double regular = 1e-8;

} // namespace

LaneModel::Run::Run(const system::Regime& regime)
    : s(regime), state(regime), y(VectorX::Zero(regime.n)), still(VectorX::Zero(regime.n)),
      residual(VectorX::Zero(regime.n)) {}

LaneModel::LaneModel(std::span<const system::Regime* const> runs)
    : s_(*runs[0]), n_(s_.lambda0), bodies_(s_.bodies.size()), loads_(s_.bodies.size()),
      U_(static_cast<std::size_t>(s_.hydro.n_moving)), U_dot_(U_), momentum_(U_), force_(U_),
      damped_(U_), turns_(s_.hydro.bodies.size()) {
  sound.fill(true);
  for (const system::Regime* regime : runs)
    runs_.emplace_back(*regime);
  find_clusters();
  find_rows();
  system::for_each_law(
      s_, [&](const system::ElementList& list, std::size_t, const system::PortData& port) {
        if (list.laws->absorbs)
          take_offs_.push_back(port.component);
      });
  absorbed_.resize(take_offs_.size());
  balances_.resize(s_.n_mechanisms > 1 ? 1 + static_cast<std::size_t>(s_.n_mechanisms) : 1);
}

/// Bodies that share added mass are one cluster.
void LaneModel::find_clusters() {
  std::vector<int> of(s_.bodies.size());
  for (std::size_t i = 0; i < of.size(); ++i)
    of[i] = static_cast<int>(i);
  const std::vector<system::HydroBody>& wet = s_.hydro.bodies;
  for (std::size_t i = 0; i < wet.size(); ++i) {
    if (!wet[i].moves)
      continue;
    for (const int j : s_.hydro.partners[i]) {
      const int a = of[static_cast<std::size_t>(wet[i].body)],
                b = of[static_cast<std::size_t>(wet[static_cast<std::size_t>(j)].body)];
      std::replace(of.begin(), of.end(), std::max(a, b), std::min(a, b));
    }
  }
  cluster_of_.assign(of.size(), -1);
  offset_.assign(of.size(), 0);
  for (std::size_t first = 0; first < of.size(); ++first) {
    Cluster cluster;
    Index n = 0;
    for (std::size_t i = first; i < of.size(); ++i) {
      if (of[i] != static_cast<int>(first) || s_.bodies[i].n_active == 0)
        continue;
      cluster.bodies.push_back(static_cast<int>(i));
      cluster_of_[i] = static_cast<int>(clusters_.size());
      offset_[i] = n;
      n += s_.bodies[i].n_active;
    }
    if (n == 0)
      continue;
    cluster.mass.resize(n);
    cluster.load.resize(static_cast<std::size_t>(n));
    clusters_.push_back(std::move(cluster));
  }
}

void LaneModel::find_rows() {
  for (const system::JointData& j : s_.joints)
    for (const system::RowData& data : j.rows) {
      if (!s_.holds(data))
        continue;
      Row row{&j, data.kind, s_.mu(data), s_.lambda(data), {}, {}, {}};
      for (const int body : {j.A.body, j.B.body}) {
        const int c = body < 0 ? -1 : cluster_of_[static_cast<std::size_t>(body)];
        if (c < 0)
          continue;
        const Index from = offset_[static_cast<std::size_t>(body)];
        const auto same = std::find_if(row.parts.begin(), row.parts.end(),
                                       [&](const Row::Part& p) { return p.cluster == c; });
        if (same != row.parts.end())
          same->from = std::min(same->from, from);
        else
          row.parts.push_back({c, from, {}});
      }
      for (Row::Part& part : row.parts)
        part.w.resize(static_cast<std::size_t>(
            clusters_[static_cast<std::size_t>(part.cluster)].mass.size()));
      rows_.push_back(std::move(row));
    }
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t p = 0; p < rows_[i].parts.size(); ++p)
      clusters_[static_cast<std::size_t>(rows_[i].parts[p].cluster)].rows.push_back(
          {static_cast<Index>(i), p});
  schur_.resize(static_cast<Index>(rows_.size()));
  lambda_.resize(rows_.size());
  gap_.resize(rows_.size());
  step_.resize(static_cast<std::size_t>(s_.n_u));
}

/// y of run k.
void LaneModel::take(const Lanes* y, std::size_t k) {
  double* out = runs_[k].y.data();
  for (Index i = 0; i < n_; ++i)
    out[i] = y[i].lane[k];
}

/// Computes poses and velocities of the bodies from those of the runs.
void LaneModel::see_bodies() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    BodyLanes& b = bodies_[i];
    for (std::size_t k = 0; k < width; ++k) {
      const element::BodyState<double>& of = runs_[k].state.bodies[i];
      for (int c = 0; c < 3; ++c) {
        b.r[c].lane[k] = of.r[c];
        b.v[c].lane[k] = of.v[c];
        b.w[c].lane[k] = of.w[c];
      }
      for (int c = 0; c < 4; ++c)
        b.p[c].lane[k] = of.p[c];
      for (int c = 0; c < 9; ++c)
        b.R.data()[c].lane[k] = of.R.data()[c];
    }
  }
}

/// Weights and loads of the elements; rates of their states.
void LaneModel::add_elements(double t, const Lanes* y, Lanes* yp) {
  for (std::size_t k = 0; k < width; ++k) {
    Run& run = runs_[k];
    take(y, k);
    system::begin_loads<double>(run.s, run.state, t, run.y.data(), run.still.data());
    std::size_t number = 0;
    for (const system::ElementList& list : run.s.elements) {
      system::add_loads<double>(run.s, list, run.state, run.y.data(), run.still.data(),
                                run.residual.data());
      if (!list.laws->absorbs)
        continue;
      const element::Shape& shape = list.laws->shape;
      const system::ElementScratch<double>& seen =
          run.state.elements[system::index_of(run.s, list)];
      for (std::size_t law = 0; law < list.ports.size(); ++law) {
        const double* v =
            seen.in.data() + law * static_cast<std::size_t>(shape.n_in()) + shape.width;
        const double* load = seen.out.data() + law * static_cast<std::size_t>(shape.n_out());
        double power = 0.0;
        for (int c = 0; c < shape.width; ++c)
          power -= load[c] * v[c];
        absorbed_[number++].lane[k] = power;
      }
    }
    for (std::size_t i = 0; i < loads_.size(); ++i)
      for (int c = 0; c < 6; ++c)
        loads_[i][c].lane[k] = run.state.loads[i][c];
    for (Index z = s_.z0; z < s_.memory0; ++z)
      yp[z].lane[k] = -run.residual[z];
  }
}

Vec6<Lanes> LaneModel::of_body(const system::HydroBody& hb,
                               const std::vector<Lanes>& values) const {
  Vec6<Lanes> out;
  for (int c = 0; c < 6; ++c) {
    const int u = hb.moving[static_cast<std::size_t>(c)];
    out[c] = u < 0 ? Lanes(0.0) : values[static_cast<std::size_t>(u)];
  }
  return out;
}

/// Radiation, and the inertia of the added mass apart from that of the accelerations.
HYDRODAE_WIDE void LaneModel::add_water(const Lanes* y, Lanes* yp) {
  const system::HydroData& h = s_.hydro;
  for (const system::HydroBody& hb : h.bodies) {
    if (!hb.moves)
      continue;
    const BodyLanes& b = bodies_[static_cast<std::size_t>(hb.body)];
    const Vec6<Lanes> U = water::hydro_velocity<Lanes>(h.axes, hb, b),
                      U_dot = water::hydro_acceleration<Lanes>(h.axes, hb, b);
    for (int c = 0; c < 6; ++c)
      if (const int u = hb.moving[static_cast<std::size_t>(c)]; u >= 0) {
        U_[static_cast<std::size_t>(u)] = U[c];
        U_dot_[static_cast<std::size_t>(u)] = U_dot[c];
      }
  }
  std::fill(momentum_.begin(), momentum_.end(), Lanes(0.0));
  std::fill(damped_.begin(), damped_.end(), Lanes(0.0));
  const water::WaterMotion<Lanes> motion{h,       U_.data(), U_dot_.data(), y + h.z0,
                                         nullptr, nullptr,   nullptr,       nullptr};
  h.added_mass.product.add_product(U_.data(), momentum_.data());
  h.visit([&](const auto& rung) {
    rung.add_loads(motion, damped_.data());
    std::fill_n(yp + h.z0, rung.n_states(), Lanes(0.0));
    rung.add_rates(motion, 1.0, yp + h.z0);
  });
  for (std::size_t u = 0; u < U_.size(); ++u) {
    balances_[0].power -= U_[u] * damped_[u];
    balances_[0].kinetic += Lanes(0.5) * U_[u] * momentum_[u];
  }
  force_ = damped_;
  if (h.axes != system::HydroAxes::mean)
    h.added_mass.product.add_product(U_dot_.data(), force_.data());
  for (const system::HydroBody& hb : h.bodies)
    if (hb.moves)
      loads_[static_cast<std::size_t>(hb.body)] -=
          water::hydro_load<Lanes>(h.axes, hb, bodies_[static_cast<std::size_t>(hb.body)],
                                   of_body(hb, force_), of_body(hb, momentum_));
}

/// Gyroscopic moments; rates of the positions; the loads as right-hand sides.
HYDRODAE_WIDE void LaneModel::add_inertia(const Lanes* y, Lanes* yp) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const system::BodyData& data = s_.bodies[i];
    if (data.n_active == 0)
      continue;
    const BodyLanes& b = bodies_[i];
    const Vec3<Lanes> spin = data.inertia.cast<Lanes>() * b.w;
    balances_[0].kinetic += Lanes(0.5) * (Lanes(data.mass) * hydrodae::dot<Lanes>(b.v, b.v) +
                                          hydrodae::dot<Lanes>(b.w, spin));
    Vec6<Lanes> load = loads_[i];
    load.tail<3>() -= cross<Lanes>(b.w, spin);
    std::vector<Lanes>& right = clusters_[static_cast<std::size_t>(cluster_of_[i])].load;
    for (int k = 0; k < data.n_active; ++k) {
      const int c = data.active[static_cast<std::size_t>(k)];
      right[static_cast<std::size_t>(offset_[i] + k)] = load[c];
      if (c < 3 || data.rotation == system::BodyData::Rotation::about_axis)
        yp[data.q0 + k] = y[data.u0 + k];
    }
    if (data.rotation == system::BodyData::Rotation::free) {
      const Vec4<Lanes> rate = Lanes(0.5) * (quaternion_rate_matrix<Lanes>(b.p) * b.w);
      for (int k = 0; k < 4; ++k)
        yp[data.q0 + data.n_translations + k] = rate[k];
    }
  }
}

/// Matrix L of load = L (A U' + y) in hydro_axes.h, without the momentum terms.
LaneModel::Turn LaneModel::turn_of(const system::HydroBody& hb) const {
  const BodyLanes& b = bodies_[static_cast<std::size_t>(hb.body)];
  if (s_.hydro.axes == system::HydroAxes::body) {
    const Matrix3 one = Matrix3::Identity();
    return {b.R, one.cast<Lanes>()};
  }
  Mat3<Lanes> H;
  if (s_.hydro.axes == system::HydroAxes::yaw) {
    H = water::yaw<Lanes>(b).H;
  } else {
    Matrix3 turned;
    turned << hb.cos_yaw, -hb.sin_yaw, 0.0, hb.sin_yaw, hb.cos_yaw, 0.0, 0.0, 0.0, 1.0;
    H = turned.cast<Lanes>();
  }
  return {H, b.R.transpose() * H};
}

/// L_i A_ij L_j^T of two bodies in the water.
void LaneModel::add_water_mass(std::size_t i, std::size_t j) {
  const system::HydroBody &a = s_.hydro.bodies[i], &b = s_.hydro.bodies[j];
  const auto body_a = static_cast<std::size_t>(a.body), body_b = static_cast<std::size_t>(b.body);
  const system::BodyData &data_a = s_.bodies[body_a], &data_b = s_.bodies[body_b];
  if (offset_[body_b] > offset_[body_a])
    return; // the other triangle
  LaneCholesky& mass = clusters_[static_cast<std::size_t>(cluster_of_[body_a])].mass;
  const auto block = [&](int row, int column) {
    Mat3<Lanes> out;
    for (int m = 0; m < 3; ++m)
      for (int n = 0; n < 3; ++n) {
        const int u = a.moving[static_cast<std::size_t>(row + m)],
                  v = b.moving[static_cast<std::size_t>(column + n)];
        out(m, n) = Lanes(u < 0 || v < 0 ? 0.0 : s_.hydro.added_mass.moving(u, v));
      }
    return out;
  };
  Eigen::Matrix<Lanes, 6, 6> turned;
  for (int row : {0, 3})
    for (int column : {0, 3}) {
      const Mat3<Lanes>& left = row == 0 ? turns_[i].force : turns_[i].moment;
      const Mat3<Lanes>& right = column == 0 ? turns_[j].force : turns_[j].moment;
      const Mat3<Lanes> half = left * block(row, column);
      turned.block<3, 3>(row, column) = half * right.transpose();
    }
  for (int k = 0; k < data_a.n_active; ++k)
    for (int l = 0; l < data_b.n_active; ++l)
      if (const Index m = offset_[body_a] + k, n = offset_[body_b] + l; n <= m)
        mass.at(m, n) += turned(data_a.active[static_cast<std::size_t>(k)],
                                data_b.active[static_cast<std::size_t>(l)]);
}

HYDRODAE_WIDE void LaneModel::fill_masses() {
  for (Cluster& cluster : clusters_) {
    cluster.mass.set_zero();
    for (const int body : cluster.bodies) {
      const system::BodyData& data = s_.bodies[static_cast<std::size_t>(body)];
      const Index at = offset_[static_cast<std::size_t>(body)];
      for (int k = 0; k < data.n_active; ++k)
        for (int l = 0; l <= k; ++l) {
          const int c = data.active[static_cast<std::size_t>(k)],
                    d = data.active[static_cast<std::size_t>(l)];
          if (c < 3 && c == d)
            cluster.mass.at(at + k, at + l) = Lanes(data.mass);
          else if (c >= 3 && d >= 3)
            cluster.mass.at(at + k, at + l) = Lanes(data.inertia(c - 3, d - 3));
        }
    }
  }
  const std::vector<system::HydroBody>& wet = s_.hydro.bodies;
  for (std::size_t i = 0; i < wet.size(); ++i)
    if (wet[i].moves)
      turns_[i] = turn_of(wet[i]);
  for (std::size_t i = 0; i < wet.size(); ++i)
    if (wet[i].moves)
      for (const int j : s_.hydro.partners[i])
        if (wet[static_cast<std::size_t>(j)].moves)
          add_water_mass(i, static_cast<std::size_t>(j));
  for (Cluster& cluster : clusters_)
    cluster.mass.factorise(0.0, sound);
}

/// The kinds of rows whose value is a formula without branches.
template <class S>
joint::Row<S> smooth_row(const joint::BasicRow& kind, const system::JointData& j,
                         const joint::Geometry<S>& g) {
  if (const auto* span = std::get_if<joint::SpanRow>(&kind))
    return span->at<S>(j.A, j.B, j.parameters, g);
  if (const auto* perp = std::get_if<joint::PerpRow>(&kind))
    return perp->at<S>(j.A, j.B, j.parameters, g);
  return std::get<joint::DistanceRow>(kind).at<S>(j.A, j.B, j.parameters, g);
}

template <> joint::Geometry<Lanes> LaneModel::geometry<Lanes>(const system::JointData& j) const {
  Vec3<Lanes> r[2];
  Mat3<Lanes> R[2];
  const int body[2] = {j.A.body, j.B.body};
  for (int side = 0; side < 2; ++side)
    if (body[side] < 0) {
      r[side] = Vec3<Lanes>(Lanes(0.0), Lanes(0.0), Lanes(0.0));
      const Matrix3 one = Matrix3::Identity();
      R[side] = one.cast<Lanes>();
    } else {
      r[side] = bodies_[static_cast<std::size_t>(body[side])].r;
      R[side] = bodies_[static_cast<std::size_t>(body[side])].R;
    }
  return joint::geometry<Lanes>(j.B, r[0], R[0], r[1], R[1]);
}

/// Geometry with the rates of the poses.
template <> joint::Geometry<Moving> LaneModel::geometry<Moving>(const system::JointData& j) const {
  Vec3<Moving> r[2];
  Mat3<Moving> R[2];
  const int body[2] = {j.A.body, j.B.body};
  for (int side = 0; side < 2; ++side) {
    if (body[side] < 0) {
      for (int k = 0; k < 3; ++k)
        r[side][k] = Moving(0.0);
      const Matrix3 one = Matrix3::Identity();
      R[side] = one.cast<Moving>();
      continue;
    }
    const BodyLanes& b = bodies_[static_cast<std::size_t>(body[side])];
    const Mat3<Lanes> rate = b.R * skew<Lanes>(b.w);
    for (int k = 0; k < 3; ++k)
      r[side][k] = {b.r[k], b.v[k]};
    for (int k = 0; k < 9; ++k)
      R[side].data()[k] = {b.R.data()[k], rate.data()[k]};
  }
  return joint::geometry<Moving>(j.B, r[0], R[0], r[1], R[1]);
}

/// Computes G^T and (dG/dt) u of a row.
void LaneModel::fill_row(Row& row, const joint::Geometry<Moving>& g) {
  const system::JointData& j = *row.joint;
  const joint::Row<Moving> value = smooth_row<Moving>(row.kind, j, g);
  row.bias = Lanes(0.0);
  for (Row::Part& part : row.parts)
    std::fill(part.w.begin(), part.w.end(), Lanes(0.0));
  const int side_body[2] = {j.A.body, j.B.body};
  for (int side = 0; side < 2; ++side) {
    if (side_body[side] < 0)
      continue;
    const auto body = static_cast<std::size_t>(side_body[side]);
    const BodyLanes& b = bodies_[body];
    for (int c = 0; c < 3; ++c) {
      row.bias += value.gradient[6 * side + c].b * b.v[c];
      row.bias += value.gradient[6 * side + 3 + c].b * b.w[c];
    }
    const system::BodyData& data = s_.bodies[body];
    for (Row::Part& part : row.parts)
      if (part.cluster == cluster_of_[body])
        for (int k = 0; k < data.n_active; ++k)
          part.w[static_cast<std::size_t>(offset_[body] + k)] +=
              value.gradient[6 * side + data.active[static_cast<std::size_t>(k)]].a;
  }
}

/// Computes G^T and (dG/dt) u of all rows, which are in the order of joints, and L^-1 G^T.
HYDRODAE_WIDE void LaneModel::fill_rows() {
  for (std::size_t i = 0; i < rows_.size();) {
    const system::JointData* joint = rows_[i].joint;
    const joint::Geometry<Moving> g = geometry<Moving>(*joint);
    for (; i < rows_.size() && rows_[i].joint == joint; ++i)
      fill_row(rows_[i], g);
  }
  for (Cluster& cluster : clusters_) {
    std::size_t i = 0;
    for (; i + 4 <= cluster.rows.size(); i += 4) {
      Lanes* vectors[4];
      Index from = cluster.mass.size();
      for (std::size_t k = 0; k < 4; ++k) {
        Row::Part& part = cluster.part(rows_, i + k);
        vectors[k] = part.w.data();
        from = std::min(from, part.from);
      }
      cluster.mass.solve_forward(vectors, from);
    }
    for (; i < cluster.rows.size(); ++i) {
      Row::Part& part = cluster.part(rows_, i);
      cluster.mass.solve_forward(part.w.data(), part.from);
    }
  }
}

void LaneModel::factorise_rows() {
  schur_.set_zero();
  Lanes sums[4];
  for (Cluster& cluster : clusters_) {
    const Index n = cluster.mass.size();
    for (std::size_t i = 0; i < cluster.rows.size(); ++i) {
      const Row::Part& a = cluster.part(rows_, i);
      std::size_t j = 0;
      for (; j + 4 <= i + 1; j += 4) {
        const Lanes* vectors[4];
        for (std::size_t k = 0; k < 4; ++k)
          vectors[k] = cluster.part(rows_, j + k).w.data() + a.from;
        lane_kernels().dots(a.w.data() + a.from, vectors, n - a.from, sums);
        for (std::size_t k = 0; k < 4; ++k)
          schur_.at(cluster.rows[i].row, cluster.rows[j + k].row) += sums[k];
      }
      for (; j <= i; ++j)
        schur_.at(cluster.rows[i].row, cluster.rows[j].row) +=
            dot(a.w.data() + a.from, cluster.part(rows_, j).w.data() + a.from, n - a.from);
    }
  }
  schur_.factorise(regular, sound);
}

/// loads := L^-T (loads + L^-1 G^T lambda) of each cluster.
HYDRODAE_WIDE void LaneModel::add_reactions() {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (const Row::Part& part : rows_[i].parts) {
      Lanes* load = clusters_[static_cast<std::size_t>(part.cluster)].load.data();
      for (std::size_t k = static_cast<std::size_t>(part.from); k < part.w.size(); ++k)
        load[k] += part.w[k] * lambda_[i];
    }
  for (Cluster& cluster : clusters_)
    cluster.mass.solve_backward(cluster.load.data());
}

/// Accelerations into the loads of the clusters, by their Schur complement.
HYDRODAE_WIDE void LaneModel::solve() {
  for (Cluster& cluster : clusters_)
    cluster.mass.solve_forward(cluster.load.data());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    lambda_[i] = -rows_[i].bias;
    for (const Row::Part& part : rows_[i].parts)
      lambda_[i] -= dot(part.w.data() + part.from,
                        clusters_[static_cast<std::size_t>(part.cluster)].load.data() + part.from,
                        static_cast<Index>(part.w.size()) - part.from);
  }
  schur_.solve_forward(lambda_.data());
  schur_.solve_backward(lambda_.data());
  add_reactions();
}

void LaneModel::accelerations(double t, const Lanes* y, Lanes* yp) {
  add_elements(t, y, yp);
  see_bodies();
  balances_[0] = {Lanes(0.0), Lanes(0.0)};
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    balances_[0].power += hydrodae::dot<Lanes>(Vec3<Lanes>(loads_[i].head<3>()), bodies_[i].v);
    balances_[0].power += hydrodae::dot<Lanes>(Vec3<Lanes>(loads_[i].tail<3>()), bodies_[i].w);
    bodies_[i].v_dot = bodies_[i].w_dot = Vec3<Lanes>(Lanes(0.0), Lanes(0.0), Lanes(0.0));
  }
  if (s_.hydro.n_moving > 0)
    add_water(y, yp);
  add_inertia(y, yp);
  fill_masses();
  fill_rows();
  factorise_rows();
  solve();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const system::BodyData& data = s_.bodies[i];
    for (int k = 0; k < data.n_active; ++k)
      yp[data.u0 + k] = clusters_[static_cast<std::size_t>(cluster_of_[i])]
                            .load[static_cast<std::size_t>(offset_[i] + k)];
  }
  weigh_mechanisms(yp);
}

/// step_ = -M^-1 G^T (G M^-1 G^T)^-1 gap_, (n_u,) in lanes.
void LaneModel::close() {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    lambda_[i] = -gap_[i];
  schur_.solve_forward(lambda_.data());
  schur_.solve_backward(lambda_.data());
  for (Cluster& cluster : clusters_)
    std::fill(cluster.load.begin(), cluster.load.end(), Lanes(0.0));
  add_reactions();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const system::BodyData& data = s_.bodies[i];
    for (int k = 0; k < data.n_active; ++k)
      step_[static_cast<std::size_t>(data.u0 - s_.u0 + k)] =
          clusters_[static_cast<std::size_t>(cluster_of_[i])]
              .load[static_cast<std::size_t>(offset_[i] + k)];
  }
}

/// Reads the poses of y.
void LaneModel::see(const Lanes* y) {
  for (std::size_t k = 0; k < width; ++k) {
    take(y, k);
    system::unpack<double>(runs_[k].s, runs_[k].y.data(), runs_[k].still.data(),
                           runs_[k].state.bodies);
  }
  see_bodies();
}

/// Writes the positions of the runs into y.
void LaneModel::put(Lanes* y) const {
  for (std::size_t k = 0; k < width; ++k)
    for (Index i = 0; i < s_.u0; ++i)
      y[i].lane[k] = runs_[k].y[i];
}

/// gap_ of all rows at the poses of y. @returns the widest of each lane over its scale
Lanes LaneModel::find_gaps(const Lanes* y) {
  see(y);
  Lanes worst(0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const joint::Row<Lanes> row =
        smooth_row<Lanes>(rows_[i].kind, *rows_[i].joint, geometry<Lanes>(*rows_[i].joint));
    gap_[i] = row.value;
    rows_[i].gradient = row.gradient;
    for (std::size_t k = 0; k < width; ++k)
      if (const double part = std::abs(row.value.lane[k]) / runs_[k].s.row_scale[rows_[i].mu];
          !(part <= worst.lane[k]))
        worst.lane[k] = part; // NaN too
  }
  return worst;
}

/// gap_: rates of all rows at the last poses. @returns the largest of each lane over its scale
Lanes LaneModel::find_rates(const Lanes* y) {
  Lanes worst(0.0), fastest(0.0);
  for (Index i = s_.u0; i < s_.u0 + s_.n_u; ++i)
    for (std::size_t k = 0; k < width; ++k)
      fastest.lane[k] = std::max(fastest.lane[k], std::abs(y[i].lane[k]));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    gap_[i] = Lanes(0.0);
    const int side_body[2] = {rows_[i].joint->A.body, rows_[i].joint->B.body};
    for (int side = 0; side < 2; ++side) {
      if (side_body[side] < 0)
        continue;
      const system::BodyData& data = s_.bodies[static_cast<std::size_t>(side_body[side])];
      for (int k = 0; k < data.n_active; ++k)
        gap_[i] +=
            rows_[i].gradient[6 * side + data.active[static_cast<std::size_t>(k)]] * y[data.u0 + k];
    }
    for (std::size_t k = 0; k < width; ++k)
      if (const double part = std::abs(gap_[i].lane[k]) /
                              std::max(runs_[k].s.row_scale[rows_[i].lambda], fastest.lane[k]);
          !(part <= worst.lane[k]))
        worst.lane[k] = part;
  }
  return worst;
}

void LaneModel::move_positions(Lanes* y) {
  VectorX move(s_.n_u);
  for (std::size_t k = 0; k < width; ++k) {
    for (Index i = 0; i < s_.n_u; ++i)
      move[i] = step_[static_cast<std::size_t>(i)].lane[k];
    system::retract(runs_[k].s, move, runs_[k].y);
  }
  put(y);
}

/// Projects as SaddlePoint::project does for one run, with the same limits.
void LaneModel::project(Lanes* y) {
  using linalg::SaddlePoint;
  for (std::size_t k = 0; k < width; ++k) {
    take(y, k);
    system::normalise(runs_[k].s, runs_[k].y);
  }
  put(y);
  if (rows_.empty())
    return;
  Lanes gap = find_gaps(y);
  double before = HUGE_VAL, worst = widest(gap);
  for (int pass = 0; pass < SaddlePoint::projections && worst > SaddlePoint::closed; ++pass) {
    if (worst >= 0.5 * before && worst < SaddlePoint::stalled)
      break; // rounding
    before = worst;
    close();
    move_positions(y);
    gap = find_gaps(y);
    worst = widest(gap);
  }
  find_rates(y);
  // two passes: the matrix belongs to a slightly different pose
  for (int pass = 0; pass < 2; ++pass) {
    close();
    for (Index i = 0; i < s_.n_u; ++i)
      y[s_.u0 + i] += step_[static_cast<std::size_t>(i)];
    const Lanes rate = find_rates(y);
    for (std::size_t k = 0; k < width && pass == 1; ++k)
      sound[k] =
          sound[k] && gap.lane[k] <= SaddlePoint::open && rate.lane[k] <= SaddlePoint::moving;
  }
}

/// Largest value of the sound lanes.
double LaneModel::widest(const Lanes& gap) const {
  double out = 0.0;
  for (std::size_t k = 0; k < width; ++k)
    if (sound[k] && std::isfinite(gap.lane[k]))
      out = std::max(out, gap.lane[k]);
  return out;
}

/// Kinetic energy of each mechanism, and the power of all that acts on its bodies: w x I w does no
/// work.
void LaneModel::weigh_mechanisms(const Lanes* yp) {
  if (balances_.size() == 1)
    return;
  std::fill(balances_.begin() + 1, balances_.end(), Balance{Lanes(0.0), Lanes(0.0)});
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const system::BodyData& data = s_.bodies[i];
    if (data.mechanism < 0)
      continue;
    Vec3<Lanes> v_dot(Lanes(0.0), Lanes(0.0), Lanes(0.0)), w_dot = v_dot;
    for (int k = 0; k < data.n_active; ++k) {
      const int c = data.active[static_cast<std::size_t>(k)];
      (c < 3 ? v_dot[c] : w_dot[c - 3]) = yp[data.u0 + k];
    }
    const BodyLanes& b = bodies_[i];
    const Vec3<Lanes> spin = data.inertia.cast<Lanes>() * b.w;
    Balance& of = balances_[1 + static_cast<std::size_t>(data.mechanism)];
    of.power +=
        Lanes(data.mass) * hydrodae::dot<Lanes>(b.v, v_dot) + hydrodae::dot<Lanes>(spin, w_dot);
    of.kinetic += Lanes(0.5) * (Lanes(data.mass) * hydrodae::dot<Lanes>(b.v, b.v) +
                                hydrodae::dot<Lanes>(b.w, spin));
  }
}

void LaneModel::check(std::size_t k, double t) const {
  const Run& run = runs_[k];
  std::vector<double> loads;
  for (const system::ElementList& list : run.s.elements) {
    if (!element::is_on_body(list.laws->shape.port))
      continue;
    const system::ElementScratch<double>& seen = run.state.elements[system::index_of(run.s, list)];
    loads.resize(6 * list.laws->size() * (1 + list.laws->parts.size()));
    list.laws->report(t, seen.in.data(), seen.out.data(), loads.data());
  }
}

void LaneModel::accept(int k, double t, const VectorX& y, const VectorX& yp) {
  Run& run = runs_[static_cast<std::size_t>(k)];
  system::accept_turns(run.s, t, y.data(), yp.data(), run.state);
}

} // namespace hydrodae::ensemble
