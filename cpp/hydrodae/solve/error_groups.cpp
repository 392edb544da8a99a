/// Which groups have errors whose growth looks can follow: ErrorGrowth::smooth_groups.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/solve/error_growth.h"

namespace hydrodae::solve {

namespace {

/// Is each law of a list linear in what it sees?
bool has_no_kinks(const element::Elements& laws) {
  const element::Shape& shape = laws.shape;
  // Functions from outside are not asked about motions that do not happen.
  if (laws.timed || laws.type.starts_with("library"))
    return false;
  if (shape.in_water() || shape.port == element::Port::points || shape.n_states > 0 ||
      shape.n_reaction > 0 || shape.n_signals > 0)
    return false;
  const std::size_t n_in = static_cast<std::size_t>(shape.n_in());
  std::vector<double> first, now(laws.size() * laws.jacobian_size());
  for (const double size : {0.0, 1e-3, -1.0, 1e3}) {
    std::vector<double> in(laws.size() * n_in);
    for (std::size_t i = 0; i < in.size(); ++i)
      in[i] = size * std::cos(static_cast<double>(i));
    laws.jacobian(0.0, in.data(), nullptr, now.data());
    if (first.empty())
      first = now;
    if (first != now)
      return false;
  }
  return true;
}

/// Looks at each step follow laws whose derivatives jump as a rope slackens, a stop is met or a
/// valve opens: the force is continuous, or nearly, so that errors grow by the equations before and
/// after it.
bool can_be_followed(const element::Elements& laws) {
  using element::Port;
  const Port port = laws.shape.port;
  if (laws.type == "excitation")
    return true;
  if (laws.timed || laws.type.starts_with("library"))
    return false;
  return port == Port::along_joint || port == Port::along_distance || port == Port::between ||
         laws.type == "rope" || laws.type == "catenary";
}

/// Joints that close a loop of bodies, the ground among them, which guides those of one or two
/// coordinates.
std::vector<int> joints_of_loops(const system::Regime& s) {
  std::vector<std::size_t> root(s.bodies.size() + 1);
  std::iota(root.begin(), root.end(), std::size_t{0});
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (s.bodies[i].n_active < 3)
      root[i + 1] = 0;
  const auto find = [&](int body) {
    auto i = static_cast<std::size_t>(body + 1); // 0: the ground
    while (root[i] != i)
      i = root[i];
    return i;
  };
  std::vector<int> out;
  for (std::size_t i = 0; i < s.joints.size(); ++i) {
    if (s.joints[i].rows.empty()) // it measures only, as a distance
      continue;
    const std::size_t a = find(std::max(s.joints[i].A.body, -1)),
                      b = find(std::max(s.joints[i].B.body, -1));
    if (a == b)
      out.push_back(static_cast<int>(i));
    root[std::max(a, b)] = std::min(a, b);
  }
  return out;
}

template <class Visit> void for_group_of(const system::Regime& s, int body, Visit&& visit) {
  if (body >= 0 && s.bodies[static_cast<std::size_t>(body)].group >= 0)
    visit(s.bodies[static_cast<std::size_t>(body)].group);
}

template <class Visit> void for_groups_of_joint(const system::Regime& s, int joint, Visit&& visit) {
  if (joint < 0)
    return;
  const system::JointData& j = s.joints[static_cast<std::size_t>(joint)];
  for_group_of(s, j.A.body, visit);
  for_group_of(s, j.B.body, visit);
}

/// Groups of the bodies that the laws of a list load.
template <class Visit>
void for_each_group(const system::Regime& s, const system::ElementList& list, Visit&& visit) {
  for (const system::PortData& port : list.ports) {
    for_group_of(s, port.body, visit);
    for_groups_of_joint(s, port.joint, visit);
    if (port.motion >= 0)
      for_groups_of_joint(s, s.motions[static_cast<std::size_t>(port.motion)].joint, visit);
    for (const joint::Marker& point : port.points)
      for_group_of(s, point.body, visit);
  }
}

/// By group: do laws load it whose derivatives may jump?
std::vector<bool> groups_with_kinks(const system::Regime& s) {
  std::vector<bool> out(static_cast<std::size_t>(s.n_error_groups()), false);
  for (const system::ElementList& list : s.elements)
    if (list.laws->type != "excitation" && can_be_followed(*list.laws) && !has_no_kinks(*list.laws))
      for_each_group(s, list, [&](int group) { out[static_cast<std::size_t>(group)] = true; });
  return out;
}

} // namespace

std::vector<bool> ErrorGrowth::kinks(const system::Regime& s, Way way) {
  std::vector<bool> out = groups_with_kinks(s);
  const std::vector<bool> followed = smooth_groups(s, way);
  for (std::size_t g = 0; g < out.size(); ++g)
    out[g] = out[g] && followed[g];
  return out;
}

/// By group: is it without closed loops (at whose singular poses growth comes and goes), impacts
/// and laws that cannot be followed? Errors with signs are followed by other means, and those of
/// fixed steps, which are of one kind, where nothing jumps.
std::vector<bool> ErrorGrowth::smooth_groups(const system::Regime& s, Way way) {
  std::vector<bool> out(static_cast<std::size_t>(s.n_error_groups()), way == Way::sizes);
  if (way == Way::coherently)
    out = groups_with_kinks(s);
  std::fill(out.begin() + s.n_groups, out.end(), false); // points
  const auto set = [&](int group) { out[static_cast<std::size_t>(group)] = false; };
  for (const system::ElementList& list : s.elements)
    if (!can_be_followed(*list.laws) && !has_no_kinks(*list.laws))
      for_each_group(s, list, set);
  const auto joint = [&](int index) { for_groups_of_joint(s, index, set); };
  for (int i : joints_of_loops(s))
    joint(i);
  for (const system::SwitchData& element : s.switches)
    joint(s.motions[static_cast<std::size_t>(element.motion)].joint);
  return out;
}

} // namespace hydrodae::solve
