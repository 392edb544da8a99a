#include "hydrodae/session/second_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hydrodae/control/law.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/run/controllers.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::session {

namespace {

/// Ratio of the tolerance of the second run to that of the first
constexpr double looser = 10.0;
/// Largest rtol of a second run; above it steps do not follow a tolerance
constexpr double largest_rtol = 1e-2;

/// Outputs of a controller, each with its sampling instant [s].
using Answers = std::vector<std::pair<double, std::vector<double>>>;

/// Law that forwards to another law and records its outputs.
class RecordingLaw final : public control::Law {
public:
  RecordingLaw(std::unique_ptr<control::Law> law, std::shared_ptr<Answers> answers)
      : law_(std::move(law)), answers_(std::move(answers)) {}
  void sample(double t, std::span<const double> in, std::span<double> out) override {
    law_->sample(t, in, out);
    answers_->emplace_back(t, std::vector<double>(out.begin(), out.end()));
  }
  bool hears_events() const override { return law_->hears_events(); }
  bool is_due() const override { return law_->is_due(); }
  bool hears_crossings() const override { return law_->hears_crossings(); }
  void crossed(double t) override { law_->crossed(t); }
  double next_time(double t) const override { return law_->next_time(t); }
  std::string state() override { return to_bytes(State{law_->state(), *answers_}); }
  void set(const std::string& bytes) override {
    auto from = from_bytes<State>(bytes);
    law_->set(from.law);
    *answers_ = std::move(from.answers);
  }
  void restored(double t) override { law_->restored(t); }
  std::vector<std::string> unit_notes() const override { return law_->unit_notes(); }
  void finish(const std::string& error) override { law_->finish(error); }

private:
  struct State {
    std::string law;
    Answers answers;
  };
  std::unique_ptr<control::Law> law_;
  std::shared_ptr<Answers> answers_;
};

/// Law that repeats recorded outputs: at each instant the last one not later.
class RepeatingLaw final : public control::Law {
public:
  explicit RepeatingLaw(std::shared_ptr<const Answers> answers) : answers_(std::move(answers)) {}
  void sample(double t, std::span<const double>, std::span<double> out) override {
    // instants of one clock differ by rounding
    const double now = t + 1e-9 * std::max(1.0, std::abs(t));
    auto next = std::upper_bound(answers_->begin(), answers_->end(), now,
                                 [](double time, const auto& a) { return time < a.first; });
    if (next != answers_->begin())
      std::copy(std::prev(next)->second.begin(), std::prev(next)->second.end(), out.begin());
  }

private:
  std::shared_ptr<const Answers> answers_;
};

/// Sets the laws of the second run: new ones if they can be made again, else recorded outputs.
/// @returns names of the controllers with repeated outputs
std::vector<std::string> part_controllers(model::Scene& first, model::Scene& second) {
  std::vector<std::string> repeated;
  for (std::size_t k = 0; k < first.controllers.size(); ++k) {
    auto* one = first.controllers[k].as<control::Outside>();
    if (!one || !one->make)
      continue;
    auto* other = second.controllers[k].as<control::Outside>();
    if (one->make_again) {
      other->make = one->make_again;
      continue;
    }
    repeated.push_back(in_quotes(one->name));
    const auto answers = std::make_shared<Answers>();
    one->make = [make = one->make, answers](const control::Terminals& terminals) {
      return std::make_unique<RecordingLaw>(make(terminals), answers);
    };
    other->make = [answers](const control::Terminals&) {
      return std::make_unique<RepeatingLaw>(answers);
    };
  }
  return repeated;
}

/// Divisor c - 1, if errors grow c times from the first run to the second. Errors of fixed steps h
/// are of order h^p; constraints reduce the order p of stages to s + 1 with s = p / 2. Error
/// control keeps the error of each step, of order h^(p + 1), at rtol, so that the error of the run
/// is of order rtol^(p / (p + 1)).
double divisor(const SecondRunPlan& plan, int order) {
  if (plan.ratio == 1.0)
    return 1.0;
  const double p = std::max(order, 1);
  const bool fixed = plan.scene.solver.step > 0.0;
  return std::pow(plan.ratio, fixed ? std::min(p, 0.5 * p + 1.0) : p / (p + 1.0)) - 1.0;
}

/// Returns whether firm bounds limit the steps: a longest step, instants of controllers, or a past
/// that loads depend on. Runs with looser tolerance would take the same steps and make the same
/// error.
bool has_firm_bounds(const model::Scene& scene) {
  bool late = false;
  model::for_each_force(scene, [&](const auto& force) {
    if constexpr (requires { force.delay; })
      late = late || force.delay > 0.0;
  });
  return late || scene.solver.max_step > 0.0 || !scene.controllers.empty() ||
         (scene.hydro && scene.hydro->reads().kernel);
}

} // namespace

