#pragma once
/// What a program may change while it runs a scene: constants of forces, held from one accepted
/// instant to the next write.

#include <string>
#include <vector>

#include "hydrodae/system/regime.h"

namespace hydrodae::run {

struct Input {
  std::string name; ///< "forces/pto/damping"
  std::string unit;
  double* value = nullptr; ///< in the regime
  double least = -INFINITY;
  std::vector<system::Lag>* lags = nullptr; ///< of its list of forces; null: it cannot lag
  std::size_t number = 0;                   ///< in that list

  system::Lag* lag() const { return lags && number < lags->size() ? &(*lags)[number] : nullptr; }

  /// What it is set to from t [s] on. @returns whether that is another value than before
  bool set(double t, double target) const;

  /// From now on it follows within a time constant [s].
  void follow(double time) const;
};

/// The inputs that forces declare: damping, stiffness, neutral coordinate and load of each power
/// take-off along a joint ("forces/pto/damping"), the components of each constant load, ...; what
/// each dry friction holds at most ("forces/brake/static"); where nothing switches, the constant
/// part of each rate that a constraint prescribes ("constraints/motor/rate"). They point into
/// `regime`.
std::vector<Input> find_inputs(system::Regime& regime);

/// Throws CaseError, with the nearest name, where there is no such input.
Input& input_named(std::vector<Input>& inputs, const std::string& name);

/// The dry friction whose largest load is the input of this name; null: none is.
const system::SwitchData* find_friction(const system::Regime& regime, const std::string& input);

/// Throws CaseError where the value is not finite or too small for the input.
void check_value(const Input& input, double value);

} // namespace hydrodae::run
