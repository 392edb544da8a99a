#include "hydrodae/linalg/pressed_friction.h"

#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"

namespace hydrodae::linalg {

namespace {

constexpr int most_balance_steps = 60;
constexpr double load_balanced = 1e-13; ///< accuracy of the balance, as part of the largest load
/// Accuracy accepted if the error gets no smaller, as part of the largest load
constexpr double load_rounded = 1e-10;

} // namespace

std::unique_ptr<SaddlePoint::Pressed> SaddlePoint::Pressed::find(const system::Regime& s) {
  std::vector<Law> laws;
  for (std::size_t i = 0; i < s.elements.size(); ++i)
    if (s.elements[i].laws->shape.n_reaction > 0)
      for (std::size_t k = 0; k < s.elements[i].ports.size(); ++k)
        laws.push_back({i, k});
  if (laws.empty())
    return nullptr;
  auto out = std::make_unique<Pressed>(s);
  const auto n = static_cast<Index>(laws.size());
  out->laws = std::move(laws);
  out->columns.resize(s.n_u + s.n_lambda, n);
  out->sensitivity.resize(6 * n, n);
  out->slope.resize(n, 6);
  out->newton.resize(n, n);
  out->start = out->reaction = VectorX::Zero(6 * n);
  out->load = out->at_rest = out->answer = out->gap = out->step = VectorX::Zero(n);
  return out;
}

void SaddlePoint::Pressed::add_along(const system::Regime& s, std::size_t k, double size,
                                     VectorX& rows) const {
  const joint::Vector12& row = ws.state.elements[laws[k].list].rows[laws[k].law];
  const system::JointData& j = s.joints[static_cast<std::size_t>(port(s, k).joint)];
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
    for (int c = 0; c < b.n_active; ++c)
      rows[b.u0 - s.u0 + c] += size * row[6 * side + b.active[static_cast<std::size_t>(c)]];
  }
}

void SaddlePoint::Pressed::see(const system::Regime& s, std::size_t k, const double* solution,
                               double* out) const {
  const system::JointData& j = s.joints[static_cast<std::size_t>(port(s, k).joint)];
  Eigen::Map<Vector6> sum(out);
  sum.setZero();
  for (const system::PortData::Pressing& p : port(s, k).reaction)
    sum -= p.on_b * solution[s.n_u + s.lambda(j.rows[p.row]) - s.lambda0];
}

void SaddlePoint::Pressed::evaluate(const system::Regime& s, double t, VectorX& f) {
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const element::Shape& shape = list(s, k).laws->shape;
    double* in = ws.state.elements[laws[k].list].in.data() +
                 laws[k].law * static_cast<std::size_t>(shape.n_in());
    std::copy_n(reaction.data() + 6 * k, 6, in + 2 * shape.width);
  }
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const system::ElementList& own = list(s, k);
    const element::Shape& shape = own.laws->shape;
    system::ElementScratch<double>& scratch = ws.state.elements[laws[k].list];
    if (laws[k].law == 0) { // once for each list
      own.laws->evaluate(t, scratch.in.data(), s.held(own), scratch.out.data());
      own.laws->jacobian(t, scratch.in.data(), s.held(own), ws.element_jacobian.data());
    }
    const std::size_t size = static_cast<std::size_t>(shape.n_out() * shape.n_columns());
    const Eigen::Map<const MatrixX> J(ws.element_jacobian.data() + laws[k].law * size,
                                      shape.n_out(), shape.n_columns());
    f[static_cast<Index>(k)] = scratch.out[laws[k].law * static_cast<std::size_t>(shape.n_out())];
    slope.row(static_cast<Index>(k)) = J.row(0).segment<6>(2 * shape.width);
  }
}

bool SaddlePoint::Pressed::balance(const system::Regime& s, double t) {
  const auto n = static_cast<Index>(laws.size());
  reaction.setZero();
  evaluate(s, t, at_rest);
  load = at_rest;
  double before = INFINITY, part = 1.0; // part of the step that is taken
  for (int i = 0; i < most_balance_steps; ++i) {
    reaction = start;
    for (Index m = 0; m < n; ++m)
      reaction += sensitivity.col(m) * (load[m] - at_rest[m]);
    evaluate(s, t, answer);
    gap = load - answer;
    const double size = gap.cwiseAbs().maxCoeff(), whole = answer.cwiseAbs().maxCoeff();
    if (!std::isfinite(size))
      return false;
    if (size <= load_balanced * whole ||
        (i > 3 && size >= 0.5 * before && size <= load_rounded * whole))
      return true;
    if (size > before && part > 1e-3) { // step is too long
      part *= 0.5;
      load -= part * step;
      continue;
    }
    before = size;
    part = 1.0;
    for (Index k = 0; k < n; ++k)
      for (Index m = 0; m < n; ++m)
        newton(k, m) =
            (k == m ? 1.0 : 0.0) - slope.row(k).dot(sensitivity.col(m).segment<6>(6 * k));
    step = solve_square(newton, -gap);
    load += step;
  }
  return false;
}

