#include "hydrodae/linalg/newton_matrix.h"

#include <algorithm>

namespace hydrodae::linalg {

using system::BodyData;
using system::HydroBody;
using Rung = water::ExponentialRadiation;

template <class Scalar>
NewtonMatrix<Scalar>::NewtonMatrix(const system::Regime& s, const system::Pattern& pattern)
    : s_(s), rung_(s.hydro.as<Rung>()), points_(s, pattern), lu_(points_.start, points_.row),
      lifted_(points_.lifted.size()), stays_(points_.empty() ? 0 : points_.n),
      n_of_positions_(
          static_cast<std::size_t>(pattern.column_start[static_cast<std::size_t>(s.n_q)])) {
  if (!s.has_memory())
    return;
  input_ = rung_.input_matrix();
  z_.resize(rung_.n_states(), 1);
  U_.resize(s.hydro.n_moving);
  find_slots(pattern);
}

template <class Scalar> void NewtonMatrix<Scalar>::find_slots(const system::Pattern& p) {
  for_each_memory_entry(s_, [&](Index row, Index column, std::size_t, int, std::size_t, int) {
    const auto first = p.row.begin() + p.column_start[column],
               last = p.row.begin() + p.column_start[column + 1];
    const auto entry = std::lower_bound(first, last, row) - p.row.begin();
    slots_.push_back(points_.empty() ? entry : points_.target[static_cast<std::size_t>(entry)]);
  });
}

/// Product x y of complex numbers without the check for infinities.
double product(double x, double y) { return x * y; }
std::complex<double> product(const std::complex<double>& x, const std::complex<double>& y) {
  return {x.real() * y.real() - x.imag() * y.imag(), x.real() * y.imag() + x.imag() * y.real()};
}

/// Applies D^-1 in place: z / (alpha - a), or for a pair with
///   D = [[alpha - a, b], [-b, alpha - a]].
template <class Scalar> void NewtonMatrix<Scalar>::divide(Eigen::Ref<MatrixS> z) const {
  for (Index c = 0; c < z.cols(); ++c) {
    Scalar* const column = z.col(c).data();
    std::size_t k = 0;
    for (const Rung::Block& block : rung_.blocks) {
      const auto& [own, other] = inverse_[k++];
      const Scalar x = column[block.state];
      column[block.state] = product(own, x);
      if (!block.pair)
        continue;
      const Scalar y = column[block.state + 1];
      column[block.state] -= product(other, y);
      column[block.state + 1] = product(other, x) + product(own, y);
    }
  }
}

/// Inverts D block by block: D^-1 = [[own, -other], [other, own]].
template <class Scalar> void NewtonMatrix<Scalar>::invert() {
  inverse_.clear();
  for (const Rung::Block& block : rung_.blocks) {
    const Scalar d = alpha_ - block.a, b(block.pair ? block.b : 0.0), size = d * d + b * b;
    inverse_.push_back({d / size, b / size});
  }
}

template <class Scalar> void NewtonMatrix<Scalar>::find_transfer(Scalar alpha) {
  const bool blended = parts_->memory_weights.size() > 0;
  if (known_ && alpha == alpha_ && !blended)
    return;
  alpha_ = alpha;
  invert();
  driven_ = input_.template cast<Scalar>();
  divide(driven_);
  if (blended)
    driven_.array().colwise() *= parts_->memory_weights.template cast<Scalar>().array();
  if constexpr (std::is_same_v<Scalar, double>) {
    transfer_.noalias() = rung_.output * driven_;
  } else { // two real products: C is real
    transfer_.resize(s_.hydro.n_moving, s_.hydro.n_moving);
    transfer_.real().noalias() = rung_.output * MatrixX(driven_.real());
    transfer_.imag().noalias() = rung_.output * MatrixX(driven_.imag());
  }
  known_ = true;
}

/// Adds L T U_x, body by body.
template <class Scalar> void NewtonMatrix<Scalar>::add_memory() {
  using Block = Eigen::Matrix<Scalar, 6, 6>;
  using Columns = Eigen::Matrix<Scalar, 6, 10>;
  const std::vector<HydroBody>& bodies = s_.hydro.bodies;
  std::vector<Scalar>& values = lu_.values();
  std::size_t last_i = bodies.size(), last_j = last_i;
  Columns of_pair;
  auto slot = slots_.begin();
  for_each_memory_entry(s_, [&](Index, Index, std::size_t i, int component, std::size_t j, int k) {
    if (i != last_i || j != last_j) {
      Block T = Block::Zero();
      for (int m = 0; m < 6; ++m)
        for (int n = 0; n < 6; ++n)
          if (bodies[i].moving[m] >= 0 && bodies[j].moving[n] >= 0)
            T(m, n) = transfer_(bodies[i].moving[m], bodies[j].moving[n]);
      of_pair.noalias() = (parts_->memory[i].L.template cast<Scalar>() * T) *
                          parts_->memory[j].by_unknown.template cast<Scalar>();
      last_i = i;
      last_j = j;
    }
    values[static_cast<std::size_t>(*slot++)] += of_pair(component, k);
  });
}

/// Joins dF/dy + alpha dF/dy' for the reduced unknowns.
template <class Scalar>
void NewtonMatrix<Scalar>::join(const system::JacobianParts& parts, const Alphas& alphas) {
  std::vector<Scalar>& values = lu_.values();
  const auto value = [&](std::size_t k) {
    return parts.by_y[k] +
           (k < n_of_positions_ ? alphas.of_positions : alphas.of_most) * parts.by_yp[k];
  };
  if (points_.empty()) {
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = value(k);
    return;
  }
  rate_ = alphas.of_most;
  std::fill(values.begin(), values.end(), Scalar(0));
  for (std::size_t k = 0; k < lifted_.size(); ++k)
    lifted_[k] = value(static_cast<std::size_t>(points_.lifted[k].entry));
  std::size_t next = 0; // index among the lifted entries
  for (std::size_t k = 0; k < points_.target.size(); ++k) {
    if (points_.target[k] < 0)
      continue;
    const bool lifts =
        next < lifted_.size() && static_cast<std::size_t>(points_.lifted[next].entry) == k;
    values[static_cast<std::size_t>(points_.target[k])] +=
        lifts ? product(rate_, lifted_[next++]) : value(k);
  }
}

template <class Scalar>
bool NewtonMatrix<Scalar>::factorise(const system::JacobianParts& parts, const Alphas& alphas,
                                     bool careful) {
  parts_ = &parts;
  join(parts, alphas);
  if (s_.has_memory()) {
    find_transfer(alphas.of_memory);
    add_memory();
  }
  return lu_.factorise(careful);
}

template <class Scalar> void NewtonMatrix<Scalar>::subtract_memory_loads(VectorS& z, Scalar* b) {
  const system::HydroData& h = s_.hydro;
  if (parts_->memory_weights.size() > 0)
    z.array() *= parts_->memory_weights.template cast<Scalar>().array();
  U_.setZero();
  rung_.product.add_product(z.data(), U_.data());
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const BodyData& body = s_.bodies[static_cast<std::size_t>(hb.body)];
    Vec6<Scalar> force = Vec6<Scalar>::Zero();
    for (int c = 0; c < 6; ++c)
      if (hb.moving[c] >= 0)
        force[c] = U_[hb.moving[c]];
    force = parts_->memory[i].L.template cast<Scalar>() * force;
    for (int k = 0; k < body.n_active; ++k)
      b[body.u0 + k] -= force[body.active[static_cast<std::size_t>(k)]];
  }
}

