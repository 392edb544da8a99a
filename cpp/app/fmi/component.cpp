#include "component.h"

#include <cmath>
#include <cstdio>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/tcp.h"

namespace hydrodae::fmi {

namespace {

using Sort = Variable::Kind;

/// Tolerance in steps: communication points k h and t + h differ by rounding.
constexpr double nearness = 1e-9;

std::string toml_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Text as a basic string of TOML.
std::string toml_text(const std::string& value) {
  std::string out = "\"";
  for (const char c : value) {
    char code[8];
    std::snprintf(code, sizeof code, "\\u%04X", static_cast<unsigned char>(c));
    const bool plain = static_cast<unsigned char>(c) >= ' ' && c != '"' && c != '\\' && c != 127;
    out += plain ? std::string(1, c) : code;
  }
  return out + "\"";
}

} // namespace

Component::Component(const std::string& resources) : contents_(read_contents(resources)) {
  reset();
}

void Component::require(const char* function, Phase phase) const {
  static constexpr const char* names[] = {"before it is initialised", "in initialization mode",
                                          "behind it", "that is terminated"};
  if (phase_ != phase)
    throw CaseError(std::string(function) + " is for an instance " +
                    names[static_cast<int>(phase)] + ", and this one is " +
                    (phase_ == Phase::instantiated   ? "not initialised: the run has not begun"
                     : phase_ == Phase::initialising ? "in initialization mode"
                     : phase_ == Phase::stepping     ? "behind it; a reset starts it again"
                                                     : "terminated; a reset starts it again"));
}

void Component::reset() {
  run_.reset();
  phase_ = Phase::instantiated;
  end_time_ = 0.0;
  held_.clear();
  texts_.clear();
  for (const auto& [reference, v] : contents_.variables)
    if (v.type == Type::text)
      texts_[reference] = v.text;
    else if (v.kind == Sort::parameter || v.kind == Sort::input)
      held_[reference] = v.start;
}

std::string Component::toml_value(Reference reference, const Variable& v) const {
  if (v.type == Type::text)
    return toml_text(texts_.at(reference));
  const double value = held_.at(reference);
  if (v.type == Type::boolean)
    return value != 0.0 ? "true" : "false";
  return toml_number(value);
}

void Component::begin(double start, std::optional<double> stop) {
  require("EnterInitializationMode", Phase::instantiated);
  if (start != 0.0)
    throw CaseError("a run begins at t = 0 s, not at the start time " + number_text(start) + " s");
  if (stop && !std::isfinite(*stop))
    throw CaseError("a stop time of " + number_text(*stop) + " s: expected a finite number");
  begin(stop.value_or(0.0));
  phase_ = Phase::initialising;
}

void Component::enter() {
  require("ExitInitializationMode", Phase::initialising);
  phase_ = Phase::stepping;
}

void Component::begin(double end_time) {
  io::Overrides values = contents_.overrides;
  for (const auto& [reference, v] : contents_.variables)
    if (v.kind == Sort::parameter &&
        (v.type == Type::text ? texts_[reference] != v.text : held_[reference] != v.start))
      values[v.name] = toml_value(reference, v);
  model::Scene scene = io::read_case(contents_.case_path, values);
  if (end_time > scene.solver.end_time) {
    values["solver.end_time"] = toml_number(end_time);
    scene = io::read_case(contents_.case_path, values);
  }
  cosim::join_tcp(scene);
  run_.reset(); // it may hold the port of the new one
  phase_ = Phase::instantiated;
  try {
    run_ = std::make_unique<run::Simulation>(scene);
  } catch (const ModelError& error) {
    throw model::located(scene, error);
  }
  end_time_ = end_time;
  inputs_.clear();
  for (std::size_t k = 0; k < run_->inputs().size(); ++k)
    inputs_[run_->inputs()[k].name] = k;
  for (const auto& [reference, v] : contents_.variables)
    if (v.kind == Sort::input)
      run_->write(v.name, held_[reference]);
}

const Variable& Component::variable(Reference reference) const {
  const auto found = contents_.variables.find(reference);
  if (found == contents_.variables.end())
    throw CaseError("there is no variable with the reference " + std::to_string(reference));
  return found->second;
}

const Variable& Component::variable(Reference reference, Type type) const {
  static constexpr const char* names[] = {"number", "integer", "boolean", "string"};
  const Variable& v = variable(reference);
  if (v.type != type)
    throw CaseError("variable " + in_quotes(v.name) + " is a " + names[static_cast<int>(v.type)] +
                    ", asked for as a " + names[static_cast<int>(type)]);
  return v;
}

const Variable& Component::settable(Reference reference, Type type) const {
  const Variable& v = variable(reference, type);
  if (phase_ == Phase::terminated)
    throw CaseError(in_quotes(v.name) + " cannot be set, as the run is terminated");
  const bool can = v.kind == Sort::input || (v.kind == Sort::parameter && !run_);
  if (!can)
    throw CaseError(in_quotes(v.name) + (v.kind == Sort::parameter
                                             ? " is fixed since the run has begun"
                                             : " is an output, which nobody sets"));
  return v;
}

void Component::set(Reference reference, Type type, double value) {
  const Variable& v = settable(reference, type);
  if (run_)
    run_->write(v.name, value);
  held_[reference] = value;
}

void Component::set_text(Reference reference, const std::string& value) {
  settable(reference, Type::text);
  texts_[reference] = value;
}

const std::string& Component::get_text(Reference reference) const {
  variable(reference, Type::text);
  return texts_.at(reference);
}

double Component::get(Reference reference, Type type) {
  const Variable& v = variable(reference, type);
  if (v.kind == Sort::time)
    return time();
  if (v.kind == Sort::parameter || (v.kind == Sort::input && !run_))
    return held_[reference];
  if (!run_)
    throw CaseError(in_quotes(v.name) + " has no value before the run begins");
  return v.kind == Sort::input ? *run_->inputs()[inputs_.at(v.name)].value
                               : run_->read(v.name).front();
}

void Component::step(double t, double h) {
  require("DoStep", Phase::stepping);
  if (!(h > 0.0 && std::isfinite(h)))
    throw CaseError("a communication step of " + number_text(h) + " s: expected > 0 and finite");
  if (!(std::abs(t - run_->time()) <= nearness * h))
    throw CaseError("a communication step from t = " + number_text(t) + " s, but the run is at " +
                    number_text(run_->time()) + " s");
  const double end = t + h, last = run_->scene().solver.end_time;
  if (end - last > nearness * h)
    throw CaseError("a communication step to t = " + number_text(end) +
                    " s, but the case ends at " + number_text(last) +
                    " s; give the FMU a later stop time before it is initialised");
  const double limit = std::min(end, last);
  while (limit - run_->time() > nearness * h)
    run_->advance(limit);
}

void Component::finish() {
  if (!run_)
    return;
  run_->close();
  phase_ = Phase::terminated;
}

Component::State Component::save() {
  State out{phase_, end_time_, {}, {}, {}};
  for (const auto& [reference, value] : held_)
    out.held.push_back(value);
  for (const auto& [reference, text] : texts_)
    out.texts.push_back(text);
  if (run_)
    out.run = run_->state();
  return out;
}

void Component::load(const State& state) {
  if (state.held.size() != held_.size() || state.texts.size() != texts_.size())
    throw CaseError("the state is that of another FMU");
  bool same = run_ && state.end_time == end_time_;
  auto saved = state.held.begin();
  for (auto& [reference, value] : held_) {
    same = same && (variable(reference).kind == Sort::input || value == *saved);
    value = *saved++;
  }
  auto saved_text = state.texts.begin();
  for (auto& [reference, text] : texts_) {
    same = same && *saved_text == text;
    text = *saved_text++;
  }
  if (!state.run) {
    run_.reset();
    end_time_ = state.end_time;
    phase_ = state.phase;
    return;
  }
  if (!same)
    begin(state.end_time);
  run_->restore(*state.run);
  phase_ = state.phase;
}

} // namespace hydrodae::fmi
