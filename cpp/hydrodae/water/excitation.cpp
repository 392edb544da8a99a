#include "hydrodae/water/excitation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::water {

namespace {

constexpr double slack = 1e-4; ///< tolerance of headings beyond the table (headings.h) [rad]
/// Asymmetry of tables of a symmetric body, as part of the largest value
constexpr double noise = 1e-5;

/// Memory for n numbers; allocates nothing after a first call.
VectorX& functions_memory(Index n) {
  thread_local VectorX memory;
  if (memory.size() < n)
    memory.resize(n);
  return memory;
}

template <class S> S* drifting_memory(Index n) {
  thread_local std::vector<S> memory;
  if (std::ssize(memory) < n)
    memory.resize(static_cast<std::size_t>(n));
  return memory.data();
}

/// Load on the body from f along the hydrodynamic axes; mean axes need only R. The amplitude of a
/// mode has no axes.
template <class S>
Vec6<S> on_body(HydroAxes axes, const Excitation::Body& body, const S* in, Vec6<S> f) {
  const HydroBody& hb = body.wet;
  if (body.mode)
    return f;
  if (axes != HydroAxes::mean) {
    const Vec6<S> no_momentum = Vec6<S>::Zero();
    return hydro_load<S>(axes, hb, element::read_body(in), f, no_momentum);
  }
  if (hb.turned)
    turn_by_mean_yaw<S>(hb, false, f);
  const Vec3<S> moment = f.template tail<3>();
  f.template tail<3>() = Eigen::Map<const Mat3<S>>(in + 3).transpose() * moment;
  return f;
}

} // namespace

Excitation::Excitation(HydroAxes axes, std::vector<Body> bodies, bool split)
    : axes_(axes), bodies_(std::move(bodies)) {
  type = "excitation";
  shape.port = element::Port::in_water;
  shape.feels_rates = false;
  work = element::Work::lent;
  if (split)
    parts = {"froude_krylov", "diffraction"};
  for (const Body& b : bodies_) {
    names.push_back(b.name);
    n_moving_ += b.moving.count();
  }
}

void Excitation::turn(const std::vector<HydroBody>& bodies) {
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    bodies_[k].wet = bodies[k];
}

/// Factors b_m and w_m at the pose of the body.
template <class S> void Excitation::factors(const Body& body, const S* in, Factors<S>& b) const {
  b.yaw[0] = b.pose[0] = S(1);
  if (body.yaw.count > 1) {
    const Mat3<S> H = yaw<S>(element::read_body(in)).H;
    body.yaw.values(H(0, 0), H(1, 0), b.yaw);
  }
  if (body.poses.weights.size() > 0)
    body.poses.weights.values(body.poses.at(element::read_body(in)).value, b.pose.data(),
                              b.pose_slopes.data());
}

/// Load of a set of terms along the hydrodynamic axes; `f`: functions of time, if fixed.
template <class S>
Vec6<S> Excitation::force(double t, const Body& body, const Terms& terms, const S* in,
                          const Factors<S>& b, const double* f) const {
  Vec6<S> out = Vec6<S>::Zero();
  const auto add = [&](const auto* functions) {
    for (const Term& term : terms.list)
      out[term.coordinate] += b(term) * S(*functions++);
  };
  if (drifting_.empty()) {
    add(f + terms.first);
  } else {
    S* drifting = drifting_memory<S>(terms.count());
    const S x = in[0] - S(body.reference[0]), y = in[1] - S(body.reference[1]);
    drifting_(t, x, y, terms.first, terms.count(), drifting);
    add(drifting);
  }
  return out;
}

template <class S> void Excitation::loads(double t, const S* in, S* out) const {
  VectorX& f = functions_memory(n_moving_);
  if (!fixed_.empty())
    fixed_(t, f.head(n_moving_));
  Factors<S> b;
  for (const Body& body : bodies_) {
    Eigen::Map<Vec6<S>> load(out);
    load.setZero();
    if (body.wet.moves && count() > 0) {
      factors(body, in, b);
      load = on_body<S>(axes_, body, in, force<S>(t, body, body.moving, in, b, f.data()));
    }
    in += element::body_numbers;
    out += 6;
  }
}

void Excitation::evaluate(double t, const double* in, const double*, double* out) const {
  loads(t, in, out);
}

void Excitation::evaluate(double t, const Dual* in, const double*, Dual* out) const {
  loads(t, in, out);
}

