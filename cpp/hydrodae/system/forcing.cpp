#include "hydrodae/system/forcing.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/system/mass.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::system {

namespace {

// Points in a period of the shortest wave, and bounds of the part of that period in one step.
constexpr double points_of_wave = 7.0, least_of_wave = 0.2, most_of_wave = 0.5;
constexpr double most_turn = 12.0; ///< largest turn of a joint in one step [rad]; see turned_angle
constexpr double kept = 0.999;     ///< part of the variance that the counted (longer) waves hold

/// Response to a load per metre of each component, |C| / max(1/T, w)^2: of a body of unit mass
/// whose stiffness follows from its time scale T.
VectorX response(const VectorX& C, const VectorX& omega, double time_scale) {
  VectorX out(C.size());
  for (Index i = 0; i < C.size(); ++i) {
    const double rate = std::max(1.0 / time_scale, omega[i]);
    out[i] = std::abs(C[i]) / (rate * rate);
  }
  return out;
}

/// Number of cells of [0, end], a power of two, with cells no longer than `cell`.
std::size_t cells(double end, double cell, double fewest, double most) {
  const double count = std::clamp(end / cell, fewest, most);
  return std::size_t{1} << static_cast<unsigned>(std::ceil(std::log2(count)));
}

using Parts = std::vector<std::pair<double, double>>; ///< frequency [rad/s], variance

/// Frequency below which all but a thousandth of the variance lies [rad/s].
double highest(Parts parts) {
  std::sort(parts.begin(), parts.end());
  double total = 0.0, below = 0.0;
  for (const auto& [omega, variance] : parts)
    total += variance;
  for (const auto& [omega, variance] : parts) {
    below += variance;
    if (below >= kept * total)
      return omega;
  }
  return 0.0;
}

} // namespace

Forcing::Forcing(const Regime& s, double end, double output_step)
    : motion_(VectorX::Zero(s.n_groups)) {
  add_drives(s, end, output_step);
  add_waves(s);
  add_paths(s);
  add_elements(s, end, output_step);
  for (std::size_t m = 0; m < s.motions.size(); ++m)
    if (s.motions[m].motion.is_angle())
      angles_.push_back(m);
}

void Forcing::expect(const BodyData& body, bool turns, double motion) {
  if (body.group < 0 || !std::isfinite(motion))
    return;
  double& most = motion_[body.group];
  most = std::max(most, turns ? motion : motion / body.lever);
}

void Forcing::add_drives(const Regime& s, double end, double output_step) {
  for (const CouplerData& c : s.couplers) {
    const Drive& d = c.drive;
    const bool sine = d.amplitude != 0.0 && d.period > 0.0;
    if (!sine && d.table.empty() && !d.function && d.rate == 0.0)
      continue;
    double cell = end;
    if (sine)
      cell = std::min(cell, d.period / 32.0);
    for (std::size_t i = 1; i < d.time.size(); ++i)
      cell = std::min(cell, 0.5 * (d.time[i] - d.time[i - 1]));
    const std::size_t count = d.function
                                  ? cells(end, std::min(cell, 0.5 * output_step), 2048.0, 32768.0)
                                  : cells(end, cell, 16.0, 1048576.0);
    std::vector<double> values(count + 1);
    for (std::size_t i = 0; i <= count; ++i)
      values[i] = d(end * static_cast<double>(i) / static_cast<double>(count))[0];
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const MotionData& m = s.motions[static_cast<std::size_t>(c.terms.front().motion)];
    const JointData& j = s.joints[static_cast<std::size_t>(m.joint)];
    for (int body : {j.A.body, j.B.body})
      if (body >= 0) {
        const BodyData& b = s.bodies[static_cast<std::size_t>(body)];
        // A prescribed rate moves the body for its time scale.
        expect(b, m.motion.is_angle(), (*high - *low) * (c.velocity_level ? b.time_scale : 1.0));
      }
    if (sine || !d.table.empty() || d.function)
      tracks_.push_back(
          {"the drive of constraint " + in_quotes(c.name), smooth_windows(values, end), 0});
  }
}

