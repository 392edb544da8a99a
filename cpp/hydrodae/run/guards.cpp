#include "hydrodae/run/guards.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/run/state.h"
#include "hydrodae/system/dropped_rows.h"

namespace hydrodae::run {

namespace {

/// Guard of redundant constraint rows, which the assembly left out: their gaps must stay closed.
class DroppedRowsGuard final : public EndGuard {
public:
  DroppedRowsGuard(const system::Regime& s, const SolverOptions& options)
      : rows_(s), allowed_(10.0 * options.tolerance_assembly +
                           (s.formulation == system::Formulation::stabilised ? 100.0 * options.rtol
                                                                             : drifted)) {}
  bool empty() const { return rows_.empty(); }
  void look(const StepEnd& step) override {
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
  /// Largest opening as part of a body's arm, in formulations with drifting constraints.
  static constexpr double drifted = 1e-2;
  system::DroppedRows rows_;
  /// Joints fit within tolerance_assembly, and the rows that hold within rtol of their scale. A
  /// redundant row may be open by a multiple of both.
  double allowed_;
};

/// Guard against positions whose rounding exceeds the tolerance: steps shrink there without end.
/// Rounding is relative to the size of the bodies, because the scale of something that has not
/// moved is almost zero.
class RoundingGuard final : public EndGuard {
public:
  RoundingGuard(const system::Regime& s, double rtol)
      : s_(s), size_(VectorX::Constant(s.lambda0, INFINITY)) {
    constexpr double allowed = 100.0; // tolerances; a sound error test stays below
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
  void look(const StepEnd& step) override {
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
  VectorX size_; ///< (lambda0,) largest positions with acceptable rounding, else infinite
};

/// Guard of friction with a bearing against Painleve's paradox.
class JamGuard final : public Follower {
public:
  JamGuard(const system::Regime& s, const system::Pattern& pattern) : s_(s), pattern_(pattern) {
    make();
  }
  void judge(const Step& step) override {
    if (step.event)
      return; // other rows hold from there on, which the switches check
    y_ = step.y;
    yp_ = step.yp;
    saddle_->accelerations(step.end, y_, yp_);
    if (!saddle_->jam().empty())
      throw SolverError(step.end, {Reason::friction, saddle_->jam()});
  }
  void restart(const Restart&) override { make(); }

private:
  void make() {
    equations_ = std::make_unique<linalg::Equations>(s_, pattern_, 1.0);
    saddle_ = std::make_unique<linalg::SaddlePoint>(*equations_);
  }

  const system::Regime& s_;
  const system::Pattern& pattern_;
  std::unique_ptr<linalg::Equations> equations_;
  std::unique_ptr<linalg::SaddlePoint> saddle_;
  VectorX y_, yp_;
};

std::unique_ptr<EndGuard> make_dropped_rows_guard(const system::Regime& system,
                                                  const SolverOptions& options) {
  auto guard = std::make_unique<DroppedRowsGuard>(system, options);
  if (guard->empty())
    return nullptr;
  return guard;
}

/// Rounding guard; null for steps of fixed length, which do not shrink.
std::unique_ptr<EndGuard> make_rounding_guard(const system::Regime& system,
                                              const SolverOptions& options) {
  if (options.step > 0.0 || system.lambda0 == 0)
    return nullptr;
  return std::make_unique<RoundingGuard>(system, options.rtol);
}

std::unique_ptr<Follower> make_jam_guard(const GuardInputs& in) {
  for (const system::ElementList& list : in.system.elements)
    if (list.laws->shape.n_reaction > 0)
      return std::make_unique<JamGuard>(in.system, in.pattern);
  return nullptr;
}

} // namespace

std::string largest_reactions(const system::Regime& s, const VectorX& y) {
  if (s.n_lambda == 0)
    return "";
  VectorX values = VectorX::Zero(s.n);
  for (Index i = s.lambda0; i < s.mu0; ++i)
    values[i] = y[i] / s.scale[i];
  return "\n  largest reactions, relative to the weights: " + linalg::worst(values, s.names);
}

std::vector<std::unique_ptr<EndGuard>> make_end_guards(const system::Regime& system,
                                                       const SolverOptions& options) {
  std::vector<std::unique_ptr<EndGuard>> out;
  for (const auto make :
       {make_rounding_guard, make_dropped_rows_guard, make_branch_guard, make_turn_guard})
    if (std::unique_ptr<EndGuard> guard = make(system, options))
      out.push_back(std::move(guard));
  return out;
}

Guards::Guards(const system::Regime& system, const system::Pattern& pattern,
               const SolverOptions& options, const VectorX& y)
    : poses_(system, options, y,
             energy_minds_singular_poses(options) || minds_drift(system, options)) {
  const GuardInputs in{system, pattern, options, y, poses_};
  const auto add = [this](std::unique_ptr<Follower> guard) {
    if (guard)
      list_.push_back(std::move(guard));
  };
  add(make_energy_guard(in));
  for (std::unique_ptr<EndGuard>& guard : make_end_guards(system, options))
    add(std::move(guard));
  add(make_drift_guard(in));
  add(make_jam_guard(in));
}

void Guards::judge(const Step& step) {
  for (const std::unique_ptr<Follower>& guard : list_)
    guard->judge(step);
}

void Guards::restart(const Restart& from) {
  poses_.restart(from.y);
  for (const std::unique_ptr<Follower>& guard : list_)
    guard->restart(from);
}

void Guards::finish(const Step& step) {
  for (const std::unique_ptr<Follower>& guard : list_)
    guard->finish(step);
}

void Guards::save(State& out) const {
  out.guards.poses = poses_.state();
  for (const std::unique_ptr<Follower>& guard : list_)
    guard->save(out);
}

void Guards::set(const State& from) {
  restart({from.time, from.y, from.yp, {}});
  poses_.set(from.guards.poses);
  for (const std::unique_ptr<Follower>& guard : list_)
    guard->set(from);
}

} // namespace hydrodae::run