SecondRunPlan plan_second_run(model::Scene& scene, const std::string& method) {
  SecondRunPlan plan;
  plan.scene = scene;
  SolverOptions& o = plan.scene.solver;
  if (!method.empty()) {
    o.method = method;
    o.order = 0;
    o.step = 0.0;
    plan.how = "a second run with " + method;
  } else if (o.step > 0.0) {
    o.step *= 2.0;
    plan.ratio = 2.0;
    plan.how = "a second run with steps of " + number_text(o.step) + " s";
  } else {
    const bool tighter = looser * o.rtol > largest_rtol || has_firm_bounds(scene);
    plan.looser = tighter ? 1.0 / looser : looser;
    o.rtol *= plan.looser;
    plan.ratio = tighter ? 1.0 : looser;
    plan.how = "a second run at rtol = " + number_text(o.rtol);
  }
  const std::vector<std::string> repeated = part_controllers(scene, plan.scene);
  if (!repeated.empty())
    plan.how += ", with the recorded answers of controller " + joined(repeated);
  plan.afterwards = run::asks_outside(scene);
  return plan;
}

SecondRun::SecondRun(SecondRunPlan plan, accuracy::Comparison& comparison,
                     const run::Checkpoint* from)
    : plan_(std::move(plan)), comparison_(comparison) {
  if (from) {
    comparison_.set(from_bytes<accuracy::Comparison::State>(from->comparison));
    next_ = from->next;
    from_ = from->second;
    stopped_ = from->stopped;
  }
  if (plan_.afterwards || (from && !from_))
    return;
  has_ended_ = false;
  thread_ = std::thread([this] { march({}); });
}

void SecondRun::save(run::Checkpoint& checkpoint) {
  comparison_.let_pass(true);
  std::unique_lock lock(mutex_);
  asked_ = true;
  changed_.wait(lock, [&] { return waits_ || has_ended_; });
  asked_ = waits_ = false;
  if (!has_ended_)
    checkpoint.second = std::move(saved_);
  checkpoint.stopped = stopped_;
  checkpoint.comparison = to_bytes(comparison_.state());
  checkpoint.next = next_;
  changed_.notify_all();
  lock.unlock();
  comparison_.let_pass(false);
}

void SecondRun::stop_for_save(run::Simulation& simulation, long next) {
  std::unique_lock lock(mutex_);
  saved_ = simulation.state();
  next_ = next;
  waits_ = true;
  changed_.notify_all();
  changed_.wait(lock, [&] { return !waits_; });
}

void SecondRun::end() {
  comparison_.end_second();
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  changed_.notify_all();
}

SecondRun::~SecondRun() { give_up(); }

void SecondRun::march(const std::function<bool()>& ask) {
  try {
    run::Simulation simulation(plan_.scene, plan_.looser);
    accuracy::Movers movers(simulation.regime());
    VectorX y, places;
    const double end = plan_.scene.solver.end_time, dt = plan_.scene.output.step;
    const auto samples = static_cast<long>(std::floor(end / dt * (1.0 + 1e-12)));
    long next = next_;
    bool wanted = true;
    if (from_)
      simulation.restore(*from_);
    const auto sample = [&] {
      const double t = simulation.time();
      while (wanted && next <= samples && static_cast<double>(next) * dt <= t * (1.0 + 1e-14)) {
        simulation.look(std::min(static_cast<double>(next) * dt, t), y);
        ++next;
        movers.places(y, places);
        wanted = comparison_.second(places) && (!ask || ask());
      }
    };
    sample();
    while (wanted && !given_up_ && !simulation.finished()) {
      if (asked_)
        stop_for_save(simulation, next);
      simulation.advance(end, sample);
    }
    if (next <= samples)
      stopped_ = "the runs were stopped";
    simulation.close();
  } catch (const SolverError& error) {
    Halt halt = error.halt;
    halt.details.clear();
    stopped_ = plan_.how + " " + message_of(error.time, halt);
  } catch (const std::exception& error) {
    stopped_ = plan_.how + " " + error.what();
  }
  this->end();
}

void SecondRun::finish(const std::function<bool()>& ask) {
  comparison_.end_first();
  if (plan_.afterwards)
    return march(ask);
  while (!comparison_.wait_for_second())
    if (!ask())
      return give_up();
  give_up(); // the run has ended
}

void SecondRun::give_up() {
  given_up_ = true;
  comparison_.end_first();
  if (thread_.joinable())
    thread_.join();
}

accuracy::Estimate SecondRun::estimate(int order) const {
  accuracy::Estimate out = comparison_.estimate(divisor(plan_, order));
  out.how = plan_.how;
  out.missing = stopped_;
  return out;
}

} // namespace hydrodae::session
