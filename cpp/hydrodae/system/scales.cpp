/// Size of one unit of tolerance for each unknown. Global coordinates do not show the size of a
/// motion, so positions are measured against a length of the body.

#include <algorithm>
#include <cmath>

#include "hydrodae/system/declare.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::system {

namespace {

/// Scales at a joint: those of the lighter body, which is more sensitive to errors of the
/// multiplier.
struct JointScale {
  double force = 0.0, length = 1.0, angle = 1.0, time = 1.0;
};

JointScale joint_scale(const System& s, const JointData& j) {
  JointScale out;
  for (int body : {j.A.body, j.B.body}) {
    if (body < 0 || s.bodies[body].n_active == 0)
      continue;
    const BodyData& b = s.bodies[body];
    const double weight =
        b.scale_mass *
        (s.gravity > 0.0 ? s.gravity : b.length_scale / (b.time_scale * b.time_scale));
    if (out.force == 0.0 || weight < out.force)
      out = {weight, b.length_scale, b.length_scale / b.lever, b.time_scale};
  }
  return out;
}

/// Scales of one constraint row and of its multipliers; `angle`: the row is an angle, not a length.
void set_row(Regime& s, const JointScale& scale, Index lambda, Index mu, bool angle) {
  const double size = angle ? scale.angle : scale.length;
  s.scale[lambda] = angle ? scale.force * scale.length / scale.angle : scale.force;
  s.row_scale[lambda] = size / scale.time;
  if (mu < 0)
    return;
  s.scale[mu] = size / scale.time;
  s.row_scale[mu] = size;
}

} // namespace

void take_time_scales(System& s, const VectorX& y, const VectorX& yp) {
  std::vector<double> shortest(static_cast<std::size_t>(s.n_groups), INFINITY);
  for (const BodyData& b : s.bodies)
    for (int k = 0; k < b.n_active && !b.time_scale_known; ++k) {
      double& time = shortest[static_cast<std::size_t>(b.group)];
      const double size = b.active[k] < 3 ? b.length_scale : b.length_scale / b.lever;
      const double speed = std::abs(y[b.u0 + k]), rate = std::abs(yp[b.u0 + k]);
      if (speed > 0.0)
        time = std::min(time, size / speed);
      if (rate > 0.0)
        time = std::min(time, std::sqrt(size / rate));
    }
  for (BodyData& b : s.bodies) { // bodies at rest without loads: any scale works
    if (b.time_scale_known || b.group < 0)
      continue;
    const double time = shortest[static_cast<std::size_t>(b.group)];
    if (std::isfinite(time))
      b.time_scale = time;
  }
  s.states = declare(s).states;
}

void set_scales(Regime& s) {
  s.scale = s.relative = s.row_scale = VectorX::Ones(s.n);
  s.relative.head(s.u0).setZero();
  s.relative.tail(s.n - s.mu0).setZero();
  for (const BodyData& b : s.bodies) {
    const double length = b.length_scale, angle = length / b.lever;
    const double weight =
        b.scale_mass * (s.gravity > 0.0 ? s.gravity : length / (b.time_scale * b.time_scale));
    for (int k = 0; k < b.n_active; ++k) {
      const bool turns = b.active[k] >= 3;
      s.scale[b.u0 + k] = (turns ? angle : length) / b.time_scale;
      s.row_scale[b.u0 + k] = turns ? weight * b.lever : weight;
    }
    for (int k = 0; k < b.n_position; ++k) {
      const bool turns = k >= b.n_translations;
      const double scale = !turns                                   ? length
                           : b.rotation == BodyData::Rotation::free ? 0.5 * angle
                                                                    : angle;
      s.scale[b.q0 + k] = scale;
      s.row_scale[b.q0 + k] = scale / b.time_scale;
    }
    if (s.sigma(b) >= 0)
      s.scale[s.sigma(b)] = 0.5 * angle / b.time_scale;
  }
  for (const JointData& j : s.joints) {
    const JointScale scale = joint_scale(s, j);
    for (const RowData& row : j.rows)
      if (s.holds(row))
        set_row(s, scale, s.lambda(row), s.mu(row), joint::is_angle(row.kind));
  }
  for (const CouplerData& c : s.couplers) {
    const MotionData& motion = s.motions[c.terms.front().motion];
    if (s.holds(c))
      set_row(s, joint_scale(s, s.joints[motion.joint]), s.lambda(c),
              c.velocity_level ? -1 : s.mu(c), motion.motion.is_angle());
  }
  for (const StateBlock& block : s.states) {
    const double time =
        block.body < 0 ? 1.0 : s.bodies[static_cast<std::size_t>(block.body)].time_scale;
    Index z = block.first;
    for (const element::Unknown& u : block.unknowns) {
      s.scale[z] = u.scale;
      s.relative[z] = u.absolute ? 0.0 : 1.0;
      s.row_scale[z++] = u.rate > 0.0 ? u.rate : u.algebraic ? u.scale : u.scale / time;
    }
  }
  for (Index i = 0; i < s.lambda0; ++i)
    if (!s.is_absolute(i))
      s.scale[i] *= s.motion_scale[s.group[static_cast<std::size_t>(i)]];
  for (const BodyData& b : s.bodies) {
    if (b.group < 0)
      continue;
    const double part = s.translation_scale[b.group];
    s.scale.segment(b.q0, b.n_translations) *= part;
    for (int k = 0; k < b.n_active; ++k)
      s.scale[b.u0 + k] *= b.active[k] < 3 ? part : 1.0;
  }
}

} // namespace hydrodae::system
