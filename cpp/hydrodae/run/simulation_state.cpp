/// Saving and restoring a Simulation.

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/sha256.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::run {

const std::string& Simulation::fingerprint() {
  if (fingerprint_.empty())
    fingerprint_ = io::sha256_of_text(std::string(HYDRODAE_VERSION) + '\n' + scene_.text + '\n' +
                                      joined(scene_.overrides, "\n")) +
                   '\n' + model::text_of_files(scene_.files);
  return fingerprint_;
}

void Simulation::require_same(const std::string& scene) {
  const std::size_t files = fingerprint().find('\n') + 1;
  if (scene.compare(0, files, fingerprint(), 0, files) != 0)
    throw CaseError("the state is of another case or version of hydrodae than this run");
  if (const std::string changed =
          model::changed_file(scene.substr(files), fingerprint().substr(files));
      !changed.empty())
    throw CaseError("the state is of a run with other inputs than this one: " + changed);
}

void Simulation::remember(Archive& a) {
  std::vector<system::Regime::Mode> modes = regime_.modes;
  a(step_start_, last_start_, event_near_, quadrature_nodes_, before_start_, modes, methods_,
    event_here_, highest_order_, control_since_);
  for (const Input& input : inputs_)
    a(*input.value);
  for (const Input& input : inputs_)
    if (system::Lag* lag = input.lag())
      a(*lag);
  a(*law_events_);
  if (modes.size() != system_.switches.size())
    throw Error("the state has other switches than the scene");
  for (std::size_t k = 0; k < modes.size() && !a.saves(); ++k)
    system::set_mode(regime_, system_.switches[k], modes[k]);
}

State Simulation::state() {
  require_going();
  take_inputs();
  State out;
  out.time = t_;
  out.y = y_;
  out.yp = yp_;
  out.scene = fingerprint();
  const linalg::Statistics before = before_start_;
  before_start_ = statistics(); // counts of this integrator end here, as those of any other
  save(out.memory, "run", *this);
  before_start_ = before;
  save(out.memory, "measure", *measure_);
  save(out.memory, "scales", *scale_);
  save(out.memory, "integrator", *integrator_);
  save(out.memory, "guards", *guards_);
  if (switching_)
    save(out.memory, "switching", *switching_);
  if (history_)
    save(out.memory, "history", *history_);
  if (controllers_)
    save(out.memory, "controllers", *controllers_);
  set(out);
  return out;
}

void Simulation::restore(const State& state) {
  set(state);
  if (controllers_)
    controllers_->restored(t_);
}

void Simulation::set(const State& state) {
  using hydrodae::restore;
  require_same(state.scene);
  const Memory& memory = state.memory;
  written_ = false;
  failed_ = true; // until all is restored
  now_.clear();
  t_ = state.time;
  y_ = state.y;
  yp_ = state.yp;
  restore(memory, "run", *this); // the modes of the switches with it
  use_method();
  restore(memory, "measure", *measure_);
  if (switching_) {
    system::lay_out(regime_);
    restore(memory, "switching", *switching_);
  }
  restore(memory, "scales", *scale_);
  if (y_.size() != regime_.n || yp_.size() != regime_.n)
    throw Error("the state has other unknowns than the scene");
  pattern_ = system::find_pattern(regime_);
  follow_turns();
  if (history_)
    restore(memory, "history", *history_);
  if (controllers_)
    restore(memory, "controllers", *controllers_);
  if (switching_)
    switching_->resume(t_, y_, yp_);
  consistency_.reset(); // its pivots are those of its past
  make_integrator();
  restore(memory, "integrator", *integrator_);
  guards_->restart(y_);
  restore(memory, "guards", *guards_);
  failed_ = false;
}

} // namespace hydrodae::run
