#include "hydrodae/water/morison_list.h"

#include <utility>

namespace hydrodae::water {

namespace {

/// Scratch memory of a thread, which grows to the largest size so far.
template <class T> T* scratch(int n) {
  thread_local std::vector<T> memory;
  if (memory.size() < static_cast<std::size_t>(n))
    memory.resize(static_cast<std::size_t>(n));
  return memory.data();
}

/// Writes the water at the segments of an element into `fluid` (and `gradients`).
template <class S>
void morison_fluid(const sea::WaveField& water, const MorisonMember& m,
                   const element::BodyState<S>& body, double t, sea::FluidPoint<S>* fluid,
                   sea::FluidGradient* gradients = nullptr) {
  const Vec3<S> first = body.r + body.R * m.first.cast<S>();
  const Vec3<S> step = body.R * m.step.cast<S>();
  sea::fluid_on_line<S>(water, t, first, step, m.segments, fluid, gradients);
}

/// Load of an element: world force [N] and body-axes moment about the centre of gravity [N m].
template <class S>
Vec6<S> morison_load(const sea::WaveField& water, const MorisonMember& m,
                     const element::BodyState<S>& body, double t, sea::FluidPoint<S>* fluid) {
  morison_fluid<S>(water, m, body, t, fluid);
  const Vec3<S> axis = body.R * m.axis.cast<S>();
  Vec6<S> load = Vec6<S>::Zero();
  for (int k = 0; k < m.segments; ++k) {
    const sea::FluidPoint<S>& f = fluid[k];
    const Vec3<S> arm = (m.first + k * m.step).template cast<S>();
    const Vec3<S> spin = cross<S>(body.w, arm);
    const Vec3<S> velocity = body.v + body.R * spin;
    const Vec3<S> acceleration =
        body.v_dot + body.R * Vec3<S>(cross<S>(body.w_dot, arm) + cross<S>(body.w, spin));
    S height = body.r[2] + (body.R * arm)[2];
    if (m.instantaneous)
      height -= f.elevation;
    const Vec3<S> u = f.velocity - velocity;
    const Vec3<S> force = wet_part<S>(m.law, height, axis[2]) *
                          morison_force<S>(m.law, axis, u, f.acceleration, acceleration);
    load.template head<3>() += force;
    load.template tail<3>() += cross<S>(arm, Vec3<S>(body.R.transpose() * force));
  }
  return load;
}

/// Derivatives of a load by virtual displacements, velocities and accelerations of its body.
struct LoadGradient {
  Matrix6 by_displacement = Matrix6::Zero(), by_velocity = Matrix6::Zero(),
          by_acceleration = Matrix6::Zero();
};

/// Gradient of one segment: force F (3,) and dF by its velocity, acceleration and elevation.
struct SegmentGradient {
  Vector3 arm, force;
  MorisonGradient dry; ///< gradient without the wet part
  double wet = 0.0;
  Vector3 by_height, by_axis_z; ///< derivatives of F through the wet part
};

SegmentGradient segment_gradient(const MorisonMember& m, const element::BodyState<double>& b, int k,
                                 const sea::FluidPoint<double>& f) {
  SegmentGradient d;
  d.arm = m.first + k * m.step;
  const Vector3 spin = b.w.cross(d.arm), axis = b.R * m.axis;
  const Vector3 u = f.velocity - b.v - b.R * spin;
  const Vector3 acceleration = b.v_dot + b.R * (b.w_dot.cross(d.arm) + b.w.cross(spin));
  const double height = (b.r + b.R * d.arm)[2] - (m.instantaneous ? f.elevation : 0.0);
  double by_height = 0.0, by_axis_z = 0.0;
  d.wet = wet_part<double>(m.law, height, axis[2], &by_height, &by_axis_z);
  const Vector3 dry = morison_force<double>(m.law, axis, u, f.acceleration, acceleration);
  d.dry = morison_gradient(m.law, axis, u, f.acceleration, acceleration);
  d.force = d.wet * dry;
  d.by_height = by_height * dry;
  d.by_axis_z = by_axis_z * dry;
  return d;
}

// Kinematics: x = r + R s, v_b = v + R (w x s), a_b = v' + R c, c = w' x s + w x (w x s), t = R
// t_0:
//   dx = dr - R [s] dphi,  dv_b = dv - R [w x s] dphi - R [s] dw,  dt = -R [t_0] dphi,
//   da_b = dv' - R [c] dphi - R [s] dw' - R ([w x s] + [w][s]) dw.
// Load (F, s x R^T F): d(R^T F) = R^T dF + [R^T F] dphi.
LoadGradient load_gradient(const sea::WaveField& water, const MorisonMember& m,
                           const element::BodyState<double>& b, double t) {
  auto* fluid = scratch<sea::FluidPoint<double>>(m.segments);
  auto* gradients = scratch<sea::FluidGradient>(m.segments);
  morison_fluid<double>(water, m, b, t, fluid, gradients);
  const Matrix3 by_phi_axis = -b.R * skew<double>(m.axis), wx = skew<double>(b.w);
  LoadGradient out;
  for (int k = 0; k < m.segments; ++k) {
    const sea::FluidGradient& g = gradients[k];
    const SegmentGradient d = segment_gradient(m, b, k, fluid[k]);
    const Matrix3 sx = skew<double>(d.arm), spin_x = skew<double>(b.w.cross(d.arm));
    const Matrix3 c_x = skew<double>(b.w_dot.cross(d.arm) + b.w.cross(b.w.cross(d.arm)));
    const Vector3 up = Vector3::UnitZ() - (m.instantaneous ? g.elevation : Vector3::Zero());
    const Matrix3 by_x =
        d.wet * (d.dry.by_velocity * g.velocity + d.dry.by_fluid * g.acceleration) +
        d.by_height * up.transpose();
    const Matrix3 by_v = -d.wet * d.dry.by_velocity, by_a = d.wet * d.dry.by_body;
    const Matrix3 by_axis = d.wet * d.dry.by_axis + d.by_axis_z * Vector3::UnitZ().transpose();
    const Matrix3 R_sx = b.R * sx, moment = sx * b.R.transpose();
    const auto add = [&](Matrix6& to, const Matrix3& by_translation, const Matrix3& by_rotation) {
      to.topLeftCorner<3, 3>() += by_translation;
      to.topRightCorner<3, 3>() += by_rotation;
      to.bottomLeftCorner<3, 3>() += moment * by_translation;
      to.bottomRightCorner<3, 3>() += moment * by_rotation;
    };
    add(out.by_displacement, by_x,
        -by_x * R_sx - by_v * b.R * spin_x - by_a * b.R * c_x + by_axis * by_phi_axis);
    out.by_displacement.bottomRightCorner<3, 3>() += sx * skew<double>(b.R.transpose() * d.force);
    add(out.by_velocity, by_v, -by_v * R_sx - by_a * b.R * (spin_x + wx * sx));
    add(out.by_acceleration, by_a, -by_a * R_sx);
  }
  return out;
}

} // namespace

MorisonList::MorisonList(sea::WaveField sea) : water_(std::move(sea)) {
  type = "morison";
  shape.port = element::Port::in_water;
  lost = std::string("the quadratic drag of Morison elements ") +
         (water_.current.isZero(0.0) && water_.profile.empty()
              ? "is zero in the linear model (it has no slope at rest)"
              : "has in the linear model only the slope that the current gives it");
}

void MorisonList::add(const std::string& name, const MorisonMember& member) {
  names.push_back(name);
  members_.push_back(member);
}

template <class S> void MorisonList::loads(double t, const S* in, S* out) const {
  for (const MorisonMember& m : members_) {
    Eigen::Map<Vec6<S>> load(out);
    if (m.moves)
      load = morison_load<S>(water_, m, element::read_body(in), t,
                             scratch<sea::FluidPoint<S>>(m.segments));
    else
      load.setZero();
    in += element::body_numbers;
    out += 6;
  }
}

void MorisonList::evaluate(double t, const double* in, const double*, double* out) const {
  loads(t, in, out);
}

void MorisonList::evaluate(double t, const Dual* in, const double*, Dual* out) const {
  loads(t, in, out);
}

void MorisonList::jacobian(double t, const double* in, const double*, double* jacobian) const {
  for (const MorisonMember& m : members_) {
    Eigen::Map<Eigen::Matrix<double, 6, 18>> J(jacobian);
    if (m.moves) {
      const LoadGradient d = load_gradient(water_, m, element::read_body(in), t);
      J << d.by_displacement, d.by_velocity, d.by_acceleration;
    } else {
      J.setZero();
    }
    in += element::body_numbers;
    jacobian += J.size();
  }
}

void MorisonList::energy(const double*, const double*, double* joules) const {
  std::fill_n(joules, size(), 0.0);
}

void MorisonList::report(double t, const double* in, const double* out, double* loads) const {
  for (const MorisonMember& m : members_) {
    Eigen::Map<Vector6> load(loads);
    load = m.moves ? Vector6(Eigen::Map<const Vector6>(out))
                   : morison_load<double>(water_, m, element::read_body(in), t,
                                          scratch<sea::FluidPoint<double>>(m.segments));
    in += element::body_numbers;
    out += 6;
    loads += 6;
  }
}

bool MorisonList::lost_at_rest(std::size_t law) const {
  const MorisonMember& m = members_[law];
  return m.moves && (m.law.drag > 0.0 || m.law.drag_axial > 0.0);
}

element::WavesFelt MorisonList::waves() const {
  const auto n = static_cast<Index>(water_.terms.size());
  element::WavesFelt out{VectorX(n), VectorX(n), {}};
  for (Index i = 0; i < n; ++i) {
    out.omega[i] = water_.terms[static_cast<std::size_t>(i)].omega;
    out.amplitude[i] = water_.terms[static_cast<std::size_t>(i)].amplitude;
  }
  return out;
}

double MorisonList::elevation(double t) const {
  sea::FluidPoint<double> water;
  const Vector3 origin = Vector3::Zero();
  sea::fluid_on_line<double>(water_, t, origin, origin, 1, &water);
  return water.elevation;
}

std::vector<element::WaterLoad> MorisonList::by_water(std::size_t law, const double* in) const {
  const MorisonMember& m = members_[law];
  std::vector<element::WaterLoad> out;
  if (!m.moves)
    return out;
  const element::BodyState<double> b = element::read_body(in);
  std::vector<sea::FluidPoint<double>> fluid(static_cast<std::size_t>(m.segments));
  morison_fluid<double>(water_, m, b, 0.0, fluid.data());
  for (int k = 0; k < m.segments; ++k) {
    const SegmentGradient d = segment_gradient(m, b, k, fluid[static_cast<std::size_t>(k)]);
    element::WaterLoad point;
    point.point = b.r + b.R * d.arm;
    point.load.topRows<3>() << d.wet * d.dry.by_velocity, d.wet * d.dry.by_fluid,
        m.instantaneous ? Vector3(-d.by_height) : Vector3(Vector3::Zero());
    point.load.bottomRows<3>() = skew<double>(d.arm) * b.R.transpose() * point.load.topRows<3>();
    out.push_back(point);
  }
  return out;
}

std::shared_ptr<const element::Elements> MorisonList::calm() const {
  auto out = std::make_shared<MorisonList>(*this);
  out->water_.terms.clear();
  return out;
}

std::shared_ptr<const element::Elements>
MorisonList::stirred(const std::function<double()>& draw) const {
  auto out = std::make_shared<MorisonList>(*this);
  out->water_.ramp = 0.0;
  for (std::size_t i = 0; i < out->water_.terms.size(); ++i)
    out->water_.terms.set_phase(i, pi * draw());
  return out;
}

} // namespace hydrodae::water
