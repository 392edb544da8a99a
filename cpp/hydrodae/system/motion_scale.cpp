#include "hydrodae/system/motion_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hydrodae/core/text.h"

namespace hydrodae::system {

namespace {

constexpr double full = 0.1;           ///< motion [levers] above which the full scales apply
constexpr double rounding_error = 1e3; ///< epsilons of a position: lower bound of any step's error
/// Number of time scales after which the reached motion alone counts
constexpr double settled = 20.0;
constexpr double slack_of_scales = 1.5; ///< smallest ratio of a change that updates the scales

/// Largest translation since `from`, in levers.
double translation(const BodyData& b, const VectorX& from, const VectorX& y) {
  const Index n = b.n_translations;
  return (y.segment(b.q0, n) - from.segment(b.q0, n)).norm() / b.lever;
}

} // namespace

VectorX displacements(const Regime& s, const VectorX& from, const VectorX& y) {
  VectorX out(static_cast<Index>(s.bodies.size()));
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const BodyData& b = s.bodies[i];
    const Index turns = b.q0 + b.n_translations, n = b.n_position - b.n_translations;
    const double moved = translation(b, from, y);
    double angle = (y.segment(turns, n) - from.segment(turns, n)).norm();
    if (b.rotation == BodyData::Rotation::free) // p and -p are the same rotation
      angle = 2.0 * std::min(angle, (y.segment(turns, n) + from.segment(turns, n)).norm());
    out[static_cast<Index>(i)] = std::max(moved, angle);
  }
  return out;
}

MotionScale::MotionScale(Regime& s, const Pattern& pattern, const VectorX& y, const VectorX& yp,
                         const VectorX& forced, double hold, double rtol)
    : s_(s), start_(y.head(s.n_q)), least_(VectorX::Zero(s.n_groups)),
      hold_(VectorX::Constant(s.n_groups, hold)), state_{forced, least_, forced, least_, least_} {
  for (const BodyData& b : s.bodies)
    if (b.group >= 0) {
      constexpr double epsilon = std::numeric_limits<double>::epsilon();
      const double place = b.position.cwiseAbs().maxCoeff() / b.lever + 1.0;
      least_[b.group] = std::max(least_[b.group],
                                 std::min(1.0, rounding_error * epsilon * place / (full * rtol)));
      hold_[b.group] = std::max(hold_[b.group], settled * b.time_scale);
    }
  expect_start(pattern, 0.0, y, yp);
  for (const HydroBody& hb : s_.hydro.bodies) {
    const BodyData& b = s_.bodies[static_cast<std::size_t>(hb.body)];
    if (b.group < 0)
      continue;
    const Vector3 turn = rotation_vector<double>(b.orientation);
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[k];
      const double moved = c < 3 ? (b.position - b.reference)[c] / b.lever : turn[c - 3];
      expect(b, c < 3, std::abs(moved));
    }
  }
  if (s.scales_follow)
    update(0.0);
}

/// Expected motion from the velocities and accelerations at the start, over the time scale of each
/// coordinate or the shorter one of its own stiffness. The constructor adds the distance of
/// floating bodies from the reference pose of their hydrostatics.
void MotionScale::expect_start(const Pattern& pattern, double t, const VectorX& y,
                               const VectorX& yp) {
  JacobianParts parts(pattern);
  JacobianWorkspace workspace(s_);
  jacobian(s_, pattern, workspace, t, y.data(), yp.data(), parts);
  VectorX mass = VectorX::Zero(s_.n), stiffness = VectorX::Zero(s_.n);
  for (Index column = 0; column < s_.z0; ++column)
    for (Index k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k) {
      const Index row = pattern.row[k];
      if (row < s_.u0 || row >= s_.z0)
        continue;
      if (row == column)
        mass[row] = parts.by_yp[k];
      else if (column < s_.n_q)
        stiffness[row] = std::max(stiffness[row], std::abs(parts.by_y[k]));
    }
  for (const BodyData& b : s_.bodies)
    for (int k = 0; k < b.n_active; ++k) {
      const Index u = b.u0 + k;
      const double unit = b.active[k] < 3 ? b.lever : 1.0;
      const double rate = std::max(1.0 / b.time_scale, mass[u] > 0.0 && std::isfinite(stiffness[u])
                                                           ? std::sqrt(stiffness[u] / mass[u])
                                                           : 0.0);
      const double most =
          std::max(std::abs(y[u]) / rate / unit, std::abs(yp[u]) / (rate * rate) / unit);
      expect(b, b.active[k] < 3, most);
    }
}

