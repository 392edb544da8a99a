#pragma once
/// Description of a `Field<T>` without its type T.

#include "hydrodae/model/tables.h"

namespace hydrodae::model {

inline ValueKind kind_of(double) { return ValueKind::number; }
inline ValueKind kind_of(int) { return ValueKind::integer; }
inline ValueKind kind_of(bool) { return ValueKind::truth; }
inline ValueKind kind_of(const std::string&) { return ValueKind::word; }
inline ValueKind kind_of(const std::vector<std::string>&) { return ValueKind::words; }
inline ValueKind kind_of(const std::vector<double>&) { return ValueKind::numbers; }
inline ValueKind kind_of(const std::vector<Vector3>&) { return ValueKind::points; }
inline ValueKind kind_of(const Vector3&) { return ValueKind::vector3; }
inline ValueKind kind_of(const Vector6&) { return ValueKind::vector6; }
inline ValueKind kind_of(const Matrix6&) { return ValueKind::matrix6; }
template <class V> ValueKind kind_of(const std::optional<V>&) { return kind_of(V{}); }
template <class V> ValueKind kind_of(const ValueOrWord<V>& given) { return kind_of(given.value); }

/// Default value of a struct as TOML, in the unit of the file; "" if it stands for "not given":
/// nothing, an empty list, a number out of its range.
std::string value_text(const FieldInfo& field, double value);
std::string value_text(const FieldInfo& field, int value);
std::string value_text(const FieldInfo& field, bool value);
std::string value_text(const FieldInfo& field, const std::string& value);
std::string value_text(const FieldInfo& field, const std::vector<std::string>& value);
std::string value_text(const FieldInfo& field, const std::vector<double>& value);
std::string value_text(const FieldInfo& field, const std::vector<Vector3>& value);
std::string value_text(const FieldInfo& field, const Vector3& value);
std::string value_text(const FieldInfo& field, const Vector6& value);
std::string value_text(const FieldInfo& field, const Matrix6& value);
template <class V> std::string value_text(const FieldInfo& field, const std::optional<V>& value) {
  return value ? value_text(field, *value) : "";
}
template <class V> std::string value_text(const FieldInfo& field, const ValueOrWord<V>& given) {
  return given.word.empty() ? value_text(field, given.value) : value_text(field, given.word);
}

template <class T> FieldInfo field_info(const Field<T>& field) {
  FieldInfo info;
  info.key = field.key;
  info.unit = field.unit;
  info.doc = field.doc;
  info.required = field.required;
  info.range = field.range;
  info.choices.assign(field.choices.begin(), field.choices.end());
  static const T defaults{};
  std::visit(
      [&](auto member) {
        info.kind = kind_of(defaults.*member);
        if (!field.required)
          info.default_value = value_text(info, defaults.*member);
      },
      field.member);
  return info;
}

template <class T> std::vector<FieldInfo> field_infos() {
  std::vector<FieldInfo> infos;
  for (const Field<T>& field : T::fields())
    infos.push_back(field_info(field));
  return infos;
}

} // namespace hydrodae::model
