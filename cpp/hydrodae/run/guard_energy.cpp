/// Guard of the energy balance, which the integrator does not control. Missing energy shows a
/// branch lost in a singular pose, or a tolerance that is too loose.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/system/mass.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::run {

namespace {

constexpr double usual = 1e-2; ///< allowed part of the energy exchanged
/// Part of `energy_of_errors` that is the error of one step, not of a hundred
constexpr double little = 1e-2;

/// Part of the potential energy m g L of a body that rounding may lose: 2e-16 in each of 5000
/// steps.
constexpr double rounded_off = 1e-12;

/// Energy exchanged that a wrong step cannot have produced itself [J]: ten times the exchange
/// before the step, or the kinetic energy at its end.
double believed(const measure::Balance& before, const measure::Balance& now) {
  constexpr double more = 10.0;
  return std::min(now.exchanged, std::max(more * before.exchanged, now.kinetic));
}

/// Part of the energy exchanged that may be missing at a singular pose of a loop, where energy and
/// motion are lost together. The relative error of the motion was 10 times (slider crank with equal
/// bars) to 200 times (two four-bar windows, ten seconds) as large. The limit thus allows a few
/// sqrt(rtol), or a few hundredths with fixed steps.
double guard_at_singular_poses(const SolverOptions& options) {
  return options.step > 0.0 ? 5e-4
                            : std::min(usual, 1e-2 * std::sqrt(std::max(options.rtol, 1e-6)));
}

/// Elastic energy of each body when its coordinates are one unit of position off, 1/2 sum K_cc
/// x_c^2 with the stiffness K at the start [J]: an error within the tolerance holds rtol^2 of it.
VectorX elastic_energies(const GuardInputs& in) {
  const system::Regime& s = in.system;
  system::JacobianWorkspace ws(s);
  system::JacobianParts parts(in.pattern);
  const VectorX rest = VectorX::Zero(s.n);
  system::jacobian(s, in.pattern, ws, 0.0, in.y.data(), rest.data(), parts);
  VectorX out = VectorX::Zero(static_cast<Index>(s.bodies.size()));
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    MatrixX K = MatrixX::Zero(b.n_active, b.n_position);
    for (Index c = 0; c < b.n_position; ++c)
      for (Index e = in.pattern.column_start[b.q0 + c]; e < in.pattern.column_start[b.q0 + c + 1];
           ++e)
        if (const Index r = in.pattern.row[e] - b.u0; r >= 0 && r < b.n_active)
          K(r, c) = parts.by_y[e];
    if (b.rotation == system::BodyData::Rotation::free) { // by the rotation vector
      const Eigen::Vector4d p = in.y.segment<4>(b.q0 + b.n_translations);
      K.middleCols<3>(b.n_translations) =
          (0.5 * K.rightCols<4>() * quaternion_rate_matrix<double>(p)).eval();
    }
    for (int c = 0; c < b.n_active; ++c) {
      const double unit = b.active[c] < 3 ? b.length_scale : b.length_scale / b.lever;
      out[static_cast<Index>(i)] += 0.5 * std::max(K(c, c), 0.0) * unit * unit;
    }
  }
  return out;
}

class EnergyGuard final : public Follower {
public:
  explicit EnergyGuard(const GuardInputs& in)
      : s_(in.system), rtol_(in.options.rtol), part_(allowed_energy(in.options)),
        at_singular_(in.options.energy_guard ? part_ : guard_at_singular_poses(in.options)),
        elastic_(elastic_energies(in)), guided_(system::guided_mechanisms(in.system)),
        poses_(in.poses) {}

  /// Judges the balance of the scene, then that of each mechanism.
  void judge(const Step& step) override {
    const measure::Measure& measure = step.measure;
    const std::vector<measure::Balance>& mechanisms = measure.mechanisms();
    judge(step, -1, measure.whole().error, believed(measure.whole_before(), measure.whole()));
    for (std::size_t m = 0; m < mechanisms.size(); ++m)
      judge(step, static_cast<int>(m), mechanisms[m].error,
            believed(measure.mechanisms_before()[m], mechanisms[m]));
  }

  /// Judges the balance of the whole run, with almost no energy too small to judge.
  void finish(const Step& step) override {
    const auto look = [&](int mechanism, double error, double exchanged) {
      const double part = std::max(allowed(mechanism), usual);
      if (std::abs(error) - least(mechanism, little) > part * exchanged)
        fail(step.end, mechanism, {error, part, exchanged}, " in the whole run",
             "a smaller tolerance or max_step may help", "");
    };
    const measure::Measure& measure = step.measure;
    look(-1, measure.whole().error, measure.whole().exchanged);
    for (std::size_t m = 0; m < measure.mechanisms().size(); ++m)
      look(static_cast<int>(m), measure.mechanisms()[m].error, measure.mechanisms()[m].exchanged);
  }

private:
  struct Excess {
    double error;        ///< error of the balance [J]
    double allowed_part; ///< allowed part of the energy exchanged [-]
    double exchanged;    ///< energy exchanged [J]
  };

