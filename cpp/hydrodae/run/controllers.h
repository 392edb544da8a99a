#pragma once
/// The sampled controllers of a run: when they are due, what they read, what they hold.

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

/// Column of one number of a row of channels: "joints/slide/displacement", or one component of a
/// vector, "bodies/float/velocity.z" (of a quaternion w, x, y, z). Throws CaseError, with the
/// nearest name, for an unknown one.
std::size_t find_column(const std::vector<Channel>& channels, const std::string& name);

/// Does a run call functions of the program that runs it, or other programs? Then the second run,
/// which estimates the error, waits for the end of the first.
bool asks_outside(const model::Scene& scene);

/// What each controller holds: columns of the results, which other controllers may read.
std::vector<Channel> held_channels(const model::Scene& scene, const std::vector<Input>& inputs);

/// What a controller reads and writes, by the names that it has and in the units that it is given
/// there. Throws ModelError with the nearest name where there is no such channel or input, and
/// where a unit does not fit it or is not what the law takes.
control::Terminals find_terminals(const model::Controller& controller,
                                  const std::vector<Channel>& channels, std::vector<Input>& inputs);

/// Its law in this run. Throws ModelError where the controller does not fit what it is joined to.
std::unique_ptr<control::Law> make_law(const model::Controller& controller,
                                       const control::Terminals& terminals,
                                       const system::Regime& regime);

/// In words, which of them are in other units than those of the scene.
std::vector<std::string> unit_notes(const std::string& controller, const control::Terminals& t);

/// Each controller is sampled at 0, T, 2 T, ..., where the steps of the run end; its answers hold
/// from then on, or after its delay. All that are due at one instant see the same row, before any
/// of their answers. One that hears events is sampled behind each event, too.
class Controllers {
public:
  /// Throws ModelError where a controller names what there is not.
  Controllers(const model::Scene& scene, const system::Regime& regime,
              const std::vector<Channel>& channels, std::vector<Input>& inputs);

  /// Where a step is to end that would go on until `end`: there, or at the first instant before it
  /// at which something is due [s].
  double limit(double end) const;

  bool is_due(double t, bool event) const;

  /// Where rates cross zero that one hears.
  std::vector<events::Source*> sources() const;

  /// At the end of an accepted step.
  void accept(double t, const VectorX& y, const VectorX& yp);

  /// Samples those that are due at t [s], and writes what holds from t on.
  /// @param row  all channels at t
  /// @returns whether an input has another value now
  bool act(double t, bool event, std::span<const double> row);

  /// Which one feeds the motion, and how its answers have grown; empty: none does.
  std::string runaway() const;

  /// What each holds, in the order of `held_channels`.
  std::vector<double> held() const;

  /// Wall time of the calls, where a controller is not one of the kernel's own.
  struct Cost {
    std::string name;
    long calls = 0;
    double time = 0.0; ///< of all but the first [s]
  };
  std::vector<Cost> costs() const;

  /// Which numbers are turned into other units, in words.
  std::vector<std::string> unit_notes() const;

  void restored(double t);
  void finish(const std::string& error);

  struct OneState {
    double next = 0.0;                                       ///< sampling instant [s]
    long count = 0;                                          ///< of sampling instants
    std::vector<double> out;                                 ///< answers in its own units
    std::deque<std::pair<double, std::vector<double>>> late; ///< answers that do not hold yet
    std::vector<SwingWatch> swings;                          ///< of each answer
    std::string law;                                         ///< bytes
    events::Crossing::State crossing;
  };
  using State = std::vector<OneState>;
  State state();

  /// Throws Error for the state of other controllers.
  void set(State state);

  /// The next sampling instant of any controller; infinite: none [s].
  double next_time() const;

private:
  struct One {
    std::string name;
    double period = 0.0, delay = 0.0;
    bool outside = false;
    std::unique_ptr<control::Law> law;
    std::vector<std::size_t> columns; ///< that it reads
    std::vector<Input*> inputs;       ///< that it writes
    control::Terminals terminals;
    std::vector<double> in; ///< in its own units
    OneState state;         ///< but for what the law and the crossing keep
    Cost cost;
    std::unique_ptr<events::Crossing> crossing; ///< null: it hears no crossing

    bool is_due(double t, bool event) const;
    void sample(double t, std::span<const double> row);
    bool write(double t);
  };

  std::vector<One> all_;
};

} // namespace hydrodae::run
