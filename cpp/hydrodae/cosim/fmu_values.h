#pragma once
/// Variables of an FMU by their types, and the numbers that stand for their values: booleans are 0
/// or 1, enumerations and other integers whole numbers.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hydrodae::cosim {

enum class FmuType {
  float64,
  float32,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  boolean,
  text,
  other ///< binaries, clocks
};

/// Type of "Real" or "Float64", as in modelDescription.xml; enumerations are integers.
/// @param version  of FMI: 2 or 3
FmuType fmu_type(int version, const std::string& name);

/// Variables of one type, with their indices in a row of numbers.
struct FmuGroup {
  FmuType type;
  std::vector<unsigned> references;
  std::vector<std::size_t> places;
  std::vector<std::string> names;

  /// The number of `values` for variable k. Throws CaseError where its type does not have it.
  double given(std::size_t k, std::span<const double> values) const;

  /// Throws CaseError where an integer is too large to be exact as a double.
  void take(std::size_t k, double value, std::span<double> values) const;
};

using FmuGroups = std::vector<FmuGroup>;

/// Calls `set(references, numbers, count)` with the values of a group as numbers of type T.
template <class T, class Set>
auto give_as(const FmuGroup& group, std::span<const double> values, Set&& set) {
  const auto numbers = std::make_unique<T[]>(group.places.size());
  for (std::size_t k = 0; k < group.places.size(); ++k)
    numbers[k] = static_cast<T>(group.given(k, values));
  return set(group.references.data(), numbers.get(), group.references.size());
}

/// Calls `get(references, numbers, count)`, which throws where they are missing.
template <class T, class Get>
void take_as(const FmuGroup& group, std::span<double> values, Get&& get) {
  const auto numbers = std::make_unique<T[]>(group.places.size());
  get(group.references.data(), numbers.get(), group.references.size());
  for (std::size_t k = 0; k < group.places.size(); ++k)
    group.take(k, static_cast<double>(numbers[k]), values);
}

} // namespace hydrodae::cosim
