#include "hydrodae/element/excitation.h"

#include <algorithm>
#include <utility>

#include "hydrodae/element/hydro_axes_gradient.h"

namespace hydrodae::element {

namespace {

constexpr double noise = 1e-5; ///< of the largest: what the symmetry of a body leaves in its tables

/// Memory for n numbers; allocates nothing after a first call.
VectorX& functions_memory(Index n) {
  thread_local VectorX memory;
  if (memory.size() < n)
    memory.resize(n);
  return memory;
}

/// f along the hydrodynamic axes as a load on the body. In mean axes R is all that it takes.
template <class S> Vec6<S> on_body(HydroAxes axes, const HydroBody& hb, const S* in, Vec6<S> f) {
  if (axes != HydroAxes::mean) {
    const Vec6<S> no_momentum = Vec6<S>::Zero();
    return hydro_load<S>(axes, hb, read_body(in), f, no_momentum);
  }
  if (hb.turned)
    turn_by_mean_yaw<S>(hb, false, f);
  const Vec3<S> moment = f.template tail<3>();
  f.template tail<3>() = Eigen::Map<const Mat3<S>>(in + 3).transpose() * moment;
  return f;
}

} // namespace

Excitation::Excitation(HydroAxes axes, std::vector<Body> bodies, int n_moving, bool split)
    : axes_(axes), bodies_(std::move(bodies)), n_moving_(n_moving) {
  type = "excitation";
  shape.port = Port::in_water;
  shape.feels_rates = false;
  work = Work::lent;
  if (split)
    parts = {"froude_krylov", "diffraction"};
  for (const Body& b : bodies_)
    names.push_back(b.name);
}

void Excitation::turn(const std::vector<HydroBody>& bodies) {
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    bodies_[k].wet = bodies[k];
}

/// What acts along the coordinates of U; `f`: the functions of time, where these are fixed.
template <class S>
Vec6<S> Excitation::force(double t, const Body& body, const S* in, const double* f) const {
  const HydroBody& hb = body.wet;
  Vec6<S> out = Vec6<S>::Zero(), drifting;
  if (!drifting_.empty()) {
    const S x = in[0] - S(body.reference[0]), y = in[1] - S(body.reference[1]);
    drifting_(t, x, y, hb.first_moving(), hb.n_moving(), drifting.data());
  }
  for (int c = 0; c < 6; ++c)
    if (hb.moving[c] >= 0)
      out[c] = drifting_.empty() ? S(f[hb.moving[c]]) : drifting[hb.moving[c] - hb.first_moving()];
  return out;
}

template <class S> void Excitation::loads(double t, const S* in, S* out) const {
  VectorX& f = functions_memory(n_moving_);
  if (!fixed_.empty())
    fixed_(t, f.head(n_moving_));
  for (const Body& body : bodies_) {
    Eigen::Map<Vec6<S>> load(out);
    load.setZero();
    if (body.wet.moves && count() > 0)
      load = on_body<S>(axes_, body.wet, in, force<S>(t, body, in, f.data()));
    in += body_numbers;
    out += 6;
  }
}

void Excitation::evaluate(double t, const double* in, const double*, double* out) const {
  loads(t, in, out);
}

void Excitation::evaluate(double t, const Dual* in, const double*, Dual* out) const {
  loads(t, in, out);
}

void Excitation::jacobian(double t, const double* in, const double*, double* jacobian) const {
  VectorX& f = functions_memory(n_moving_);
  if (!fixed_.empty())
    fixed_(t, f.head(n_moving_));
  for (const Body& body : bodies_) {
    const HydroBody& hb = body.wet;
    Eigen::Map<Eigen::Matrix<double, 6, 18>> J(jacobian);
    J.setZero();
    if (hb.moves && count() > 0) {
      const BodyState<double> b = read_body(in);
      const Vector6 along = force<double>(t, body, in, f.data()), still = Vector6::Zero();
      const HydroLoadGradient d = hydro_load_gradient(axes_, hb, b, along, still);
      J.middleCols<3>(3) = d.by_rotation;
      if (!drifting_.empty()) {
        Vector6 value, by_x, by_y; // of the coordinates that move
        Eigen::Matrix<double, 6, 2> by_place = Eigen::Matrix<double, 6, 2>::Zero();
        drifting_(t, in[0] - body.reference[0], in[1] - body.reference[1], hb.first_moving(),
                  hb.n_moving(), value.data(), by_x.data(), by_y.data());
        for (int c = 0; c < 6; ++c)
          if (const int k = hb.moving[c] - hb.first_moving(); hb.moving[c] >= 0)
            by_place.row(c) << by_x[k], by_y[k];
        J.leftCols<2>() = d.L * by_place;
      }
    }
    in += body_numbers;
    jacobian += J.size();
  }
}

void Excitation::energy(const double*, const double*, double* joules) const {
  std::fill_n(joules, size(), 0.0);
}

void Excitation::report(double t, const double* in, const double*, double* loads) const {
  const auto n_loads = static_cast<Index>(1 + parts.size()),
             all = 6 * static_cast<Index>(bodies_.size());
  VectorX& f = functions_memory(count());
  if (!fixed_.empty())
    fixed_(t, f.head(count()));
  if (count() == 0) {
    std::fill_n(loads, all * n_loads, 0.0);
    return;
  }
  Index row = n_moving_;
  for (const Body& body : bodies_) {
    if (!drifting_.empty())
      for (Index first = row; first < count() - 1; first += all)
        drifting_(t, in[0] - body.reference[0], in[1] - body.reference[1], first, 6,
                  f.data() + first);
    const auto put = [&](const Vector6& force) {
      Eigen::Map<Vector6> load(loads);
      load = on_body<double>(axes_, body.wet, in, force);
      loads += 6;
    };
    put(f.segment<6>(row));
    if (!parts.empty()) {
      put(f.segment<6>(row + all));
      put(f.segment<6>(row) - f.segment<6>(row + all));
    }
    row += 6;
    in += body_numbers;
  }
}

WavesFelt Excitation::waves() const {
  WavesFelt out;
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
  for (Index k = 0; k < static_cast<Index>(bodies_.size()); ++k)
    out.loads.emplace_back(C.middleRows<6>(n_moving_ + 6 * k).cwiseAbs2().cwiseSqrt());
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

std::shared_ptr<const Elements> Excitation::calm() const {
  auto out = std::make_shared<Excitation>(*this);
  out->fixed_ = sea::Signals();
  out->drifting_ = sea::DriftingSignals();
  return out;
}

/// Least excitation of each function that is no noise of the tables: by the largest force on the
/// body and, of moments, its length or the largest moment.
VectorX Excitation::least(const VectorX& largest) const {
  VectorX out = VectorX::Zero(largest.size());
  for (const Body& body : bodies_) {
    double force = 0.0, moment = 0.0;
    for (int c = 0; c < 6; ++c)
      if (const int u = body.wet.moving[c]; u >= 0)
        (c < 3 ? force : moment) = std::max(c < 3 ? force : moment, largest[u]);
    for (int c = 0; c < 6; ++c)
      if (const int u = body.wet.moving[c]; u >= 0)
        out[u] = noise * (c < 3 ? std::max(force, moment / body.length)
                                : std::max(moment, force * body.length));
  }
  return out;
}

std::shared_ptr<const Elements> Excitation::stirred(const std::function<double()>& draw) const {
  auto out = std::make_shared<Excitation>(*this);
  const auto stir = [&](const auto& given, auto& stirred) {
    if (given.empty())
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

} // namespace hydrodae::element
