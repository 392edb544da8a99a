#include "hydrodae/water/slow_drift.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::water {

namespace {

constexpr double yaw_slack = 1e-4; ///< by which headings may lie off the table (headings.h) [rad]

/// Memory for n numbers; allocates nothing after a first call. `which`: of two that are held at a
/// time.
template <int which, class S> S* drift_memory(Index n) {
  thread_local std::vector<S> memory;
  if (std::ssize(memory) < n)
    memory.resize(static_cast<std::size_t>(n));
  return memory.data();
}

template <int which> const double* fixed_values(const SlowDrift::Functions& functions, double t) {
  double* out = drift_memory<which, double>(functions.fixed.size());
  if (!functions.fixed.empty())
    functions.fixed(t, out);
  return out;
}

template <class S>
void yaw_values(const SlowDrift::Body& body, const S* in, YawFunctions::Values<S>& b) {
  b[0] = S(1);
  if (body.yaw.count > 1) {
    const Mat3<S> H = yaw<S>(element::read_body(in)).H;
    body.yaw.values(H(0, 0), H(1, 0), b);
  }
}

template <class S>
Vec6<S> load_on_body(HydroAxes axes, const HydroBody& hb, const S* in, const Vec6<S>& along) {
  const Vec6<S> no_momentum = Vec6<S>::Zero();
  return hydro_load<S>(axes, hb, element::read_body(in), along, no_momentum);
}

} // namespace

SlowDrift::SlowDrift(HydroAxes axes, std::vector<Body> bodies,
                     const std::vector<std::string>& loads)
    : axes_(axes), bodies_(std::move(bodies)) {
  type = "second_order";
  shape.port = element::Port::in_water;
  shape.feels_rates = false;
  work = element::Work::lent;
  if (loads.size() > 1)
    for (const std::string& load : loads)
      for (const std::string_view known : {"mean", "newman", "difference", "sum"})
        if (known == load)
          parts.push_back(known);
  for (const Body& b : bodies_)
    names.push_back(b.name);
}

void SlowDrift::set(Functions moving, Functions still) {
  moving_ = std::move(moving);
  still_ = std::move(still);
}

/// What some terms make along the hydrodynamic axes; of one load of the case, or of all (-1).
template <class S>
Vec6<S> SlowDrift::force(double t, const Body& body, const Terms& terms, const Functions& functions,
                         const double* fixed, const S* in, const YawFunctions::Values<S>& b,
                         int load) const {
  Vec6<S> out = Vec6<S>::Zero();
  const auto add = [&](const auto* f) {
    for (const Term& term : terms.list) {
      if (load < 0 || load == term.load)
        out[term.coordinate] += b[static_cast<std::size_t>(term.m)] * S(*f);
      ++f;
    }
  };
  if (terms.list.empty() || functions.empty())
    return out;
  if (functions.drifting.empty()) {
    add(fixed + terms.first);
  } else {
    S* values = drift_memory<2, S>(terms.count());
    const S x = in[0] - S(body.reference[0]), y = in[1] - S(body.reference[1]);
    functions.drifting(t, x, y, terms.first, terms.count(), values);
    add(values);
  }
  return out;
}

template <class S> void SlowDrift::loads(double t, const S* in, S* out) const {
  const double* fixed = fixed_values<0>(moving_, t);
  YawFunctions::Values<S> b;
  for (const Body& body : bodies_) {
    Eigen::Map<Vec6<S>> load(out);
    load.setZero();
    if (body.wet.moves && !moving_.empty()) {
      yaw_values(body, in, b);
      load = load_on_body<S>(axes_, body.wet, in,
                             force<S>(t, body, body.moving, moving_, fixed, in, b));
    }
    in += element::body_numbers;
    out += 6;
  }
}

void SlowDrift::evaluate(double t, const double* in, const double*, double* out) const {
  loads(t, in, out);
}

void SlowDrift::evaluate(double t, const Dual* in, const double*, Dual* out) const {
  loads(t, in, out);
}

