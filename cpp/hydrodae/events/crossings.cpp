#include "hydrodae/events/crossings.h"

#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::events {

namespace {

constexpr double beyond_zero = 1e-9; ///< distance beyond zero, as part of the largest rate

int motion_of(const system::Regime& s, const std::string& channel) {
  std::vector<std::string> names;
  for (const system::JointData& j : s.joints)
    if (j.type)
      for (std::size_t m = 0; m < j.type->motions.size(); ++m) {
        const int motion = j.first_motion + static_cast<int>(m);
        names.push_back("joints/" + j.name + "/" +
                        s.motions[static_cast<std::size_t>(motion)].name + "_rate");
        if (names.back() == channel)
          return motion;
      }
  throw CaseError(in_quotes(channel) + " is no rate of a joint, whose standstill could be found" +
                  suggestion(channel, names));
}

} // namespace

Crossing::Crossing(const system::Regime& regime, const std::string& channel)
    : s_(regime), motion_(motion_of(regime, channel)), ws_(regime) {}

double Crossing::rate(double t, const VectorX& y, const VectorX& yp) {
  ws_.time = t;
  system::unpack<double>(s_, y.data(), yp.data(), ws_.bodies);
  const int joint = s_.motions[static_cast<std::size_t>(motion_)].joint;
  return system::motion_row<double>(s_, ws_, motion_)
      .gradient.dot(
          system::joint_velocity<double>(s_.joints[static_cast<std::size_t>(joint)], ws_.bodies));
}

/// Remaining part of the largest rate until the crossing, plus a small margin.
double Crossing::left(double rate) const {
  return state_.side != 0.0 && state_.fastest > 0.0
             ? state_.side * rate / state_.fastest + beyond_zero
             : 1.0;
}

bool Crossing::accept(double t, const VectorX& y, const VectorX& yp) {
  const double now = rate(t, y, yp);
  const bool crossed = left(now) <= 0.0;
  state_.fastest = std::max(state_.fastest, std::abs(now));
  if (crossed || state_.side == 0.0)
    state_.side = now > 0.0 ? 1.0 : now < 0.0 ? -1.0 : 0.0;
  return crossed;
}

} // namespace hydrodae::events
