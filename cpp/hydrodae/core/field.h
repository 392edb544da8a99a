#pragma once
/// Field descriptors: each key of a case table is declared once, next to the struct that it fills.
/// The case reader, the JSON schema and the documentation all read these declarations.

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Closed interval of allowed values (in the unit of the file); `open_min` excludes `min` itself.
/// `far_max` is beyond all sensible values, and appears only in messages on values above it.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  bool far_max = false;
};
inline constexpr Range any_value{};
constexpr Range at_least(double x) { return {x, std::numeric_limits<double>::infinity(), false}; }
constexpr Range more_than(double x) { return {x, std::numeric_limits<double>::infinity(), true}; }
constexpr Range at_least(double x, double far) { return {x, far, false, true}; }
constexpr Range more_than(double x, double far) { return {x, far, true, true}; }
constexpr Range between(double a, double b) { return {a, b, false}; }

/// Largest time that a case may contain [s]: three centuries.
inline constexpr double longest_time = 1e10;

/// Choices that do not restrict a word. (A named constant: g++ 12 crashes on `= {}` below.)
inline const std::vector<std::string_view> any_word;

/// Value, or a word for its source: "equilibrium" for a mass.
template <class V> struct ValueOrWord {
  V value;          ///< value as given, or as derived from the word
  std::string word; ///< "" for a value

  ValueOrWord& operator=(const V& given) {
    value = given;
    word.clear();
    return *this;
  }
};

/// Pointer to a member of `T`, of one of the types that a case file can hold. A
/// `std::vector<std::string>` also accepts one bare string; a `Matrix6` also accepts six numbers
/// (its diagonal).
template <class T>
using Member =
    std::variant<double T::*, bool T::*, int T::*, std::string T::*, std::vector<std::string> T::*,
                 std::vector<double> T::*, std::vector<Vector3> T::*, Vector3 T::*, Vector6 T::*,
                 Matrix6 T::*, std::optional<double> T::*, std::optional<Vector3> T::*,
                 std::optional<std::string> T::*, ValueOrWord<double> T::*,
                 ValueOrWord<Vector3> T::*>;

/// Key of a case table.
template <class T> struct Field {
  std::string_view key;  ///< name in the file; a key that ends in `_deg` is stored in radians
  Member<T> member;      ///< member for the value
  std::string_view unit; ///< unit in the file, "-" for no unit; "deg" is converted to radians
  std::string_view doc;  ///< one sentence of meaning
  bool required = false;
  Range range = any_value; ///< applies to every number of the value, in the unit of the file
  std::vector<std::string_view> choices = any_word; ///< allowed words; empty: any
};

/// Fault in the combination of values of an entry.
struct Fault {
  std::string key, message;
};

template <class T> using Fields = std::vector<Field<T>>;

} // namespace hydrodae
