#include "hydrodae/hydro/headings.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace hydrodae::hydro {
namespace {

/// Tolerance of headings [rad]: a device at rest may deviate slightly from its reference.
constexpr double beside_a_heading = 1e-4;
constexpr double same_heading = 1e-6; ///< difference of the two ends of a circle [rad]

/// Second derivatives, from the values, of the cubic spline through points x [rad]: periodic, of
/// a full turn, or natural; (n, n).
MatrixX bending_of_values(const VectorX& x, bool round) {
  const Eigen::Index n = x.size();
  MatrixX left = MatrixX::Identity(n, n), right = MatrixX::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!round && (i == 0 || i == n - 1))
      continue;
    const Eigen::Index before = (i + n - 1) % n, after = (i + 1) % n;
    const double h0 = x[i] - x[before] + (i == 0 ? 2.0 * pi : 0.0);
    const double h1 = x[after] - x[i] + (i == n - 1 ? 2.0 * pi : 0.0);
    left(i, i) = (h0 + h1) / 3.0;
    left(i, before) += h0 / 6.0; // before and after are one of two
    left(i, after) += h1 / 6.0;
    right(i, after) += 1.0 / h1;
    right(i, before) += 1.0 / h0;
    right(i, i) -= 1.0 / h0 + 1.0 / h1;
  }
  return left.partialPivLu().solve(right);
}

} // namespace

Headings::Headings(VectorX heading, bool tested)
    : heading_(std::move(heading)), count_(heading_.size()) {
  if (count_ == 1)
    return;
  round_ = std::abs(heading_[count_ - 1] - heading_[0] - 2.0 * pi) < same_heading;
  const double gap = (heading_.tail(count_ - 1) - heading_.head(count_ - 1)).maxCoeff();
  if (round_)
    --count_;
  const auto resolved = static_cast<Eigen::Index>(std::ceil(pi / gap - 1e-6)) - 1;
  order_ = std::min<Eigen::Index>((count_ - 1) / 2, round_ ? resolved : 1);
  alternates_ = round_ && count_ % 2 == 0 && order_ == count_ / 2 - 1 && equal_steps();
  MatrixX values(count_, functions());
  for (Eigen::Index i = 0; i < count_; ++i)
    values.row(i) = basis(heading_[i]).transpose();
  const MatrixX one = MatrixX::Identity(count_, count_);
  harmonics_ = values.colPivHouseholderQr().solve(one);
  rest_ = one - values * harmonics_;
  const bool periodic = round_ && count_ > 1;
  bending_ = count_ > 1 ? MatrixX(bending_of_values(heading_.head(count_), periodic) * rest_)
                        : MatrixX::Zero(1, 1);
  if (tested)
    misses_ = own_misses();
}

bool Headings::equal_steps() const {
  const Eigen::Index n = heading_.size() - 1;
  const VectorX steps = heading_.tail(n) - heading_.head(n);
  return steps.maxCoeff() - steps.minCoeff() < same_heading;
}

VectorX Headings::basis(double heading) const {
  VectorX out(functions());
  out[0] = 1.0;
  const double from = 0.5 * (heading_[0] + heading_[heading_.size() - 1]);
  for (Eigen::Index k = 1; k <= order_; ++k) {
    out[2 * k - 1] = std::cos(static_cast<double>(k) * (heading - from));
    out[2 * k] = std::sin(static_cast<double>(k) * (heading - from));
  }
  if (alternates_)
    out[2 * order_ + 1] = std::cos(0.5 * static_cast<double>(count_) * (heading - from));
  return out;
}

std::optional<double> Headings::covered(double heading) const {
  const double low = heading_[0], high = heading_[heading_.size() - 1];
  const double turned =
      heading - 2.0 * pi * std::floor((heading - low + beside_a_heading) / (2.0 * pi));
  if (!(turned <= high + beside_a_heading))
    return std::nullopt;
  return std::clamp(turned, low, high);
}

VectorX Headings::weights(double heading) const {
  VectorX out = VectorX::Zero(heading_.size());
  if (count_ == 1) {
    out[0] = 1.0;
    return out;
  }
  const auto above = std::upper_bound(heading_.begin() + 1, heading_.end() - 1, heading);
  const Eigen::Index j = above - heading_.begin(), i = j - 1, after = j % count_;
  const double h = heading_[j] - heading_[i];
  const double a = (heading_[j] - heading) / h, b = (heading - heading_[i]) / h;
  out.head(count_) =
      harmonics_.transpose() * basis(heading) +
      (a * rest_.row(i) + b * rest_.row(after) +
       h * h / 6.0 * ((a * a * a - a) * bending_.row(i) + (b * b * b - b) * bending_.row(after)))
          .transpose();
  return out;
}

std::optional<Headings> Headings::thinned() const {
  std::vector<double> kept;
  for (Eigen::Index i = 0; i < count_; i += 2)
    kept.push_back(heading_[i]);
  const double last = heading_[heading_.size() - 1];
  if (!round_ && kept.back() < last)
    kept.push_back(last);
  if (kept.size() < 3)
    return std::nullopt;
  if (round_)
    kept.push_back(last);
  return Headings(Eigen::Map<const VectorX>(kept.data(), static_cast<Eigen::Index>(kept.size())),
                  false);
}

MatrixX Headings::own_misses() const {
  const Eigen::Index n = heading_.size();
  if (round_ && count_ == 4) {
    MatrixX spare = MatrixX::Zero(1, n);
    spare.leftCols(4) << 0.25, -0.25, 0.25, -0.25;
    return spare;
  }
  const std::optional<Headings> rest = thinned();
  if (!rest)
    return {};
  MatrixX out = MatrixX::Zero(count_, n);
  Eigen::Index row = 0;
  for (Eigen::Index i = 1; i < (round_ ? count_ : n - 1); i += 2, ++row) {
    const VectorX weights = rest->weights(heading_[i]);
    for (Eigen::Index k = 0; k < weights.size(); ++k)
      out(row, std::min(2 * k, n - 1)) += weights[k]; // the last is left in, even or not
    out(row, i) -= 1.0;
  }
  return out.topRows(row);
}

double Headings::doubt(double miss) const {
  if (count_ == 2)
    return 1.0 - std::cos(0.5 * (heading_[1] - heading_[0]));
  if (misses_.size() == 0)
    return 0.0;
  if (round_ && count_ == 4)
    return 2.0 * miss; // it is there at its largest where cos 2 b is aliased to another sign
  return miss * std::max(1.0 / 3.0, std::min(1.0, 2.0 * miss));
}

} // namespace hydrodae::hydro
