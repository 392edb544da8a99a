#include "hydrodae/integrate/sample_closing.h"

#include <cmath>

namespace hydrodae::integrate {

namespace {
constexpr double tolerance = 1e-10; ///< tolerance of gaps and their rates, in units of their scale
constexpr double closed_to = 1e-11; ///< gap of a closed sample, in units of its scale
constexpr double far = 0.1;         ///< largest error of an interpolant, in units of its scale
} // namespace

SampleClosing::SampleClosing(const system::Regime& system, const system::Pattern& pattern,
                             bool rates)
    : s_(system), first_(rates ? system.lambda0 : system.mu0), equations_(system, pattern, 1.0),
      residual_(system.n) {}

bool SampleClosing::open(double t, const VectorX& y, const VectorX& yp) {
  residual_.setZero();
  if (!equations_.constraint_residual(t, y, yp, residual_))
    return false;
  double size = 0.0;
  for (Index i = first_; i < s_.sigma0; ++i)
    size = std::max(size, std::abs(residual_[i]) / s_.row_scale[i]);
  return size > tolerance && size < far;
}

void SampleClosing::close(double t, VectorX& y) {
  rates_ = VectorX::Zero(s_.n); // without the multipliers' part of q'
  closed_ = y;
  closed_.tail(s_.n - s_.lambda0).setZero();
  if (!open(t, closed_, rates_))
    return;
  if (!saddle_)
    saddle_.emplace(equations_);
  bool here = false;
  if (!linearised_) {
    if (!saddle_->linearise(t, closed_))
      return;
    linearised_ = here = true;
  }
  if (!saddle_->project(t, closed_, closed_to)) {
    if (here)
      return;
    // The matrix of an earlier sample may be too inexact.
    closed_ = y;
    if (!saddle_->linearise(t, closed_) || !saddle_->project(t, closed_, closed_to))
      return;
  }
  y.head(s_.z0) = closed_.head(s_.z0);
}

void SampleClosing::hold(double t, VectorX& y, VectorX& yp) {
  closed_ = y;
  rates_ = yp;
  if (!saddle_)
    saddle_.emplace(equations_);
  linearised_ = false;
  if (!saddle_->accelerations(t, closed_, rates_))
    return;
  y = closed_;
  yp = rates_;
}

} // namespace hydrodae::integrate
