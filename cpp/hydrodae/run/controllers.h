#pragma once
/// Sampled controllers of a run: their sampling instants, inputs and held outputs.

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hydrodae/control/law.h"
#include "hydrodae/core/channel.h"
#include "hydrodae/events/crossings.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/run/inputs.h"
#include "hydrodae/run/swing_watch.h"

namespace hydrodae::run {

/// Column of one value in a row of channels: "joints/slide/displacement", or one component of a
/// vector, "bodies/float/velocity.z" (of a quaternion w, x, y, z). Throws CaseError with the
/// nearest name for an unknown channel.
std::size_t find_column(const std::vector<Channel>& channels, const std::string& name);

/// Returns whether a run calls functions of the calling program, or other programs. The second run,
/// which estimates the error, then waits for the end of the first.
bool asks_outside(const model::Scene& scene);

/// Channels of the values that controllers hold: columns of the results, readable by other
/// controllers.
std::vector<Channel> held_channels(const model::Scene& scene, const std::vector<Input>& inputs);

/// Terminals of a controller: channels that it reads and inputs that it writes, by name, in the
/// given units. Throws ModelError for an unknown name (with the nearest one) or an unsuitable unit.
control::Terminals find_terminals(const model::Controller& controller,
                                  const std::vector<Channel>& channels, std::vector<Input>& inputs);

/// Law of a controller in this run. Throws ModelError if it does not fit its terminals.
std::unique_ptr<control::Law> make_law(const model::Controller& controller,
                                       const control::Terminals& terminals,
                                       const system::Regime& regime);

/// Notes on terminals in other units than those of the scene.
std::vector<std::string> unit_notes(const std::string& controller, const control::Terminals& t);

/// Controllers of a run, each sampled at 0, T, 2 T, ..., where steps end. Outputs hold from then
/// on, or after the delay. Controllers due at one instant read the same row, before any outputs
/// change. Controllers that respond to events are sampled after each event, too.
class Controllers {
public:
  /// Throws ModelError if a controller names an unknown channel or input.
  Controllers(const model::Scene& scene, const system::Regime& regime,
              const std::vector<Channel>& channels, std::vector<Input>& inputs);

  /// End of a step that would continue until `end`: `end`, or the first earlier instant at which a
  /// controller is due [s].
  double limit(double end) const;

  bool is_due(double t, bool event) const;

  /// Event sources: zero crossings of rates that controllers respond to.
  std::vector<events::Source*> sources() const;

  /// Takes the end of an accepted step.
  void accept(double t, const VectorX& y, const VectorX& yp);

  /// Samples the controllers due at t [s], and writes the outputs that hold from t on.
  /// @param row  all channels at t
  /// @returns whether the value of an input has changed
  bool act(double t, bool event, std::span<const double> row);

  /// Message on a controller that feeds the motion, and the growth of its outputs; empty: none
  /// does.
  std::string runaway() const;

  /// Held values of all controllers, in the order of `held_channels`.
  std::vector<double> held() const;

  /// Wall time of calls to controllers outside the kernel.
  struct Cost {
    std::string name;
    long calls = 0;
    double time = 0.0; ///< wall time of all calls except the first [s]
  };
  std::vector<Cost> costs() const;

  /// Notes on values that are converted to other units.
  std::vector<std::string> unit_notes() const;

  void restored(double t);
  void finish(const std::string& error);

  struct OneState {
    double next = 0.0;       ///< next sampling instant [s]
    long count = 0;          ///< number of sampling instants so far
    std::vector<double> out; ///< outputs in the controller's units
    /// Delayed outputs that do not hold yet
    std::deque<std::pair<double, std::vector<double>>> late;
    std::vector<SwingWatch> swings; ///< swing watch of each output
    std::string law;                ///< bytes
    events::Crossing::State crossing;
  };
  using State = std::vector<OneState>;
  State state();

  /// Throws Error for the state of other controllers.
  void set(State state);

  /// Next sampling instant of any controller [s]; infinite: none.
  double next_time() const;

private:
  struct One {
    std::string name;
    double period = 0.0, delay = 0.0;
    bool outside = false;
    std::unique_ptr<control::Law> law;
    std::vector<std::size_t> columns; ///< columns that it reads; the largest number: the time
    std::vector<Input*> inputs;       ///< inputs that it writes
    control::Terminals terminals;
    std::vector<double> in; ///< inputs in the controller's units
    OneState state;         ///< state without that of the law and the crossing
    Cost cost;
    std::unique_ptr<events::Crossing> crossing; ///< null: the controller responds to no crossing

    bool is_due(double t, bool event) const;
    void sample(double t, std::span<const double> row);
    bool write(double t);
  };

  std::vector<One> all_;
};

} // namespace hydrodae::run