bool MotionScale::begin_again(const Pattern& pattern, double t, const VectorX& y,
                              const VectorX& yp) {
  if (!s_.scales_follow)
    return false;
  const VectorX expected = std::exchange(state_.expected, VectorX::Zero(s_.n_groups)),
                translation =
                    std::exchange(state_.expected_translation, VectorX::Zero(s_.n_groups));
  expect_start(pattern, t, y, yp);
  bool grows = false;
  for (Index g = 0; g < s_.n_groups; ++g) {
    if (std::min(state_.expected[g] / full, 1.0) > slack_of_scales * s_.motion_scale[g]) {
      state_.since[g] = t;
      grows = true;
    } else {
      state_.expected[g] = expected[g];
      state_.expected_translation[g] = translation[g];
    }
  }
  return grows && update(t);
}

void MotionScale::expect(const BodyData& body, bool translation, double motion) {
  state_.expected[body.group] = std::max(state_.expected[body.group], motion);
  if (translation)
    state_.expected_translation[body.group] =
        std::max(state_.expected_translation[body.group], motion);
}

bool MotionScale::update(double t) {
  bool changed = false;
  const auto set = [&](double& scale, double wanted) {
    if (t > 0.0 && wanted < slack_of_scales * scale && wanted > scale / slack_of_scales)
      return;
    changed = changed || scale != wanted;
    scale = wanted;
  };
  for (Index g = 0; g < s_.n_groups; ++g) {
    const double left = std::exp(-std::max(0.0, (t - state_.since[g]) / hold_[g] - 1.0));
    const auto part = [&](double reached, double expected) {
      return std::clamp(std::max(reached, left * expected) / full, least_[g], 1.0);
    };
    set(s_.motion_scale[g], part(state_.reached[g], state_.expected[g]));
    set(s_.translation_scale[g],
        std::clamp(part(state_.translated[g], state_.expected_translation[g]) / s_.motion_scale[g],
                   least_translation, 1.0));
  }
  if (changed)
    set_scales(s_);
  return changed;
}

void MotionScale::accept(double t, const VectorX& y) {
  bool grown = false;
  const VectorX moved = displacements(s_, start_, y);
  for (std::size_t i = 0; i < s_.bodies.size(); ++i)
    if (const int g = s_.bodies[i].group;
        g >= 0 && moved[static_cast<Index>(i)] > state_.reached[g]) {
      state_.reached[g] = moved[static_cast<Index>(i)];
      grown = true;
    }
  for (const BodyData& b : s_.bodies)
    if (b.group >= 0)
      state_.translated[b.group] = std::max(state_.translated[b.group], translation(b, start_, y));
  if (s_.scales_follow && (grown || (s_.motion_scale.array() > least_.array()).any()))
    update(t);
}

void MotionScale::set(State state) {
  state_ = std::move(state);
  set_scales(s_);
}

std::vector<std::string> MotionScale::notes() const {
  std::vector<std::string> out;
  if (!s_.scales_follow)
    return out;
  for (Index g = 0; g < s_.n_groups; ++g) {
    if (state_.reached[g] == 0.0 || state_.reached[g] / full >= least_[g])
      continue;
    const auto first = std::find_if(s_.bodies.begin(), s_.bodies.end(),
                                    [&](const BodyData& b) { return b.group == g; });
    out.push_back("body '" + first->name + "' moves by " + number_text(state_.reached[g]) +
                  " of its lever only: rounding of its position keeps the tolerance at that of " +
                  number_text(full * least_[g]));
  }
  return out;
}

} // namespace hydrodae::system
