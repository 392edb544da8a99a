/// Reading and writing a Simulation by name.

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/core/unit.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::run {

void Simulation::sample(double t, std::span<double> row) {
  const auto closed = [this](double at, VectorX& y, VectorX& yp) {
    at_(at, y, yp);
    if (!closing_)
      return;
    if (!at_rest())
      closing_->close(at, y);
    if (at_rest() || method_traits(options_.method).loose_reactions)
      closing_->hold(at, y, yp);
  };
  recorder_->sample(t, closed, row.first(recorder_->width()));
  fill_counts(row);
}

void Simulation::look(double t, VectorX& y) {
  y = y_;
  if (t >= t_)
    return;
  VectorX yp(y_.size());
  inside_(t, y, yp);
}

/// The columns behind those of the recorder.
void Simulation::fill_counts(std::span<double> row) const {
  const linalg::Statistics s = integrator_->statistics();
  double* out = row.data() + recorder_->width();
  *out++ = s.last_step;
  *out++ = s.last_order;
  impacts_.fill(switching_.get(), out);
  out += impacts_.width();
  if (controllers_)
    controllers_->fill(out);
}

/// All channels now.
std::span<const double> Simulation::row_now() {
  if (now_.empty()) {
    now_.resize(width_);
    recorder_->look(y_, yp_, std::span(now_).first(recorder_->width()));
    fill_counts(now_);
  }
  return now_;
}

std::span<const double> Simulation::read(const std::string& channel) {
  take_inputs();
  const std::span<const double> row = row_now();
  std::size_t column = 0;
  std::vector<std::string> names;
  for (const Channel& c : channels_) {
    if (c.path == channel)
      return row.subspan(column, static_cast<std::size_t>(c.width));
    column += static_cast<std::size_t>(c.width);
    names.push_back(c.path);
  }
  if (const std::size_t dot = channel.rfind('.'); dot != std::string::npos)
    return row.subspan(find_column(channels_, channel), 1);
  throw CaseError("there is no channel " + in_quotes(channel) + suggestion(channel, names));
}

void Simulation::write(const std::string& input, double value) {
  Input& target = input_named(inputs_, input);
  for (const model::Controller& c : scene_.controllers)
    for (const std::string& output : c->outputs)
      if (signal_of(output).name == target.name)
        throw CaseError("input " + in_quotes(input) + " is what controller " + in_quotes(c->name) +
                        " of the case writes; expected one that no controller holds");
  check_value(target, value);
  if (target.set(t_, value))
    written_ = true;
}

/// Before the motion goes on: controllers that are due see it, and act on it.
void Simulation::take_control() {
  if (!controllers_ || !controllers_->is_due(t_, event_here_))
    return;
  take_inputs();
  failed_ = true; // until all have answered
  control_since_ = t_;
  if (controllers_->act(t_, event_here_, row_now()))
    written_ = true;
  constexpr double far = 100.0; // levers or rad: no device is meant to go there
  if (const VectorX& reached = scale_->reached(); reached.size() > 0 && reached.maxCoeff() > far)
    if (const std::string why = controllers_->runaway(); !why.empty())
      throw SolverError(t_, {Reason::growth, why});
  event_here_ = false;
  failed_ = false;
}

void Simulation::close(const std::string& error) {
  if (controllers_)
    controllers_->finish(error);
}

std::vector<std::string> Simulation::unit_notes() const {
  return controllers_ ? controllers_->unit_notes() : std::vector<std::string>();
}

std::vector<Controllers::Cost> Simulation::controller_costs() const {
  return controllers_ ? controllers_->costs() : std::vector<Controllers::Cost>();
}

/// Before the motion goes on, or is looked at: accelerations that belong to the inputs.
void Simulation::take_inputs() {
  if (!written_)
    return;
  require_going();
  written_ = false;
  now_.clear();
  failed_ = true; // until there are accelerations
  restart();
  failed_ = false;
}

} // namespace hydrodae::run
