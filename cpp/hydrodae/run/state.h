#pragma once
/// All that a run is at an accepted instant, as a value: copied is saved.

#include <string>

#include "hydrodae/core/archive.h"

namespace hydrodae::run {

struct State {
  double time = 0.0; ///< [s]
  VectorX y, yp;     ///< unknowns of the rows that hold, and their rates
  /// What else the run goes on from, by part: modes of the switches, angles over turns, history of
  /// convolution and delays, inputs, what the method needs of the steps before, work done so far,
  /// what the guards have seen.
  Memory memory;
  std::string scene; ///< of which case it is (fingerprint)

  bool operator==(const State& other) const {
    return time == other.time && y == other.y && yp == other.yp && memory == other.memory &&
           scene == other.scene;
  }

  /// All of it by name, the scene apart.
  Memory numbers() const;
  static State from_numbers(Memory numbers, std::string scene);

  /// The same as bytes, of this kind of machine. `from_bytes` throws Error where they are no state.
  std::string bytes() const;
  static State from_bytes(const std::string& bytes);
};

} // namespace hydrodae::run
