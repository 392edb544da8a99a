#include "hydrodae/solve/verification.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

Verification::Verification(const system::Regime& s)
    : s_(s.system), motion_(static_cast<std::size_t>(s.n_error_groups())),
      differences_(static_cast<std::size_t>(s.n_error_groups())) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (const system::BodyData& b = s.bodies[i]; b.group >= 0)
      bodies_.push_back({i, b.group, b.lever, b.name});
  for (const system::Block& block : s.blocks)
    if (block.states >= 0 && block.moves)
      lines_.push_back(&block);
}

/// Of R_a^T R_b, by the sine of half the angle, which small angles leave exact.
double Verification::apart(const Body& body, const Pose& a, const Pose& b) {
  const double half = (a.R - b.R).norm() / std::sqrt(8.0);
  return std::max((a.r - b.r).norm() / body.lever, 2.0 * std::asin(std::min(half, 1.0)));
}

double Verification::apart(const system::StateBlock& line, const VectorX& a,
                           const VectorX& b) const {
  double most = 0.0;
  system::for_each_point(line, [&](Index place, Index, double length) {
    const Index k = place - s_.z0;
    most = std::max(most, (a.segment<3>(k) - b.segment<3>(k)).norm() / length);
  });
  return most;
}

void Verification::keep(double time, const std::vector<system::BodyState<double>>& bodies,
                        const VectorX& y) {
  times_.push_back(time);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& b = bodies_[k];
    poses_.push_back({bodies[b.index].r, bodies[b.index].R});
    double& most = motion_[static_cast<std::size_t>(b.group)];
    most = std::max(most, apart(b, poses_[k], poses_.back()));
  }
  if (lines_.empty())
    return;
  states_.push_back(states_of(y));
  for (const system::Block* line : lines_) {
    double& most = motion_[static_cast<std::size_t>(line->group)];
    most = std::max(most, apart(states_of(*line), states_.front(), states_.back()));
  }
}

void Verification::compare(const std::vector<system::BodyState<double>>& bodies, const VectorX& y) {
  if (next_ >= times_.size())
    return;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& b = bodies_[k];
    const double off =
        apart(b, poses_[next_ * bodies_.size() + k], {bodies[b.index].r, bodies[b.index].R});
    Difference& worst = differences_[static_cast<std::size_t>(b.group)];
    if (off > worst.error)
      worst = {off, b.name, times_[next_]};
  }
  for (const system::Block* line : lines_) {
    const double off = apart(states_of(*line), states_[next_], states_of(y));
    Difference& worst = differences_[static_cast<std::size_t>(line->group)];
    if (off > worst.error)
      worst = {off, line->name, times_[next_]};
  }
  ++next_;
}

Verification::Difference Verification::largest() const {
  Difference out;
  for (std::size_t g = 0; g < differences_.size(); ++g) {
    Difference d = differences_[g];
    d.error = d.error > 0.0 ? d.error / std::max(motion_[g], 1e-300) : 0.0;
    if (d.error > out.error)
      out = d;
  }
  return out;
}

} // namespace hydrodae::solve
