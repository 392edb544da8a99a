/// The growth of the error in groups that are smooth: looks that are as close as the motion asks.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/solve/error_growth.h"

namespace hydrodae::solve {

namespace {

// Growth per radian of the motion that may come of the pieces' length, and the change of the
// equations from which on it is that much.
constexpr double doubtful_of_pieces = 0.3, much_changed = 0.5;

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
    const std::size_t a = find(std::max(s.joints[i].A.body, -1)),
                      b = find(std::max(s.joints[i].B.body, -1));
    if (a == b)
      out.push_back(static_cast<int>(i));
    root[std::max(a, b)] = std::min(a, b);
  }
  return out;
}

} // namespace

/// By group: is it dry, without closed loops (at whose singular poses growth comes and goes), and
/// nothing in it whose derivatives may jump inside a step? Radiation damps what floats, and waves
/// bound its steps. Errors of fixed steps are all of one kind, and of others with signs: they are
/// followed by other means.
std::vector<bool> ErrorGrowth::smooth_groups(const system::Regime& s, Way way) {
  std::vector<bool> out(static_cast<std::size_t>(s.n_error_groups()), way == Way::sizes);
  std::fill(out.begin() + s.n_groups, out.end(), false); // points
  const auto body = [&](int index) {
    if (index >= 0 && s.bodies[static_cast<std::size_t>(index)].group >= 0)
      out[static_cast<std::size_t>(s.bodies[static_cast<std::size_t>(index)].group)] = false;
  };
  const auto joint = [&](int index) {
    if (index < 0)
      return;
    const system::JointData& j = s.joints[static_cast<std::size_t>(index)];
    body(j.A.body);
    body(j.B.body);
  };
  for (const system::ElementList& list : s.elements) {
    if (has_no_kinks(*list.laws))
      continue;
    for (const system::PortData& port : list.ports) {
      body(port.body);
      joint(port.joint);
      if (port.motion >= 0)
        joint(s.motions[static_cast<std::size_t>(port.motion)].joint);
      for (const joint::Marker& point : port.points)
        body(point.body);
    }
  }
  for (const system::HydroBody& floating : s.hydro.bodies)
    body(floating.body);
  for (int i : joints_of_loops(s))
    joint(i);
  for (const system::SwitchData& element : s.switches)
    joint(s.motions[static_cast<std::size_t>(element.motion)].joint);
  return out;
}

/// The end of a step, and once growth has been seen what lies inside it.
void ErrorGrowth::keep(double t, const VectorX& step_error, const VectorX& rate,
                       const VectorX& motion, const Interpolant& at) {
  constexpr double piece = 0.15; // lever or rad
  constexpr double most = 24.0;
  const double start = n_pieces_ > 0 ? pieces_[n_pieces_ - 1].time : since_;
  double moved = 0.0;
  for (Index g = 0; g < rate.size() && fine_; ++g)
    if (is_smooth(g))
      moved = std::max(moved, motion[g] * rate[g] * (t - start));
  const int n = static_cast<int>(std::clamp(std::ceil(moved / piece), 1.0, most));
  for (int i = 1; i <= n; ++i) {
    if (pieces_.size() <= n_pieces_)
      pieces_.emplace_back();
    Piece& out = pieces_[n_pieces_++];
    out.time = i == n ? t : start + (t - start) * i / n;
    at(out.time, out.y, out.yp);
    if (i == n)
      out.error = step_error;
    else
      out.error.setZero(step_error.size());
  }
}

/// Have the equations of a smooth group changed much, or come back to what they were?
bool ErrorGrowth::is_doubtful(const VectorX& moved) const {
  constexpr double changed = 0.25, far = 0.5; // of them, levers or rad
  for (Index g = 0; g < s_.n_error_groups(); ++g)
    if (smooth_[static_cast<std::size_t>(g)] && (change_[g] > changed || moved[g] > far))
      return true;
  return false;
}

/// Over the same interval again for smooth groups, piece by piece, with the errors of its steps
/// from where they arise. As looks are no further apart than steps growth and fading is believed,
/// but not beside a singular pose, where it comes and goes.
/// @param vector  that of the run at the start of the interval (lambda0,)
void ErrorGrowth::look_closely(const VectorX& unit, const VectorX& rate, const VectorX& motion,
                               VectorX vector) {
  constexpr double most_grown = 2.0; // ln of it in a piece
  constexpr double longest = 2.0;    // lever or rad: a piece beyond tells nothing of growth
  const VectorX start = vector, level = error_.level, piled = error_.piled;
  VectorX total = VectorX::Zero(rate.size());
  for (std::size_t i = 0; i < n_pieces_; ++i)
    total += sizes(pieces_[i].error, unit);
  std::vector<bool> lost(smooth_.size(), false);
  flow_.go_back(last_look_);
  for (std::size_t i = 0; i < n_pieces_; ++i) {
    const Piece& step = pieces_[i];
    const double h = step.time - flow_.time();
    const VectorX before = sizes(vector, unit), own = sizes(step.error, unit);
    bool carried = flow_.look(step.time, step.y, step.yp, 1);
    flow_.compare(rate, change_, error_.change);
    carried = carried && flow_.step(vector);
    const VectorX after = sizes(vector, unit);
    vector += step.error;
    for (Index g = 0; g < rate.size(); ++g) {
      const double seen = before[g] > 0.0 ? std::log(after[g] / before[g]) : 0.0;
      if (!carried || !(std::abs(seen) < most_grown))
        lost[static_cast<std::size_t>(g)] = true;
      if (motion[g] * rate[g] * h < longest)
        grow(g, seen, rate[g] * h);
      error_.piled[g] += total[g] > 0.0 ? error_.added[g] * own[g] / total[g] : 0.0;
    }
  }
  for (Index g = 0; g < rate.size(); ++g)
    if (!smooth_[static_cast<std::size_t>(g)] || lost[static_cast<std::size_t>(g)]) {
      error_.level[g] = level[g];
      error_.piled[g] = piled[g];
    } else {
      error_.plain[g] += error_.added[g];
      error_.added[g] = 0.0;
    }
  for (Index i = 0; i < s_.lambda0; ++i) {
    const auto g = static_cast<std::size_t>(s_.error_group[static_cast<std::size_t>(i)]);
    if (smooth_[g])
      error_.vector[i] = lost[g] ? start[i] : vector[i] - error_.fresh[i];
  }
}

/// Lets what has piled up follow the vector, whose size has grown by e^seen over `phase` radians of
/// the motion. The level leaks to zero as fast as growth may come of looks far apart.
void ErrorGrowth::grow(Index g, double seen, double phase) {
  constexpr double much_grown = 3.0;
  const double before = error_.level[g],
               doubt = doubtful_of_pieces * std::min(change_[g] / much_changed, 1.0) * phase,
               level = before + seen,
               now = level > 0.0 ? std::max(0.0, level - doubt) : std::min(0.0, level + doubt);
  error_.piled[g] *= std::exp(now - before);
  error_.level[g] = now;
  fine_ = fine_ || (now > much_grown && is_smooth(g));
}

} // namespace hydrodae::solve