/// Derivative of the load by the place (x, y) of a body whose waves move with it, along the
/// hydrodynamic axes.
Eigen::Matrix<double, 6, 2> Excitation::by_place(double t, const Body& body, const double* in,
                                                 const Factors<double>& b) const {
  const Index n = body.moving.count();
  double* by_x = drifting_memory<double>(2 * n);
  double* by_y = by_x + n;
  drifting_.slopes(t, in[0] - body.reference[0], in[1] - body.reference[1], body.moving.first, n,
                   by_x, by_y);
  Eigen::Matrix<double, 6, 2> out = Eigen::Matrix<double, 6, 2>::Zero();
  for (const Term& term : body.moving.list) {
    const double factor = b(term);
    out(term.coordinate, 0) += factor * *by_x++;
    out(term.coordinate, 1) += factor * *by_y++;
  }
  return out;
}

void Excitation::jacobian(double t, const double* in, const double*, double* jacobian) const {
  VectorX& f = functions_memory(n_moving_);
  if (!fixed_.empty())
    fixed_(t, f.head(n_moving_));
  Factors<double> b;
  for (const Body& body : bodies_) {
    Eigen::Map<Eigen::Matrix<double, 6, 18>> J(jacobian);
    J.setZero();
    if (body.wet.moves && count() > 0) {
      const element::BodyState<double> state = element::read_body(in);
      factors(body, in, b);
      const Vector6 along = force<double>(t, body, body.moving, in, b, f.data()),
                    still = Vector6::Zero();
      HydroLoadGradient d = hydro_load_gradient(axes_, body.wet, state, along, still);
      if (body.mode) {
        d.L = Matrix6::Identity();
        d.by_rotation.setZero();
      }
      J.middleCols<3>(3) = d.by_rotation;
      if (body.yaw.count > 1) {
        const Yaw<double> psi = yaw<double>(state);
        Factors<double> by_yaw = b;
        body.yaw.slopes(psi.H(0, 0), psi.H(1, 0), by_yaw.yaw);
        J.middleCols<3>(3) +=
            d.L * force<double>(t, body, body.moving, in, by_yaw, f.data()) * psi.s.transpose();
      }
      if (body.poses.weights.size() > 0) {
        Factors<double> by_pose = b;
        by_pose.pose = b.pose_slopes;
        J.leftCols<6>() += d.L * force<double>(t, body, body.moving, in, by_pose, f.data()) *
                           body.poses.at(state).gradient.transpose();
      }
      if (!drifting_.empty())
        J.leftCols<2>() += d.L * by_place(t, body, in, b);
    }
    in += element::body_numbers;
    jacobian += J.size();
  }
}

void Excitation::energy(const double*, const double*, double* joules) const {
  std::fill_n(joules, size(), 0.0);
}

void Excitation::check_yaw(double t, const Body& body, const double* in) const {
  constexpr double degrees = 180.0 / pi;
  const YawFunctions& reach = body.yaw;
  if (reach.round || !std::isfinite(reach.half))
    return;
  const Mat3<double> H = yaw<double>(element::read_body(in)).H;
  const double psi = std::atan2(H(1, 0), H(0, 0));
  if (!(reach.outside(psi) > slack))
    return;
  const auto text = [](double angle) { return rounded_text(angle * degrees, 4); };
  throw SolverError(
      t, {Reason::range,
          "body " + in_quotes(body.name) + " has turned to a yaw of " + text(psi) +
              " deg; with axes = \"yaw\" the headings of the database, less those of the waves, "
              "cover " +
              text(reach.middle - reach.half) + " to " + text(reach.middle + reach.half) +
              " deg alone",
          "bodies/" + body.name,
          {{"yaw_deg", psi * degrees}},
          "compute it with headings all round, or use axes = \"mean\"",
          ""});
}

void Excitation::report(double t, const double* in, const double*, double* loads) const {
  VectorX& f = functions_memory(count());
  if (!fixed_.empty())
    fixed_(t, f.head(count()));
  if (count() == 0) {
    std::fill_n(loads, 6 * bodies_.size() * (1 + parts.size()), 0.0);
    return;
  }
  Factors<double> b;
  for (const Body& body : bodies_) {
    check_yaw(t, body, in);
    factors(body, in, b);
    const auto sum = [&](const Terms& terms) {
      return force<double>(t, body, terms, in, b, f.data());
    };
    const auto put = [&](const Vector6& along) {
      Eigen::Map<Vector6> load(loads);
      load = on_body<double>(axes_, body, in, along);
      loads += 6;
    };
    const Vector6 total = sum(body.moving) + sum(body.still);
    put(total);
    if (!parts.empty()) {
      const Vector6 part = sum(body.froude_krylov);
      put(part);
      put(total - part);
    }
    in += element::body_numbers;
  }
}

