#include "hydrodae/cosim/fmu_values.h"

#include <cmath>
#include <limits>
#include <map>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::cosim {

namespace {

constexpr double exact = 9007199254740992.0; ///< 2^53: beyond it doubles leave integers out

struct Bounds {
  double least, most;
};

template <class T> constexpr Bounds of() {
  return {static_cast<double>(std::numeric_limits<T>::min()),
          static_cast<double>(std::numeric_limits<T>::max())};
}

Bounds bounds(FmuType type) {
  switch (type) {
  case FmuType::int8:
    return of<signed char>();
  case FmuType::uint8:
    return of<unsigned char>();
  case FmuType::int16:
    return of<short>();
  case FmuType::uint16:
    return of<unsigned short>();
  case FmuType::int32:
    return of<int>();
  case FmuType::uint32:
    return of<unsigned>();
  case FmuType::int64:
    return {-exact, exact};
  case FmuType::uint64:
    return {0.0, exact};
  default:
    return {0.0, 1.0}; // boolean
  }
}

} // namespace

FmuType fmu_type(int version, const std::string& name) {
  static const std::map<std::string, FmuType> two = {{"Real", FmuType::float64},
                                                     {"Integer", FmuType::int32},
                                                     {"Enumeration", FmuType::int32},
                                                     {"Boolean", FmuType::boolean},
                                                     {"String", FmuType::text}};
  static const std::map<std::string, FmuType> three = {
      {"Float64", FmuType::float64},   {"Float32", FmuType::float32}, {"Int8", FmuType::int8},
      {"UInt8", FmuType::uint8},       {"Int16", FmuType::int16},     {"UInt16", FmuType::uint16},
      {"Int32", FmuType::int32},       {"UInt32", FmuType::uint32},   {"Int64", FmuType::int64},
      {"Enumeration", FmuType::int64}, {"UInt64", FmuType::uint64},   {"Boolean", FmuType::boolean},
      {"String", FmuType::text}};
  const auto& types = version == 2 ? two : three;
  const auto found = types.find(name);
  return found == types.end() ? FmuType::other : found->second;
}

double FmuGroup::given(std::size_t k, std::span<const double> values) const {
  const double value = values[places[k]];
  const auto refuse = [&](const std::string& expected) {
    throw CaseError("variable " + in_quotes(names[k]) + " of the FMU is given " +
                    number_text(value) + ", expected " + expected);
  };
  if (type == FmuType::float64)
    return value;
  if (type == FmuType::float32) {
    if (std::isfinite(value) && std::abs(value) > std::numeric_limits<float>::max())
      refuse("a number that 32 bits can hold");
    return value;
  }
  const auto [least, most] = bounds(type);
  if (!(std::floor(value) == value && least <= value && value <= most))
    refuse(type == FmuType::boolean
               ? "a boolean: 0 or 1"
               : "an integer from " + number_text(least) + " to " + number_text(most));
  return value;
}

void FmuGroup::take(std::size_t k, double value, std::span<double> values) const {
  if ((type == FmuType::int64 || type == FmuType::uint64) && std::abs(value) >= exact)
    throw CaseError("variable " + in_quotes(names[k]) + " of the FMU is " + number_text(value) +
                    ", too large an integer to be exact: expected less than 2^53");
  values[places[k]] = type == FmuType::boolean && value != 0.0 ? 1.0 : value;
}

} // namespace hydrodae::cosim