/// Shortest wave that matters. Short waves hold part of the variance of the elevation but hardly
/// move a body. The response of each body counts; for other laws in waves, the elevation.
void Forcing::add_waves(const Regime& s) {
  double most = 0.0;
  for (const ElementList& list : s.elements) {
    const element::WavesFelt waves = list.laws->waves();
    if (waves.omega.size() == 0)
      continue;
    const auto take = [&](const VectorX& squares) {
      Parts parts;
      for (Index i = 0; i < waves.omega.size(); ++i)
        parts.emplace_back(waves.omega[i], squares[i]);
      most = std::max(most, highest(std::move(parts)));
    };
    if (waves.loads.empty())
      take(waves.amplitude.cwiseAbs2());
    for (std::size_t k = 0; k < list.ports.size(); ++k) {
      const PortData& port = list.ports[k];
      if (port.body < 0) // line in the water: it loads bodies only through its ends
        continue;
      const BodyData& b = s.bodies[static_cast<std::size_t>(port.body)];
      if (waves.loads.empty()) {
        expect(b, false, std::sqrt(2.0) * waves.amplitude.norm());
        continue;
      }
      VectorX moved = VectorX::Zero(waves.omega.size()); // squared responses, in levers or rad
      for (int c = 0; c < 6; ++c)
        if (const double mass = wet_mass(s, port.body, c); mass > 0.0) {
          const VectorX answer =
              response(waves.loads[k].row(c).transpose(), waves.omega, b.time_scale) / mass;
          expect(b, c >= 3, std::sqrt(2.0) * answer.norm());
          moved += (c < 3 ? answer / b.lever : answer).cwiseAbs2();
        }
      take(moved);
    }
  }
  if (most > 0.0)
    shortest_wave_ = 2.0 * pi / most;
}

void Forcing::add_paths(const Regime& s) {
  constexpr std::size_t count = 4096;
  for (std::size_t m = 0; m < s.motions.size(); ++m) {
    const JointData& j = s.joints[static_cast<std::size_t>(s.motions[m].joint)];
    if (s.motions[m].motion.kind != joint::FreeMotion::Kind::travels || !j.A.path)
      continue;
    const double length = j.A.path->length();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values(count + 1);
      for (std::size_t i = 0; i <= count; ++i)
        values[i] =
            j.A.path->at_arc(length * static_cast<double>(i) / static_cast<double>(count))[0][axis];
      Curve curve{"the path of joint " + in_quotes(j.name), m, length, {}, {}, 0, 0};
      curve.forward = smooth_windows(values, length);
      std::reverse(values.begin(), values.end());
      curve.backward = smooth_windows(values, length);
      curves_.push_back(std::move(curve));
    }
  }
}

/// Limits that laws declare themselves. Other laws that follow the time are sampled: their loads at
/// the start pose, at rest.
void Forcing::add_elements(const Regime& s, double end, double output_step) {
  Workspace<double> ws(s);
  const VectorX y = initial_state(s), yp = VectorX::Zero(s.n);
  unpack<double>(s, y.data(), yp.data(), ws.bodies);
  const auto samples = [&](double cell) { return cells(end, cell, 2048.0, 32768.0); };
  const auto time = [&](std::size_t i, std::size_t count) {
    return end * static_cast<double>(i) / static_cast<double>(count);
  };
  for (std::size_t l = 0; l < s.elements.size(); ++l) {
    const ElementList& list = s.elements[l];
    const element::Elements& laws = *list.laws;
    for (const element::Schedule& schedule : laws.schedules) {
      const std::size_t count = samples(schedule.finest);
      std::vector<double> values;
      for (std::size_t i = 0; i <= count; ++i)
        values.push_back(schedule.at(time(i, count)));
      tracks_.push_back({schedule.what, smooth_windows(values, end), 0});
    }
    if (!laws.timed)
      continue;
    ElementScratch<double>& scratch = ws.elements[l];
    gather<double>(s, list, ws, y.data(), scratch);
    const std::size_t count = samples(0.5 * output_step);
    std::vector<std::vector<double>> values(scratch.out.size());
    for (std::size_t i = 0; i <= count; ++i) {
      laws.evaluate(time(i, count), scratch.in.data(), s.held(list), scratch.out.data());
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k].push_back(scratch.out[k]);
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      tracks_.push_back({"the force " + in_quotes(laws.names[k * laws.size() / values.size()]),
                         smooth_windows(values[k], end), 0});
  }
}

Forcing::Limit Forcing::limit(const Turns& turns, double gap, double stretch) {
  const double t = turns.time,
               of_wave = std::clamp(1.0 / (points_of_wave * gap), least_of_wave, most_of_wave);
  Limit out{t + stretch * of_wave * shortest_wave_, &waves_};
  const auto take = [&](double time, const std::string& name) {
    if (time < out.time)
      out = {time, &name};
  };
  for (std::size_t m : angles_) // the rates at both ends of a step determine the turns in it
    if (const double rate = std::abs(turns.rate[m]); rate > 0.0)
      take(t + most_turn / rate, turning_);
  for (Track& track : tracks_)
    take(track.windows.reach(t, track.hint), track.name);
  for (Curve& c : curves_) {
    const double rate = turns.rate[c.motion];
    if (rate == 0.0)
      continue;
    const bool forward = rate > 0.0;
    const double place = forward ? turns.value[c.motion] : c.length - turns.value[c.motion];
    std::size_t& hint = forward ? c.forward_hint : c.backward_hint;
    const Windows& windows = forward ? c.forward : c.backward;
    // The path is straight before its first point and behind its last.
    const double reach = place < 0.0 ? windows.reach(0.0, hint) : windows.reach(place, hint);
    take(t + (reach - place) / std::abs(rate), c.name);
  }
  return out;
}

} // namespace hydrodae::system