std::string SaddlePoint::Pressed::jam(const system::Regime& s) const {
  std::string out;
  double worst = 1.0;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const system::PortData& own = port(s, k);
    element::Bearing bare = *own.bearing; // bearing load N of a unit friction load
    bare.preload = bare.small = 0.0;
    const auto i = static_cast<Index>(k);
    const double pressing = bare.load(sensitivity.col(i).data() + 6 * i);
    std::array<Dual, 6> r; // slope of N along the reaction, close to N itself
    for (std::size_t c = 0; c < 6; ++c)
      r[c] = Dual(reaction[6 * i + static_cast<Index>(c)], reaction[6 * i + static_cast<Index>(c)]);
    const double grows = own.bearing->load(r.data()).b;
    if (!(grows > 0.0))
      continue;
    const double coefficient = std::abs(slope.row(i).dot(reaction.segment<6>(6 * i)) / grows);
    if (!(coefficient * pressing >= worst))
      continue;
    worst = coefficient * pressing;
    const std::string joint = in_quotes(s.joints[static_cast<std::size_t>(own.joint)].name);
    out =
        "friction " + in_quotes(own.component) + " jams joint " + joint + ": its coefficient " +
        rounded_text(coefficient, 4) + " is not below " + rounded_text(1.0 / pressing, 4) +
        ", from which on friction presses the joint by as much as it takes, so that no motion "
        "or more than one follows. Lower the coefficient, or place the bearing better (longer, or "
        "nearer to the line of the load)";
  }
  return out;
}

/// Adds the friction loads of bearings to x_, and sets the rates of their states. Returns false if
/// there are no such loads.
bool SaddlePoint::press(double t, const VectorX& y, VectorX& yp) {
  Pressed& p = *pressed_;
  p.rhs = rhs_;
  p.x = x_;
  system::unpack<double>(s_, y.data(), yp.data(), p.ws.state.bodies);
  p.ws.state.time = t;
  p.ws.state.past = system::past_at(s_, t);
  for (std::size_t k = 0; k < p.laws.size(); ++k) {
    if (p.laws[k].law == 0)
      system::gather<double>(s_, p.list(s_, k), p.ws.state, y.data(),
                             p.ws.state.elements[p.laws[k].list]);
    rhs_.setZero();
    p.add_along(s_, k, 1.0, rhs_);
    matrix_.solve(rhs_, x_);
    p.columns.col(static_cast<Index>(k)) = x_;
  }
  for (std::size_t k = 0; k < p.laws.size(); ++k) {
    p.see(s_, k, p.x.data(), p.start.data() + 6 * k);
    for (Index m = 0; m < p.columns.cols(); ++m)
      p.see(s_, k, p.columns.col(m).data(), p.sensitivity.col(m).data() + 6 * k);
  }
  const bool found = p.balance(s_, t);
  jam_ = p.jam(s_);
  rhs_ = p.rhs;
  x_ = p.x;
  for (std::size_t k = 0; k < p.laws.size(); ++k) {
    const auto i = static_cast<Index>(k);
    const double more = p.load[i] - p.at_rest[i]; // the residual already contains the loads at rest
    p.add_along(s_, k, more, rhs_);
    x_ += more * p.columns.col(i);
    const element::Shape& shape = p.list(s_, k).laws->shape;
    const std::size_t own = p.laws[k].law;
    const double* out = p.ws.state.elements[p.laws[k].list].out.data() +
                        own * static_cast<std::size_t>(shape.n_out());
    for (int z = 0; z < shape.n_states; ++z)
      yp[p.list(s_, k).z0 + static_cast<Index>(own) * shape.n_states + z] = out[shape.width + z];
  }
  return found;
}

} // namespace hydrodae::linalg
