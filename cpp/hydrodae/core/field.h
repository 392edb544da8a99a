#pragma once
/// Field descriptors: each key of a case table is declared once, next to the struct that it fills.
/// The case reader, the JSON schema and the documentation all read these declarations.

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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

/// Value of a key, in a struct: pointer to one of the types that a case file can hold. A
/// `std::vector<std::string>` also accepts one bare string; a `Matrix6` also accepts six numbers
/// (its diagonal).
using Value =
    std::variant<double*, bool*, int*, std::string*, std::vector<std::string>*,
                 std::vector<double>*, std::vector<Vector3>*, Vector3*, Vector6*, Matrix6*,
                 std::optional<double>*, std::optional<Vector3>*, std::optional<std::string>*,
                 ValueOrWord<double>*, ValueOrWord<Vector3>*>;

/// Key of a case table. The type of the struct is not part of it: one function reads all tables.
struct AnyField {
  std::string_view key;  ///< name in the file; a key that ends in `_deg` is stored in radians
  std::ptrdiff_t offset; ///< place of the value in the struct [bytes]
  Value (*value)(void*); ///< value at a place
  std::string_view unit; ///< unit in the file, "-" for no unit; "deg" is converted to radians
  std::string_view doc;  ///< one sentence of meaning
  bool required;
  Range range; ///< applies to every number of the value, in the unit of the file
  std::vector<std::string_view> choices; ///< allowed words; empty: any

  /// Value of this key in `table`.
  Value in(void* table) const { return value(static_cast<char*>(table) + offset); }
};

template <class V> Value value_at(void* place) { return static_cast<V*>(place); }

/// Field of these properties. Defined once: the compiler then spends little on each of the keys.
[[gnu::cold]] AnyField any_field(std::string_view key, std::ptrdiff_t offset, Value (*value)(void*),
                                 std::string_view unit, std::string_view doc, bool required,
                                 const Range& range, const std::vector<std::string_view>& choices);

/// Key of the struct `T`, with the member for its value: a member of `T` or of its base.
template <class T> struct Field : AnyField {
  template <class Base, class V>
  Field(std::string_view name, V Base::* member, std::string_view unit_, std::string_view doc_,
        bool required_ = false, const Range& range_ = any_value,
        const std::vector<std::string_view>& choices_ = any_word)
      : AnyField(any_field(name, offset_of(member), value_at<V>, unit_, doc_, required_, range_,
                           choices_)) {}

private:
  static std::ptrdiff_t offset_of(auto member) {
    static const T any{};
    return reinterpret_cast<const char*>(&(any.*member)) - reinterpret_cast<const char*>(&any);
  }
};

/// Fault in the combination of values of an entry.
struct Fault {
  std::string key, message;
};

/// Keys of the struct `T`.
template <class T> struct Fields : std::vector<AnyField> {
  Fields() = default;
  Fields(std::initializer_list<Field<T>> fields) { assign(fields.begin(), fields.end()); }
  Fields(const Field<T>& field) { push_back(field); } // NOLINT: one field is a list of one

  /// Keys that several types share, and those of one.
  friend Fields operator+(Fields shared, const Fields& own) {
    shared.insert(shared.end(), own.begin(), own.end());
    return shared;
  }
};

} // namespace hydrodae