element::WavesFelt Excitation::waves() const {
  element::WavesFelt out;
  if (count() == 0)
    return out;
  const Eigen::MatrixXcd& C = drifting_.empty() ? fixed_.coefficients() : drifting_.coefficients();
  out.omega = fixed_.omega();
  if (!drifting_.empty()) {
    out.omega.resize(C.cols());
    for (Index i = 0; i < C.cols(); ++i)
      out.omega[i] = drifting_.waves()[static_cast<std::size_t>(i)].omega;
  }
  out.amplitude = C.row(C.rows() - 1).cwiseAbs2().cwiseSqrt().transpose();
  Factors<double> b;
  for (const Body& body : bodies_) {
    body.yaw.values(body.wet.cos_yaw, body.wet.sin_yaw, b.yaw);
    b.pose[0] = 1.0;
    if (body.poses.weights.size() > 0) // weights in the reference pose
      body.poses.weights.values(0.0, b.pose.data(), b.pose_slopes.data());
    Eigen::MatrixXcd load = Eigen::MatrixXcd::Zero(6, C.cols());
    for (const Terms* terms : {&body.moving, &body.still})
      for (Index k = 0; k < terms->count(); ++k) {
        const Term& term = terms->list[static_cast<std::size_t>(k)];
        load.row(term.coordinate) += b(term) * C.row(terms->first + k);
      }
    out.loads.emplace_back(load.cwiseAbs());
  }
  return out;
}

double Excitation::elevation(double t) const {
  double eta = 0.0;
  if (!drifting_.empty())
    drifting_(t, 0.0, 0.0, count() - 1, 1, &eta);
  if (fixed_.empty())
    return eta;
  VectorX& f = functions_memory(count());
  fixed_(t, f.head(count()));
  return f[count() - 1];
}

std::shared_ptr<const element::Elements> Excitation::unreported() const {
  if (fixed_.empty() || !drifting_.empty())
    return nullptr;
  auto out = std::make_shared<Excitation>(*this);
  out->fixed_ = fixed_.first_and_last(n_moving_);
  for (Body& body : out->bodies_)
    body.still = body.froude_krylov = {};
  return out;
}

std::shared_ptr<const element::Elements> Excitation::calm() const {
  auto out = std::make_shared<Excitation>(*this);
  out->fixed_ = sea::Signals();
  out->drifting_ = sea::DriftingSignals();
  return out;
}

/// Least amplitude of each function that is above the noise of the tables: relative to the largest
/// force on the body; for moments, to that times its length, or to the largest moment.
VectorX Excitation::least(const VectorX& largest) const {
  VectorX out = VectorX::Zero(largest.size());
  for (const Body& body : bodies_) {
    const Terms& terms = body.moving;
    double force = 0.0, moment = 0.0;
    for (Index k = 0; k < terms.count(); ++k) {
      double& most = terms.list[static_cast<std::size_t>(k)].coordinate < 3 ? force : moment;
      most = std::max(most, largest[terms.first + k]);
    }
    for (Index k = 0; k < terms.count(); ++k)
      out[terms.first + k] = noise * (terms.list[static_cast<std::size_t>(k)].coordinate < 3
                                          ? std::max(force, moment / body.length)
                                          : std::max(moment, force * body.length));
  }
  return out;
}

std::shared_ptr<const element::Elements>
Excitation::stirred(const std::function<double()>& draw) const {
  auto out = std::make_shared<Excitation>(*this);
  const auto stir = [&](const auto& given, auto& stirred) {
    if (given.empty() || given.components() == 0) // waves without height
      return;
    VectorX theta(given.components());
    for (double& angle : theta)
      angle = pi * draw();
    stirred = given.frozen(theta, least(given.largest()));
  };
  stir(fixed_, out->fixed_);
  stir(drifting_, out->drifting_);
  return out;
}

} // namespace hydrodae::water
