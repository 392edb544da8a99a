#include "hydrodae/system/dropped_rows.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::system {

double smaller_arm(const System& s, const JointData& j) {
  double arm = INFINITY;
  for (int body : {j.A.body, j.B.body})
    if (body >= 0 && s.bodies[static_cast<std::size_t>(body)].n_active > 0)
      arm = std::min(arm, s.bodies[static_cast<std::size_t>(body)].arm);
  return std::isfinite(arm) ? arm : 1.0;
}

DroppedRows::DroppedRows(const Regime& s) : s_(s), workspace_(s), rest_(VectorX::Zero(s.lambda0)) {
  for (const JointData& j : s.joints)
    for (const RowData& row : j.rows)
      if (row.dropped) {
        const bool angle = joint::is_angle(row.kind);
        joints_.push_back({&j, &row, angle ? 1.0 : smaller_arm(s, j)});
      }
  for (const CouplerData& c : s.couplers)
    if (c.dropped) {
      const MotionData& m = s.motions[static_cast<std::size_t>(c.terms.front().motion)];
      const JointData& j = s.joints[static_cast<std::size_t>(m.joint)];
      couplers_.push_back({&c, m.motion.is_angle() ? 1.0 : smaller_arm(s, j)});
    }
}

/// Gap of a coupler at its own level (position or rate), and the size that normalises it.
double DroppedRows::gap(const CouplerRow& row, double t, double& size) {
  const CouplerData& c = *row.coupler;
  const std::array<double, 3> drive = s_.drive(c, t);
  double sum = c.velocity_level ? -drive[0] : -s_.offset(c) - drive[0];
  size = c.velocity_level ? std::abs(drive[0]) : row.arm;
  for (const CouplerData::Term& term : c.terms) {
    const auto motion = motion_row<double>(s_, workspace_, term.motion);
    if (!c.velocity_level) {
      sum += term.factor * motion.value;
      continue;
    }
    const JointData& j = s_.joints[static_cast<std::size_t>(
        s_.motions[static_cast<std::size_t>(term.motion)].joint)];
    const double rate =
        term.factor * motion.gradient.dot(joint_velocity<double>(j, workspace_.bodies));
    sum += rate;
    size = std::max(size, std::abs(rate));
  }
  const bool angle = s_.motions[static_cast<std::size_t>(c.terms.front().motion)].motion.is_angle();
  // The number of turns at the start is not known in y.
  return angle && !c.velocity_level ? std::remainder(sum, 2.0 * pi) : sum;
}

DroppedRows::Gap DroppedRows::largest(double t, const VectorX& y) {
  unpack<double>(s_, y.data(), rest_.data(), workspace_.bodies);
  Gap out;
  double largest = -1.0;
  const JointRow* in_joint = nullptr;
  const CouplerRow* in_coupler = nullptr;
  for (const JointRow& r : joints_) {
    const double value =
        std::abs(joint::basic_row<double>(r.row->kind, r.joint->A, r.joint->B, r.joint->parameters,
                                          joint_geometry<double>(*r.joint, workspace_.bodies))
                     .value);
    if (value / r.arm > largest) {
      largest = value / r.arm;
      out.gap = value;
      in_joint = &r;
    }
  }
  for (const CouplerRow& r : couplers_) {
    const int stop = r.coupler->of_switch;
    if (stop >= 0 && !s_.holds(s_.switches[static_cast<std::size_t>(stop)]))
      continue;
    double size = 0.0;
    const double value = std::abs(gap(r, t, size)), part = size > 0.0 ? value / size : 0.0;
    if (part > largest) {
      largest = part;
      out.gap = value;
      in_coupler = &r;
    }
  }
  out.part = std::max(largest, 0.0);
  if (in_coupler) {
    const CouplerData& c = *in_coupler->coupler;
    const bool angle =
        s_.motions[static_cast<std::size_t>(c.terms.front().motion)].motion.is_angle();
    out.key = "constraint." + c.name;
    out.name = "constraints/" + c.name;
    out.unit = c.velocity_level ? (angle ? "rad/s" : "m/s") : (angle ? "rad" : "m");
  } else if (in_joint) {
    const bool angle = joint::is_angle(in_joint->row->kind);
    out.key = "joint." + in_joint->joint->name;
    out.name = "joints/" + in_joint->joint->name + " " + joint::row_name(in_joint->row->kind);
    out.unit = angle ? "rad" : "m";
  }
  return out;
}

} // namespace hydrodae::system
