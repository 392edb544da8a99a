/// Friction with a bearing in impacts.

#include <algorithm>
#include <cmath>

#include "hydrodae/linalg/pressed_friction.h"

namespace hydrodae::linalg {

namespace {

constexpr int most_sweeps = 1000;
/// Accuracy of the balance, as part of the largest impulse
constexpr double impulse_balanced = 1e-13;
/// Accuracy accepted if the error gets no smaller, as part of the largest impulse
constexpr double impulse_rounded = 1e-9;
/// Rate per impulse of a held joint, as part of that of a free body
constexpr double held_rate = 1e-12;

} // namespace

double linalg::SaddlePoint::Pressed::rate_along(const system::Regime& s, std::size_t k,
                                                const double* u) const {
  const joint::Vector12& row = ws.state.elements[laws[k].list].rows[laws[k].law];
  const system::JointData& j = s.joints[static_cast<std::size_t>(port(s, k).joint)];
  double rate = 0.0;
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
    for (int c = 0; c < b.n_active; ++c)
      rate += row[6 * side + b.active[static_cast<std::size_t>(c)]] * u[b.u0 - s.u0 + c];
  }
  return rate;
}

std::optional<double> linalg::SaddlePoint::Pressed::rub(const system::Regime& s, const VectorX& u,
                                                        VectorX& solution) {
  const auto n = static_cast<Index>(laws.size());
  MatrixX gain(n, n); // rates along the joints per impulse along them
  VectorX before(n), free(n);
  std::vector<element::Bearing> bearings;
  for (Index k = 0; k < n; ++k) {
    const auto law = static_cast<std::size_t>(k);
    bearings.push_back(*port(s, law).bearing);
    bearings.back().preload = bearings.back().small = 0.0; // impulses have no preload
    see(s, law, solution.data(), start.data() + 6 * k);
    before[k] = rate_along(s, law, u.data());
    free[k] = before[k] + rate_along(s, law, solution.data());
    for (Index m = 0; m < n; ++m)
      gain(k, m) = rate_along(s, law, columns.col(m).data());
  }
  const double easiest = gain.diagonal().cwiseAbs().maxCoeff();
  VectorX impulse = VectorX::Zero(n);
  double last = INFINITY;
  bool found = false;
  for (int sweep = 0; sweep < most_sweeps && !found; ++sweep) {
    double change = 0.0;
    for (Index k = 0; k < n; ++k) {
      if (!(gain(k, k) > held_rate * easiest)) // the impact is at this joint itself
        continue;
      reaction.segment<6>(6 * k) = start.segment<6>(6 * k);
      for (Index m = 0; m < n; ++m)
        reaction.segment<6>(6 * k) += impulse[m] * sensitivity.col(m).segment<6>(6 * k);
      const element::Bearing& bearing = bearings[static_cast<std::size_t>(k)];
      const double most = bearing.slip * bearing.load(reaction.data() + 6 * k);
      const double rate = free[k] + gain.row(k).dot(impulse);
      const double now = std::clamp(impulse[k] - rate / gain(k, k), -most, most);
      change = std::max(change, std::abs(now - impulse[k]));
      impulse[k] = now;
    }
    const double size = impulse.cwiseAbs().maxCoeff();
    if (!std::isfinite(size) || !std::isfinite(change))
      return std::nullopt;
    found = change <= impulse_balanced * size ||
            (sweep > 10 && change >= 0.5 * last && change <= impulse_rounded * size);
    last = change;
  }
  if (!found)
    return std::nullopt;
  solution += columns * impulse;
  return impulse.dot(before + 0.5 * (free - before + gain * impulse));
}

} // namespace hydrodae::linalg
