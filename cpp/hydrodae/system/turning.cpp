#include "hydrodae/system/turning.h"

namespace hydrodae::system {

namespace {

Eigen::Quaterniond unit(const Vector4& p) { return {p[0], p[1], p[2], p[3]}; }

/// Rotation vector (angle times axis), up to a full turn.
Vector3 whole_vector(const Eigen::Quaterniond& p) {
  const double sine = p.vec().norm();
  return sine > 0.0 ? Vector3(2.0 * std::atan2(sine, p.w()) / sine * p.vec()) : Vector3::Zero();
}

} // namespace

std::vector<double> start_turns(const System& s) {
  std::vector<double> out;
  for (const MotionData& m : s.motions)
    out.push_back(m.start);
  const auto of_body = [&](int body) {
    return body < 0 ? Eigen::Quaterniond::Identity()
                    : unit(s.bodies[static_cast<std::size_t>(body)].orientation);
  };
  for (const RotationData& r : s.rotations) {
    Eigen::Quaterniond p = of_body(r.body) * unit(r.turn).conjugate();
    // true for a rotated reference: its turns are known up to full turns only
    bool least = r.turn[0] != 1.0;
    if (r.joint >= 0) {
      const JointData& j = s.joints[static_cast<std::size_t>(r.joint)];
      p = (of_body(j.A.body) * Eigen::Quaterniond(j.A.axes)).conjugate() * of_body(j.B.body) *
          Eigen::Quaterniond(j.B.axes);
      least = j.A.body >= 0 && j.B.body >= 0;
    }
    if (least && p.w() < 0.0)
      p.coeffs() *= -1.0;
    const Vector3 vector = whole_vector(p);
    out.insert(out.end(), vector.begin(), vector.end());
  }
  return out;
}

void follow_rotations(System& s) {
  s.rotations.clear();
  const auto add = [&](const RotationData& r) {
    s.rotations.push_back(r);
    return static_cast<int>(s.rotations.size()) - 1;
  };
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    s.bodies[i].followed =
        s.bodies[i].rotation == BodyData::Rotation::free ? add({static_cast<int>(i)}) : -1;
  for (ElementList& list : s.elements)
    for (PortData& port : list.ports) {
      const BodyData* body =
          port.body < 0 ? nullptr : &s.bodies[static_cast<std::size_t>(port.body)];
      if (list.laws->shape.port == element::Port::between)
        port.followed = add({-1, port.joint});
      else if (list.laws->shape.port == element::Port::on_body && body && body->followed >= 0)
        port.followed = port.turn[0] == 1.0 ? body->followed : add({port.body, -1, port.turn});
    }
}

} // namespace hydrodae::system
