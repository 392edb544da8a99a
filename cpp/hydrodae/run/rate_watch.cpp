#include "hydrodae/run/rate_watch.h"

#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/run/first_beyond.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::run {

namespace {

constexpr double beyond_zero = 1e-9; ///< of the largest rate

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

RateWatch::RateWatch(const system::Regime& regime, const std::string& channel)
    : s_(regime), motion_(motion_of(regime, channel)), ws_(regime) {}

double RateWatch::rate(double t, const VectorX& y, const VectorX& yp) {
  ws_.time = t;
  system::unpack<double>(s_, y.data(), yp.data(), ws_.bodies);
  const int joint = s_.motions[static_cast<std::size_t>(motion_)].joint;
  return system::motion_row<double>(s_, ws_, motion_)
      .gradient.dot(
          system::joint_velocity<double>(s_.joints[static_cast<std::size_t>(joint)], ws_.bodies));
}

/// By what part of the largest rate it has crossed zero, and a little more.
double RateWatch::beyond(double rate) const {
  return fastest_ > 0.0 ? -side_ * rate / fastest_ - beyond_zero : -1.0;
}

std::optional<double> RateWatch::locate(double t0, double t1, int nodes,
                                        const system::Recorder::Interpolant& at) {
  if (side_ == 0.0)
    return std::nullopt;
  return first_beyond(t0, t1, nodes, [&](double t) {
    at(t, y_, yp_);
    return beyond(rate(t, y_, yp_));
  });
}

bool RateWatch::accept(double t, const VectorX& y, const VectorX& yp) {
  const double now = rate(t, y, yp);
  const bool crossed = side_ != 0.0 && beyond(now) >= 0.0;
  fastest_ = std::max(fastest_, std::abs(now));
  if (crossed || side_ == 0.0)
    side_ = now > 0.0 ? 1.0 : now < 0.0 ? -1.0 : 0.0;
  return crossed;
}

} // namespace hydrodae::run