/// Solves without memory states.
template <class Scalar> void NewtonMatrix<Scalar>::solve_bodies(Scalar* b) {
  if (points_.empty())
    return lu_.solve(b);
  for (std::size_t k = 0; k < lifted_.size(); ++k) {
    const PointElimination::Lifted& of = points_.lifted[k];
    b[of.row] += product(lifted_[k], b[points_.pairs[static_cast<std::size_t>(of.pair)].place]);
  }
  for (Index i = 0; i < points_.n; ++i)
    stays_[i] = b[points_.equation[static_cast<std::size_t>(i)]];
  lu_.solve(stays_.data());
  for (const PointElimination::Pair& of : points_.pairs)
    b[of.velocity] = -b[of.place];
  for (Index i = 0; i < points_.n; ++i)
    b[points_.unknown[static_cast<std::size_t>(i)]] = stays_[i];
  for (const PointElimination::Pair& of : points_.pairs)
    b[of.velocity] += product(rate_, b[of.place]);
}

template <class Scalar> void NewtonMatrix<Scalar>::solve(Scalar* b) {
  const system::HydroData& h = s_.hydro;
  if (!s_.has_memory())
    return solve_bodies(b);
  Eigen::Map<MatrixS> r_z(b + h.z0, rung_.n_states(), 1);
  z_ = r_z;
  r_z.setZero(); // rows of the memory states are rows of the identity
  w_ = z_.col(0);
  divide(w_);
  subtract_memory_loads(w_, b);
  solve_bodies(b);
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const BodyData& body = s_.bodies[static_cast<std::size_t>(hb.body)];
    Vec6<Scalar> velocity = Vec6<Scalar>::Zero();
    const auto& by = parts_->memory[i].by_unknown;
    for (int k = 0; k < body.n_position - body.n_translations; ++k)
      velocity += b[body.q0 + body.n_translations + k] * by.col(k).template cast<Scalar>();
    for (int k = 0; k < body.n_active; ++k)
      velocity += b[body.u0 + k] * by.col(4 + k).template cast<Scalar>();
    for (int c = 0; c < 6; ++c)
      if (hb.moving[c] >= 0)
        U_[hb.moving[c]] = velocity[c];
  }
  rung_.input.add_product(U_.data(), z_.data());
  divide(z_);
  r_z = z_;
}

template class NewtonMatrix<double>;
template class NewtonMatrix<std::complex<double>>;

} // namespace hydrodae::linalg
