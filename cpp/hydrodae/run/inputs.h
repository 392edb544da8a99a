#pragma once
/// Inputs that a program may change while it runs a scene: constants of forces, held from one
/// accepted instant to the next write.

#include <string>
#include <vector>

#include "hydrodae/system/regime.h"

namespace hydrodae::run {

struct Input {
  std::string name; ///< "forces/pto/damping"
  std::string unit;
  double* value = nullptr; ///< pointer into the regime
  double least = -INFINITY;
  /// Lags of its list of forces; null: the input cannot lag
  std::vector<system::Lag>* lags = nullptr;
  std::size_t number = 0; ///< index in that list

  system::Lag* lag() const { return lags && number < lags->size() ? &(*lags)[number] : nullptr; }

  /// Sets the value from t [s] on. @returns whether the value has changed
  bool set(double t, double target) const;

  /// Sets the time constant [s] of the lag from now on.
  void follow(double time) const;
};

/// Inputs of a scene, as pointers into `regime`. Forces declare damping, stiffness, neutral
/// coordinate and load of each power take-off ("forces/pto/damping"), the components of each
/// constant load, and others. Dry friction has its largest load ("forces/brake/static"). Scenes
/// without switches have the constant part of each prescribed rate ("constraints/motor/rate").
std::vector<Input> find_inputs(system::Regime& regime);

/// Input of this name. Throws CaseError with the nearest name for an unknown one.
Input& input_named(std::vector<Input>& inputs, const std::string& name);

/// Dry friction whose largest load is the input of this name; null: none.
const system::SwitchData* find_friction(const system::Regime& regime, const std::string& input);

/// Throws CaseError if the value is not finite or too small for the input.
void check_value(const Input& input, double value);

} // namespace hydrodae::run
