#pragma once
/// Instance of an FMU, independent of the version of FMI.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contents.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::fmi {

/// Phase in the life of an instance, in both versions of the standard.
enum class Phase { instantiated, initialising, stepping, terminated };

/// Run of the FMU's case between communication points. Inputs hold from one communication point to
/// the next; parameters are numbers of the case, fixed when the run begins. All functions throw
/// Error, with a message for the importer.
class Component {
public:
  /// Instance before its run. Reads variables.txt of `resources`.
  explicit Component(const std::string& resources);

  const std::string& token() const { return contents_.token; }

  /// Throws if `function` is called in any other phase.
  void require(const char* function, Phase phase) const;

  /// Reads the case and makes its run, at t = 0 s.
  /// @param start  time at which the importer begins [s]: cases begin at 0
  /// @param stop  end of the importer [s]; if later, it replaces the end time of the case
  void begin(double start, std::optional<double> stop);

  /// Enters the stepping phase; call it after `begin`.
  void enter();

  using Type = Variable::Type;

  /// Sets parameters and inputs before the run, then inputs only.
  void set(Reference reference, Type type, double value);
  void set_text(Reference reference, const std::string& value);

  /// Gets parameters and inputs before the run, then all variables.
  double get(Reference reference, Type type);

  /// The reference is valid until the text is set or the instance reset.
  const std::string& get_text(Reference reference) const;

  /// Advances the run from t to t + h [s].
  void step(double t, double h);

  double time() const { return run_ ? run_->time() : 0.0; } ///< [s]

  /// Ends the run, and informs controllers in other programs.
  void finish();

  /// Resets the instance to its creation.
  void reset();

  /// Complete state of the instance. The continuation depends on it alone, bit for bit, in any
  /// instance of the same FMU and in any process. See run::Simulation::state.
  struct State {
    Phase phase = Phase::instantiated;
    double end_time = 0.0;
    std::vector<double> held; ///< values of the parameters and inputs, in their order
    std::vector<std::string> texts;
    std::optional<run::State> run;

    /// State as bytes, as in run::State.
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
  std::map<Reference, double> held_; ///< parameters, and initial values of inputs
  std::map<Reference, std::string> texts_;
  double end_time_ = 0.0; ///< end time that replaces that of the case [s]; 0: none
  std::unique_ptr<run::Simulation> run_;
  std::map<std::string, std::size_t> inputs_; ///< inputs of the run by name
};

} // namespace hydrodae::fmi
