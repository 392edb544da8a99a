#pragma once
/// Law of a sampled controller. It reads values at its sampling instants only, and its outputs hold
/// until the next ones; it is never called inside a residual.

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/core/unit.h"

namespace hydrodae::control {

/// Value that a controller reads or writes.
struct Terminal {
  std::string name, unit; ///< "joints/slide/displacement_rate", "m/s" or as the case has it, "mm/s"
  double start = 0.0;     ///< outputs: value that holds before the first answer
  std::string own_unit;   ///< unit in the scene, of the channel or input
  Conversion to_own;      ///< conversion from `unit` to `own_unit`
};

/// Connections of a controller.
struct Terminals {
  std::vector<Terminal> inputs, outputs;
  double end_time = 0.0; ///< end time of the run [s]
};

/// Exception that ends the run on request, like Ctrl-C: not an error.
struct Stopped : Error {
  using Error::Error;
};

class Law {
public:
  virtual ~Law() = default;

  /// Samples the law at an instant.
  /// @param in   (n_inputs,) SI units
  /// @param out  (n_outputs,) last outputs; the new ones hold from now on, or after the delay
  /// Throws SolverError if there is no output, Stopped to end the run.
  virtual void sample(double t, std::span<const double> in, std::span<double> out) = 0;

  /// Returns whether it is also sampled at the events of stops and dry friction.
  virtual bool hears_events() const { return false; }

  /// Returns whether it is due now at any time, because of events since its last sample.
  virtual bool is_due() const { return false; }

  /// Returns whether its first input is the rate of a joint whose changes of sign are events for
  /// it.
  virtual bool hears_crossings() const { return false; }

  /// Notes that the first input crosses zero at t, before the sample there.
  virtual void crossed(double) {}

  /// Next sampling instant after one at `t` [s], in place of a fixed period; NaN: the period holds.
  virtual double next_time(double) const { return NAN; }

  /// State that its outputs depend on besides the arguments, as bytes.
  virtual std::string state() { return ""; }
  virtual void set(const std::string&) {}

  /// Called after `restore`: the time is no longer that of the last step.
  virtual void restored(double) {}

  /// Notes on values that it converts to other units; known after the first sample.
  virtual std::vector<std::string> unit_notes() const { return {}; }

  /// Ends the run: completed, or stopped by the error of this message.
  virtual void finish(const std::string&) {}
};

/// Law whose outputs depend on a plain struct.
template <class State> class StatefulLaw : public Law {
public:
  std::string state() override { return to_bytes(state_); }
  void set(const std::string& bytes) override { state_ = from_bytes<State>(bytes); }

protected:
  State state_;
};

} // namespace hydrodae::control
