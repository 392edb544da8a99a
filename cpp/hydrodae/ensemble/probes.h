#pragma once
/// Numbers of the channels of the results, in lanes: motions of bodies and joints, reactions, and
/// what forces report of themselves.

#include <optional>

#include "hydrodae/ensemble/lane_model.h"
#include "hydrodae/ensemble/measured.h"

namespace hydrodae::ensemble {

/// The place of one number.
struct Probe {
  enum class Kind {
    position,
    rotation,
    velocity,
    angular_velocity,
    acceleration,
    angular_acceleration,
    motion,
    motion_rate,
    reaction_force,
    reaction_moment,
    own,
    elevation
  };
  Kind kind = Kind::position;
  std::size_t index = 0; ///< of the body, motion, joint, or list of laws
  int component = 0;     ///< or the place among the numbers of the list
  std::string unit;
};

/// The place of a number of a channel; none: no lane knows the channel.
std::optional<Probe> find_probe(const system::Regime& regime, const Term& term);

/// Why signals cannot be measured in lanes; empty: they can.
std::string unknown_because(const system::Regime& regime, const std::vector<Wanted>& wanted);

/// Reads signals from a model, at the state of its last `accelerations`.
class Probes {
public:
  Probes(const LaneModel& model, const std::vector<Wanted>& wanted);

  std::size_t size() const { return signals_.size(); }
  const std::string& unit(std::size_t signal) const { return signals_[signal].unit; }

  /// Values of all signals, (size(),).
  /// @param yp rates of y (n,) there
  void read(double t, const Lanes* yp, Lanes* out);

private:
  struct Part {
    std::optional<Probe> probe; ///< none: the factor alone
    double factor = 1.0;
    int power = 1;
  };
  struct Signal {
    std::vector<Part> parts;
    std::string unit;
  };

  Lanes read(const Probe& probe, double t, const Lanes* yp) const;
  Vec3<Lanes> rates(const Probe& probe, const Lanes* yp) const;
  double read_run(const Probe& probe, double t, std::size_t k) const;
  double reaction(const Probe& probe, std::size_t k) const;
  void read_lists(double t);

  const LaneModel& model_;
  std::vector<Signal> signals_;
  std::vector<std::size_t> lists_; ///< of laws that are read
  /// By list and run, the numbers that laws report of themselves, as declared.
  std::vector<std::array<std::vector<double>, width>> own_;
  std::vector<double> declared_;
};

} // namespace hydrodae::ensemble
