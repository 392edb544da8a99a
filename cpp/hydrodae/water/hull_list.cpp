#include "hydrodae/water/hull_list.h"

#include <cmath>
#include <utility>

#include "hydrodae/element/body_state.h"
#include "hydrodae/sea/component.h"

namespace hydrodae::water {

namespace {

hull::Pose pose_of(const element::BodyState<double>& b) { return {b.r, b.R}; }

/// Load as world force and body-axes moment.
Vector6 tangent_load(const Matrix3& R, const Vector6& wrench) {
  Vector6 load;
  load << wrench.head<3>(), R.transpose() * wrench.tail<3>();
  return load;
}

/// Derivative of `tangent_load` by a displacement (world axes) and a rotation phi (body axes), from
/// that of the wrench by both in world axes: d(R^T M) = R^T dM + (R^T M) x phi.
Matrix6 tangent_gradient(const Matrix3& R, const Vector6& load, const Matrix6& by_pose) {
  Matrix6 out;
  out.leftCols<3>() = by_pose.leftCols<3>();
  out.rightCols<3>() = by_pose.rightCols<3>() * R;
  out.bottomRows<3>() = R.transpose() * Eigen::Matrix<double, 3, 6>(out.bottomRows<3>());
  out.bottomRightCorner<3, 3>() += skew<double>(load.tail<3>());
  return out;
}

} // namespace

/// Scratch borrowed for one evaluation.
class HullList::Borrowed {
public:
  explicit Borrowed(const Body& body) : pool_(*body.pool) {
    {
      const std::lock_guard lock(pool_.guard);
      if (!pool_.idle.empty()) {
        scratch_ = std::move(pool_.idle.back());
        pool_.idle.pop_back();
      }
    }
    if (!scratch_)
      scratch_ = std::make_unique<Scratch>(
          Scratch{hull::Workspace(*body.mesh, body.field), false, {}, {}, {}});
  }
  ~Borrowed() {
    const std::lock_guard lock(pool_.guard);
    pool_.idle.push_back(std::move(scratch_));
  }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  Scratch* operator->() const { return scratch_.get(); }

private:
  Pool& pool_;
  std::unique_ptr<Scratch> scratch_;
};

HullList::HullList(const hull::Water& water, std::vector<hull::Wave> waves, double ramp_time)
    : water_(water), waves_(std::move(waves)), ramp_time_(ramp_time) {
  buoyant = true;
  type = waves_.empty() ? "hydrostatic" : "pressure";
  shape.port = element::Port::in_water;
  shape.feels_rates = false;
  work = element::Work::lent;
  if (!waves_.empty())
    parts = {"static_pressure", "wave_pressure"};
}

void HullList::add(const std::string& name, std::shared_ptr<const hull::Mesh> mesh,
                   const Vector3& reference, bool moves) {
  names.push_back(name);
  Body body{name,
            mesh,
            reference,
            moves,
            hull::WaveField(water_, waves_, mesh->radius),
            std::make_shared<Pool>(),
            0.0};
  body.energy_of_reference = potential(body, {reference, Matrix3::Identity()});
  bodies_.push_back(std::move(body));
}

hull::Instant HullList::instant(double t) const { return {t, sea::ramp(t, ramp_time_)}; }

hull::Loads HullList::loads(const Body& body, double t, const hull::Pose& pose,
                            Matrix6* by_pose) const {
  const Borrowed scratch(body);
  const hull::Instant now = instant(t);
  if (by_pose)
    return hull::loads(*body.mesh, body.field, pose, now, scratch->work, by_pose);
  const bool same = scratch->known && scratch->instant.time == now.time &&
                    scratch->instant.growth == now.growth &&
                    scratch->pose.position == pose.position &&
                    scratch->pose.rotation == pose.rotation;
  if (!same) {
    scratch->known = false; // for the case that the next line throws
    scratch->loads = hull::loads(*body.mesh, body.field, pose, now, scratch->work);
    scratch->pose = pose;
    scratch->instant = now;
    scratch->known = true;
  }
  return scratch->loads;
}

/// Potential -rho g integral z dV over the displaced volume, by Gauss's theorem over the wet
/// surface; exact, because z^2 is of degree 2.
double HullList::potential(const Body& body, const hull::Pose& pose) const {
  if (!waves_.empty())
    return 0.0;
  const Borrowed scratch(body);
  hull::find_wet_surface(*body.mesh, body.field, pose, {}, false, scratch->work);
  const hull::WetPoints& p = scratch->work.points;
  double sum = 0.0;
  for (int k = 0; k < p.size; ++k)
    sum += 0.5 * p.height[k] * p.height[k] * p.weight(k, 2);
  return -water_.density * water_.gravity * sum;
}

void HullList::evaluate(double t, const double* in, const double*, double* out) const {
  for (const Body& body : bodies_) {
    Eigen::Map<Vector6> load(out);
    if (body.moves) {
      const element::BodyState<double> b = element::read_body(in);
      const hull::Loads l = loads(body, t, pose_of(b));
      load = tangent_load(b.R, l.hydrostatic + l.dynamic);
    } else {
      load.setZero();
    }
    in += element::body_numbers;
    out += 6;
  }
}

void HullList::evaluate(double t, const Dual* in, const double*, Dual* out) const {
  for (const Body& body : bodies_) {
    std::array<double, element::body_numbers> values{};
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = in[k].a;
    const element::BodyState<double> b = element::read_body(values.data());
    Matrix6 by_pose = Matrix6::Zero();
    Vector6 load = Vector6::Zero(), change = Vector6::Zero();
    if (body.moves) {
      const hull::Loads l = loads(body, t, pose_of(b), &by_pose);
      load = tangent_load(b.R, l.hydrostatic + l.dynamic);
      const element::BodyState<Dual> d = element::read_body(in);
      Matrix3 dR;
      for (Index k = 0; k < 9; ++k)
        dR(k) = d.R(k).b;
      const Matrix3 turn = b.R.transpose() * dR; // skew matrix [phi] of body axes
      change << d.r[0].b, d.r[1].b, d.r[2].b, turn(2, 1), turn(0, 2), turn(1, 0);
      change = tangent_gradient(b.R, load, by_pose) * change;
    }
    for (Index k = 0; k < 6; ++k)
      out[k] = {load[k], change[k]};
    in += element::body_numbers;
    out += 6;
  }
}

void HullList::jacobian(double t, const double* in, const double*, double* jacobian) const {
  for (const Body& body : bodies_) {
    Eigen::Map<Eigen::Matrix<double, 6, 18>> J(jacobian);
    J.setZero();
    if (body.moves) {
      const element::BodyState<double> b = element::read_body(in);
      Matrix6 by_pose = Matrix6::Zero();
      const hull::Loads l = loads(body, t, pose_of(b), &by_pose);
      J.leftCols<6>() =
          tangent_gradient(b.R, tangent_load(b.R, l.hydrostatic + l.dynamic), by_pose);
    }
    in += element::body_numbers;
    jacobian += J.size();
  }
}

void HullList::energy(const double* in, const double*, double* joules) const {
  for (const Body& body : bodies_) {
    *joules++ = potential(body, pose_of(element::read_body(in))) - body.energy_of_reference;
    in += element::body_numbers;
  }
}

void HullList::report(double t, const double* in, const double*, double* out) const {
  for (const Body& body : bodies_) {
    const element::BodyState<double> b = element::read_body(in);
    const hull::Loads l = loads(body, t, pose_of(b));
    const auto put = [&](const Vector6& wrench) {
      Eigen::Map<Vector6> load(out);
      load = tangent_load(b.R, wrench);
      out += 6;
    };
    put(l.hydrostatic + l.dynamic);
    if (!parts.empty()) {
      put(l.hydrostatic);
      put(l.dynamic);
    }
    in += element::body_numbers;
  }
}

element::WavesFelt HullList::waves() const {
  const auto n = static_cast<Index>(waves_.size());
  element::WavesFelt out{VectorX(n), VectorX(n), {}};
  for (Index i = 0; i < n; ++i) {
    out.omega[i] = waves_[static_cast<std::size_t>(i)].omega;
    out.amplitude[i] = waves_[static_cast<std::size_t>(i)].amplitude;
  }
  return out;
}

double HullList::elevation(double t) const {
  double sum = 0.0;
  for (const hull::Wave& w : waves_)
    sum += w.amplitude * std::cos(w.omega * t + w.phase);
  return sea::ramp(t, ramp_time_) * sum;
}

std::shared_ptr<HullList> HullList::with(std::vector<hull::Wave> waves, double ramp_time) const {
  auto out = std::make_shared<HullList>(water_, std::move(waves), ramp_time);
  out->type = type;
  out->parts = parts;
  for (const Body& body : bodies_)
    out->add(body.name, body.mesh, body.reference, body.moves);
  return out;
}

std::shared_ptr<const element::Elements> HullList::calm() const { return with({}, 0.0); }

std::shared_ptr<const element::Elements>
HullList::stirred(const std::function<double()>& draw) const {
  std::vector<hull::Wave> waves = waves_;
  for (hull::Wave& w : waves)
    w.phase = pi * draw();
  return with(std::move(waves), 0.0);
}

} // namespace hydrodae::water
