#include "hydrodae/run/guards.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/accuracy/energy_guard.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/run/turn_check.h"
#include "hydrodae/system/dropped_rows.h"

namespace hydrodae::run {

namespace {

/// "largest reactions ..." at y, for messages.
std::string reactions(const system::Regime& s, const VectorX& y) {
  if (s.n_lambda == 0)
    return "";
  VectorX values = VectorX::Zero(s.n);
  for (Index i = s.lambda0; i < s.mu0; ++i)
    values[i] = y[i] / s.scale[i];
  return "\n  largest reactions, relative to the weights: " + linalg::worst(values, s.names);
}

class EnergyCheck : public Guard {
public:
  EnergyCheck(const system::Regime& s, accuracy::EnergyGuard guard, PoseWatch& watch)
      : s_(s), guard_(std::move(guard)), watch_(watch) {}
  void check(const Step& step) override {
    guard_.check(
        step.end, step.measure, [&] { return watch_.near_singular(step); },
        [&] { return reactions(s_, step.y); });
  }
  void finish(const Step& step) override { guard_.finish(step.end, step.measure); }

private:
  const system::Regime& s_;
  accuracy::EnergyGuard guard_;
  PoseWatch& watch_;
};

class BranchCheck : public Guard {
public:
  explicit BranchCheck(accuracy::BranchGuard guard) : guard_(std::move(guard)) {}
  void check(const Step& step) override { guard_.check(step.end, step.y); }
  void restart(const Step&) override { guard_.restart(); }
  void remember(Archive& a) override { guard_.remember(a); }

private:
  accuracy::BranchGuard guard_;
};

class DriftCheck : public Guard {
public:
  DriftCheck(const system::Regime& s, PoseWatch& watch)
      : s_(s), guard_(std::make_unique<accuracy::DriftGuard>(s)), watch_(watch) {}
  void check(const Step& step) override {
    guard_->check(step.end, step.y, step.yp);
    if (guard_->misses_singular_poses() && watch_.near_singular(step))
      guard_->fail_at_singular_pose(step.end);
  }
  void restart(const Step&) override { guard_ = std::make_unique<accuracy::DriftGuard>(s_); }

private:
  const system::Regime& s_;
  std::unique_ptr<accuracy::DriftGuard> guard_;
  PoseWatch& watch_;
};

/// Constraint rows that the assembly left out: their gaps prove whether they follow from others.
class DroppedRowsCheck : public Guard {
public:
  DroppedRowsCheck(const system::Regime& s, const SolverOptions& options)
      : rows_(s), allowed_(10.0 * options.tolerance_assembly +
                           (s.formulation == system::Formulation::stabilised ? 100.0 * options.rtol
                                                                             : drifted)) {}
  bool empty() const { return rows_.empty(); }
  void check(const Step& step) override {
    const system::DroppedRows::Gap worst = rows_.largest(step.end, step.y);
    if (worst.part <= allowed_)
      return;
    throw SolverError(
        step.end,
        {Reason::drift,
         worst.name +
             " was left out at the start, as it followed from the other constraints there, "
             "and is " +
             number_text(worst.gap) + " " + worst.unit + " open: the mechanism cannot move so",
         worst.name,
         {{"gap", worst.gap}},
         "move a point or an axis out of line, or make one of the joints a spring_damper",
         ""});
  }

private:
  /// Part of a body's arm up to which formulations that let constraints drift may open a row.
  static constexpr double drifted = 1e-2;
  system::DroppedRows rows_;
  /// Joints fit each other within tolerance_assembly, and the rows that hold are met within rtol of
  /// their scale: a row that follows from them may be open by a multiple of both.
  double allowed_;
};

/// Positions so large that their rounding hides what the tolerance asks for: steps shrink there
/// without end, and no shorter one is better. It is held against the sizes of the bodies, since the
/// scale of what has not moved yet is next to nothing.
class RoundingCheck : public Guard {
public:
  RoundingCheck(const system::Regime& s, double rtol)
      : s_(s), size_(VectorX::Constant(s.lambda0, INFINITY)) {
    constexpr double allowed = 100.0; // tolerances; a sound error test bears some
    const double times = allowed * rtol / rounding;
    for (const system::BodyData& b : s.bodies)
      for (int k = 0; k < b.n_position; ++k)
        size_[b.q0 + k] = times * (k < b.n_translations ? b.lever : 1.0);
    for (const system::Block& block : s.blocks)
      if (block.body < 0 && block.moves)
        system::for_each_point(s.states[static_cast<std::size_t>(block.states)],
                               [&](Index place, Index, double length) {
                                 size_.segment<3>(place).setConstant(times * length);
                               });
  }
  void check(const Step& step) override {
    Index i = 0;
    const double worst = step.y.head(s_.lambda0).cwiseAbs().cwiseQuotient(size_).maxCoeff(&i);
    if (worst <= 1.0)
      return;
    const double reached = step.y[i];
    const std::string& name = s_.names[static_cast<std::size_t>(i)];
    throw SolverError(
        step.end, {Reason::growth,
                   "the motion grows beyond all bounds: " + name + " = " + rounded_text(reached) +
                       " is rounded by " + rounded_text(rounding * std::abs(reached)) +
                       ", a hundred times what solver.rtol allows (is the scene unstable, or "
                       "fed without a loss?)",
                   name,
                   {{"value", reached}}});
  }

private:
  static constexpr double rounding = std::numeric_limits<double>::epsilon();
  const system::Regime& s_;
  VectorX size_; ///< (lambda0,) largest positions whose rounding is bearable, else infinite
};

/// Friction that its joint presses, against Painleve's paradox.
class JamCheck : public Guard {
public:
  JamCheck(const system::Regime& s, const system::Pattern& pattern) : s_(s), pattern_(pattern) {
    begin();
  }
  void check(const Step& step) override {
    if (step.event)
      return; // other rows hold from there on, which the switches look at
    y_ = step.y;
    yp_ = step.yp;
    saddle_->accelerations(step.end, y_, yp_);
    if (!saddle_->jam().empty())
      throw SolverError(step.end, {Reason::friction, saddle_->jam()});
  }
  void restart(const Step&) override { begin(); }

private:
  void begin() {
    equations_ = std::make_unique<linalg::Equations>(s_, pattern_, 1.0);
    saddle_ = std::make_unique<linalg::SaddlePoint>(*equations_);
  }
  const system::Regime& s_;
  const system::Pattern& pattern_;
  std::unique_ptr<linalg::Equations> equations_;
  std::unique_ptr<linalg::SaddlePoint> saddle_;
  VectorX y_, yp_;
};

bool has_pressed_friction(const system::Regime& s) {
  return std::any_of(s.elements.begin(), s.elements.end(), [](const system::ElementList& list) {
    return list.laws->shape.n_reaction > 0;
  });
}

} // namespace

PoseWatch::PoseWatch(const system::Regime& s, const SolverOptions& options, const VectorX& y,
                     bool wanted)
    : s_(s), method_(options.method) {
  if (wanted && accuracy::has_loop(s))
    guard_ = std::make_unique<accuracy::PoseGuard>(s, y);
}

bool PoseWatch::near_singular(const Step& step) {
  const bool short_steps = method_traits(method_).many_steps;
  if (!guard_ || (short_steps && ++asked_ % 4 != 0))
    return false;
  const int looks = short_steps ? 1 : 6;
  for (int k = 1; k <= looks; ++k) {
    const double t = k == looks ? step.end : step.start + (step.end - step.start) * k / looks;
    step.integrator.interpolate(t, y_, yp_);
    if (guard_->near_singular(t, y_, yp_))
      return true;
  }
  return false;
}

Halt PoseWatch::with_remedy(Halt halt, double t, const VectorX& y, const VectorX& yp) {
  if (!guard_ || !guard_->near_singular(t, y, yp))
    return halt;
  if (!halt.advice.empty())
    halt.advice += "; ";
  halt.advice +=
      method_traits(method_).passes_singular_poses
          ? "it is next to a singular pose (a dead point, or bars in line), where the motion may "
            "have no unique way on: a smaller rtol, or a little friction, may help"
          : "it is next to a singular pose (a dead point, or bars in line): solver.method = "
            "\"radau\" or \"explicit_rk\" passes such poses";
  return halt;
}

void PoseWatch::restart(const VectorX& y) {
  if (guard_)
    guard_ = std::make_unique<accuracy::PoseGuard>(s_, y);
}

void PoseWatch::remember(Archive& a) {
  a(asked_);
  if (guard_)
    a(*guard_);
}

std::vector<std::unique_ptr<Guard>> make_guards(const system::Regime& system,
                                                const system::Pattern& pattern,
                                                const SolverOptions& options,
                                                const VectorX& y,
                                                std::unique_ptr<PoseWatch>& watch) {
  std::vector<std::unique_ptr<Guard>> guards;
  accuracy::EnergyGuard energy(system, options);
  const bool drifts = system.formulation != system::Formulation::stabilised && !options.force;
  watch = std::make_unique<PoseWatch>(system, options, y, energy.minds_singular_poses() || drifts);
  guards.push_back(std::make_unique<EnergyCheck>(system, std::move(energy), *watch));
  if (options.step <= 0.0 && system.lambda0 > 0)
    guards.push_back(std::make_unique<RoundingCheck>(system, options.rtol));
  if (auto dropped = std::make_unique<DroppedRowsCheck>(system, options); !dropped->empty())
    guards.push_back(std::move(dropped));
  if (options.branch_guard)
    if (accuracy::BranchGuard branch(system); branch.active())
      guards.push_back(std::make_unique<BranchCheck>(std::move(branch)));
  if (drifts)
    guards.push_back(std::make_unique<DriftCheck>(system, *watch));
  if (has_pressed_friction(system))
    guards.push_back(std::make_unique<JamCheck>(system, pattern));
  if (auto turns = make_turn_check(system, options.rtol))
    guards.push_back(std::move(turns));
  return guards;
}

} // namespace hydrodae::run