void SlowDrift::jacobian(double t, const double* in, const double*, double* jacobian) const {
  const double* fixed = fixed_values<0>(moving_, t);
  YawFunctions::Values<double> b;
  for (const Body& body : bodies_) {
    Eigen::Map<Eigen::Matrix<double, 6, 18>> J(jacobian);
    J.setZero();
    if (body.wet.moves && !moving_.empty()) {
      const element::BodyState<double> state = element::read_body(in);
      yaw_values(body, in, b);
      const Vector6 along = force<double>(t, body, body.moving, moving_, fixed, in, b),
                    still = Vector6::Zero();
      const HydroLoadGradient d = hydro_load_gradient(axes_, body.wet, state, along, still);
      J.middleCols<3>(3) = d.by_rotation;
      if (body.yaw.count > 1) {
        const Yaw<double> psi = yaw<double>(state);
        YawFunctions::Values<double> slopes;
        body.yaw.slopes(psi.H(0, 0), psi.H(1, 0), slopes);
        J.middleCols<3>(3) += d.L *
                              force<double>(t, body, body.moving, moving_, fixed, in, slopes) *
                              psi.s.transpose();
      }
      if (const Index n = body.moving.count(); !moving_.drifting.empty() && n > 0) {
        double* by_x = drift_memory<3, double>(2 * n);
        double* by_y = by_x + n;
        moving_.drifting.slopes(t, in[0] - body.reference[0], in[1] - body.reference[1],
                                body.moving.first, n, by_x, by_y);
        Eigen::Matrix<double, 6, 2> by_place = Eigen::Matrix<double, 6, 2>::Zero();
        for (const Term& term : body.moving.list) {
          by_place(term.coordinate, 0) += b[static_cast<std::size_t>(term.m)] * *by_x++;
          by_place(term.coordinate, 1) += b[static_cast<std::size_t>(term.m)] * *by_y++;
        }
        J.leftCols<2>() += d.L * by_place;
      }
    }
    in += element::body_numbers;
    jacobian += J.size();
  }
}

void SlowDrift::energy(const double*, const double*, double* joules) const {
  std::fill_n(joules, size(), 0.0);
}

void SlowDrift::check_yaw(double t, const Body& body, const double* in) const {
  const YawFunctions& reach = body.yaw;
  if (reach.round || !std::isfinite(reach.half))
    return;
  const Mat3<double> H = yaw<double>(element::read_body(in)).H;
  const double psi = std::atan2(H(1, 0), H(0, 0));
  if (!(reach.outside(psi) > yaw_slack))
    return;
  const auto text = [](double angle) { return rounded_text(angle * 180.0 / pi, 4); };
  throw SolverError(
      t, {Reason::range,
          "body " + in_quotes(body.name) + " has turned to a yaw of " + text(psi) +
              " deg; with axes = \"yaw\" the headings of its table of second order, less those of "
              "the waves, cover " +
              text(reach.middle - reach.half) + " to " + text(reach.middle + reach.half) +
              " deg alone",
          "bodies/" + body.name,
          {{"yaw_deg", psi * 180.0 / pi}},
          "import a table with headings all round, or use axes = \"mean\"",
          ""});
}

void SlowDrift::report(double t, const double* in, const double*, double* loads) const {
  const double* fixed = fixed_values<0>(moving_, t);
  const double* others = fixed_values<1>(still_, t);
  YawFunctions::Values<double> b;
  for (const Body& body : bodies_) {
    if (!moving_.empty() || !still_.empty())
      check_yaw(t, body, in);
    yaw_values(body, in, b);
    for (int part = -1; part < static_cast<int>(parts.size()); ++part) {
      const Vector6 along = force<double>(t, body, body.moving, moving_, fixed, in, b, part) +
                            force<double>(t, body, body.still, still_, others, in, b, part);
      Eigen::Map<Vector6> load(loads);
      load = load_on_body<double>(axes_, body.wet, in, along);
      loads += 6;
    }
    in += element::body_numbers;
  }
}

std::shared_ptr<const element::Elements> SlowDrift::unreported() const {
  if (still_.empty())
    return nullptr;
  auto out = std::make_shared<SlowDrift>(*this);
  out->still_ = {};
  for (Body& body : out->bodies_)
    body.still = {};
  return out;
}

std::shared_ptr<const element::Elements> SlowDrift::calm() const {
  auto out = std::make_shared<SlowDrift>(*this);
  out->moving_ = out->still_ = {};
  return out;
}

} // namespace hydrodae::water
