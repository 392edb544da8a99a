#pragma once
/// One instance of an FMU, whatever version of FMI asks for it.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contents.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::fmi {

/// Where an importer is in the life of an instance, in both versions of the standard.
enum class Phase { instantiated, initialising, stepping, terminated };

/// A run of the case of the FMU between communication points. Inputs hold from one communication
/// point to the next; parameters are numbers of the case, fixed when the run begins. All throw
/// Error, with a message for the importer.
class Component {
public:
  /// Not begun yet. Reads variables.txt of `resources`.
  explicit Component(const std::string& resources);

  const std::string& token() const { return contents_.token; }

  /// Refuses `function` in any other phase.
  void require(const char* function, Phase phase) const;

  /// Reads the case and makes its run, at t = 0 s.
  /// @param start  time at which the importer begins [s]: cases begin at 0
  /// @param stop  where the importer ends [s]; later than the end time of the case, it replaces it
  void begin(double start, std::optional<double> stop);

  /// Behind `begin`: the run may go on.
  void enter();

  using Type = Variable::Type;

  /// Before the run, parameters and inputs; then inputs.
  void set(Reference reference, Type type, double value);
  void set_text(Reference reference, const std::string& value);

  /// Before the run, parameters and inputs; then all.
  double get(Reference reference, Type type);

  /// Stays where it is until it is set, or the instance reset.
  const std::string& get_text(Reference reference) const;

  /// From t to t + h [s].
  void step(double t, double h);

  double time() const { return run_ ? run_->time() : 0.0; } ///< [s]

  /// Ends the run: controllers of the case that are other programs get a message.
  void finish();

  /// As it was made.
  void reset();

  /// All that the instance is now. What follows depends on it alone, bit for bit, in this instance
  /// or another one of the same FMU, in this process or another one. See run::Simulation::state.
  struct State {
    Phase phase = Phase::instantiated;
    double end_time = 0.0;
    std::vector<double> held; ///< of the parameters and inputs, in their order
    std::vector<std::string> texts;
    std::optional<run::State> run;

    /// As run::State.
    std::string bytes() const { return run::sealed(to_bytes(*this)); }
    static State from_bytes(const std::string& bytes) {
      return hydrodae::from_bytes<State>(run::unsealed(bytes));
    }
  };
  State save();
  void load(const State& state);

private:
  const Variable& variable(Reference reference) const;
  const Variable& variable(Reference reference, Type type) const;
  const Variable& settable(Reference reference, Type type) const;
  std::string toml_value(Reference reference, const Variable& v) const;
  run::Input& input(const std::string& name);
  void begin(double end_time);

  Contents contents_;
  Phase phase_ = Phase::instantiated;
  std::map<Reference, double> held_; ///< parameters, and what inputs begin with
  std::map<Reference, std::string> texts_;
  double end_time_ = 0.0; ///< in place of that of the case [s]; 0: that of the case
  std::unique_ptr<run::Simulation> run_;
  std::map<std::string, std::size_t> inputs_; ///< of the run, by name
};

} // namespace hydrodae::fmi
