#pragma once
/// What a sampled controller does. It sees numbers at its sampling instants only and answers with
/// numbers that are held until the next answer; it is never called inside a residual.

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/core/unit.h"

namespace hydrodae::control {

/// One number that a controller reads or writes.
struct Terminal {
  std::string name, unit; ///< "joints/slide/displacement_rate", "m/s" or as the case has it, "mm/s"
  double start = 0.0;     ///< of what it writes: the value that holds before its first answer
  std::string own_unit;   ///< of the scene: that of the channel or input
  Conversion to_own;      ///< from `unit` to that
};

/// What a controller is joined to.
struct Terminals {
  std::vector<Terminal> inputs, outputs;
  double end_time = 0.0; ///< of the run [s]
};

/// An answer that is to end the run, as a person would (Ctrl-C): not an error.
struct Stopped : Error {
  using Error::Error;
};

class Law {
public:
  virtual ~Law() = default;

  /// At a sampling instant.
  /// @param in   (n_inputs,) SI units
  /// @param out  (n_outputs,) what was answered last; held from now on, or after the delay
  /// Throws SolverError where there is no answer, Stopped where the run is to end.
  virtual void sample(double t, std::span<const double> in, std::span<double> out) = 0;

  /// Is it sampled at the events of stops and dry friction, too?
  virtual bool hears_events() const { return false; }

  /// Is it due at once, whatever the time, for what the run has come to since it was sampled last?
  virtual bool is_due() const { return false; }

  /// Is its first input the rate of a joint, whose changes of sign are events that it hears?
  virtual bool hears_crossings() const { return false; }

  /// The first input crosses zero at t, before it is sampled there.
  virtual void crossed(double) {}

  /// The next sampling instant that it asks for after one at `t` [s], in place of a fixed period;
  /// no number: the period holds.
  virtual double next_time(double) const { return NAN; }

  /// All that an answer depends on beside its arguments, as bytes.
  virtual std::string state() { return ""; }
  virtual void set(const std::string&) {}

  /// The run has gone to another time than that of its last step.
  virtual void restored(double) {}

  /// Which numbers it turns into other units, in words, one each; known once it was sampled.
  virtual std::vector<std::string> unit_notes() const { return {}; }

  /// The run ends: completed, or stopped by the error of this message.
  virtual void finish(const std::string&) {}
};

/// A law whose answers depend on a plain struct.
template <class State> class StatefulLaw : public Law {
public:
  std::string state() override { return to_bytes(state_); }
  void set(const std::string& bytes) override { state_ = from_bytes<State>(bytes); }

protected:
  State state_;
};

} // namespace hydrodae::control