  void judge(const Step& step, int mechanism, double error, double exchanged) {
    if (std::abs(error) <= std::min(part_, at_singular_) * exchanged)
      return;
    // A method that would fail at the end of the run is replaced while that is possible.
    const double spared = least(mechanism, step.may_change ? little : 1.0),
                 missing = std::abs(error) - spared, part = allowed(mechanism);
    if (missing <= std::min(part, at_singular_) * exchanged)
      return;
    const bool singular = missing <= part * exchanged;
    if (singular && !poses_.near_singular(step))
      return;
    fail(step.end, mechanism, {error, singular ? at_singular_ : part, exchanged},
         singular ? ", at a singular pose" : "",
         std::string("a smaller tolerance or step, or another method may help") +
             (singular ? " (radau and explicit_rk pass singular poses)" : ""),
         largest_reactions(s_, step.y));
  }

  /// Energy of errors within the tolerance [J]: `part` of the kinetic energy of a hundred steps, or
  /// the elastic energy of positions that are off by their sum, the root of a hundred tolerances.
  double least(int mechanism, double part) const {
    double out = part * energy_of_errors(s_, rtol_, mechanism);
    for (std::size_t i = 0; i < s_.bodies.size(); ++i)
      if (const system::BodyData& b = s_.bodies[i];
          b.group >= 0 && (mechanism < 0 || b.mechanism == mechanism)) {
        const double error = 10.0 * rtol_ * s_.motion_scale[b.group];
        out = std::max(out, error * error * elastic_[static_cast<Index>(i)]);
      }
    return out;
  }

  /// Allowed part of the energy. In mechanisms that drives guide fully, it is larger: the energy
  /// then measures the reactions, which are one derivative less exact, and hardly the motion.
  double allowed(int mechanism) const {
    constexpr double more = 10.0;
    const bool guided = mechanism >= 0
                            ? guided_[static_cast<std::size_t>(mechanism)]
                            : std::all_of(guided_.begin(), guided_.end(), [](bool g) { return g; });
    return guided ? more * part_ : part_;
  }

  /// Names of the bodies, " of 'crank', 'rod'"; empty for the whole scene (-1).
  std::string members(int mechanism) const {
    if (mechanism < 0)
      return "";
    std::vector<std::string> names;
    for (const system::BodyData& b : s_.bodies)
      if (b.mechanism == mechanism && names.size() < 4)
        names.push_back(in_quotes(b.name));
    return " of " + joined(names);
  }

  [[noreturn]] void fail(double t, int mechanism, const Excess& e, const std::string& where,
                         const std::string& advice, const std::string& details) const {
    throw SolverError(
        t, {Reason::energy,
            "the energy balance" + members(mechanism) + " is off by " + number_text(e.error) +
                " J, more than " + number_text(e.allowed_part) + " of the " +
                number_text(e.exchanged) + " J exchanged" + where +
                " (solver.energy_guard): the motion is not to be trusted",
            "",
            {{"error", e.error}, {"allowed_part", e.allowed_part}, {"exchanged", e.exchanged}},
            advice,
            details});
  }

  const system::Regime& s_;
  double rtol_, part_, at_singular_;
  VectorX elastic_;          ///< (n_bodies,) elastic energy of one unit of position [J]
  std::vector<bool> guided_; ///< true for mechanisms that joints and drives leave no free motion
  PoseWatch& poses_;
};

} // namespace

bool energy_minds_singular_poses(const SolverOptions& options) {
  return !options.energy_guard && guard_at_singular_poses(options) < usual;
}

/// Energy of errors within the tolerance: 100 rtol m v^2 with the unit speed of the scales. Mass m
/// includes the added mass, whose kinetic energy is in the balance.
double energy_of_errors(const system::Regime& s, double rtol, int mechanism) {
  double out = 0.0;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    if (b.group < 0 || (mechanism >= 0 && b.mechanism != mechanism))
      continue;
    double mass = b.mass;
    for (int c = 0; c < 3; ++c)
      mass = std::max(mass, system::wet_mass(s, static_cast<int>(i), c));
    const double speed = b.length_scale / b.time_scale * s.motion_scale[b.group],
                 full = b.lever / b.time_scale; // its square is that of a fall over the lever
    out = std::max({out, std::min(100.0 * rtol, 0.1) * mass * speed * speed,
                    rounded_off * mass * full * full});
  }
  return out;
}

double allowed_energy(const SolverOptions& options) { return options.energy_guard.value_or(usual); }

/// Energy guard; null if its allowed part is zero.
std::unique_ptr<Follower> make_energy_guard(const GuardInputs& in) {
  if (allowed_energy(in.options) == 0.0)
    return nullptr;
  return std::make_unique<EnergyGuard>(in);
}

} // namespace hydrodae::run
