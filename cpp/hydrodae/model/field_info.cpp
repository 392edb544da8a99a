#include "hydrodae/model/field_info.h"

#include <cmath>

#include "hydrodae/core/text.h"

namespace hydrodae::model {
namespace {

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

bool in_range(const Range& range, double x) {
  return std::isfinite(x) && x >= range.min && x <= range.max &&
         !(range.open_min && x == range.min);
}

ValueKind kind_of(double) { return ValueKind::number; }
ValueKind kind_of(int) { return ValueKind::integer; }
ValueKind kind_of(bool) { return ValueKind::truth; }
ValueKind kind_of(const std::string&) { return ValueKind::word; }
ValueKind kind_of(const std::vector<std::string>&) { return ValueKind::words; }
ValueKind kind_of(const std::vector<double>&) { return ValueKind::numbers; }
ValueKind kind_of(const std::vector<Vector3>&) { return ValueKind::points; }
ValueKind kind_of(const Vector3&) { return ValueKind::vector3; }
ValueKind kind_of(const Vector6&) { return ValueKind::vector6; }
ValueKind kind_of(const Matrix6&) { return ValueKind::matrix6; }
template <class V> ValueKind kind_of(const std::optional<V>&) { return kind_of(V{}); }
template <class V> ValueKind kind_of(const ValueOrWord<V>& given) { return kind_of(given.value); }

/// Default value of a struct as TOML, in the unit of the file; "" if it stands for "not given":
/// nothing, an empty list, a number out of its range.
std::string value_text(const FieldInfo& field, double value) {
  const double x = field.key.ends_with("_deg") ? value * (180.0 / pi) : value;
  return in_range(field.range, x) ? number_text(x) : "";
}

std::string value_text(const FieldInfo& field, int value) {
  return in_range(field.range, value) ? std::to_string(value) : "";
}

std::string value_text(const FieldInfo&, bool value) { return value ? "true" : "false"; }

std::string value_text(const FieldInfo&, const std::string& value) {
  return value.empty() ? "" : quoted(value);
}

std::string value_text(const FieldInfo&, const std::vector<std::string>& value) {
  std::vector<std::string> items;
  for (const std::string& item : value)
    items.push_back(quoted(item));
  return items.size() == 1 ? items[0] : items.empty() ? "" : "[" + joined(items) + "]";
}

template <class Numbers> std::string list_text(const FieldInfo& field, const Numbers& numbers) {
  std::vector<std::string> items;
  for (const double number : numbers)
    items.push_back(value_text(field, number));
  return items.empty() ? "" : "[" + joined(items) + "]";
}

std::string value_text(const FieldInfo& field, const std::vector<double>& value) {
  return list_text(field, value);
}

std::string value_text(const FieldInfo& field, const Vector3& value) {
  return list_text(field, value);
}

std::string value_text(const FieldInfo& field, const Vector6& value) {
  return list_text(field, value);
}

std::string value_text(const FieldInfo& field, const Matrix6& value) {
  return value.isDiagonal(0.0) ? list_text(field, value.diagonal()) : "";
}

std::string value_text(const FieldInfo& field, const std::vector<Vector3>& value) {
  std::vector<std::string> items;
  for (const Vector3& point : value)
    items.push_back(value_text(field, point));
  return items.empty() ? "" : "[" + joined(items) + "]";
}

template <class V> std::string value_text(const FieldInfo& field, const std::optional<V>& value) {
  return value ? value_text(field, *value) : "";
}
template <class V> std::string value_text(const FieldInfo& field, const ValueOrWord<V>& given) {
  return given.word.empty() ? value_text(field, given.value) : value_text(field, given.word);
}

} // namespace

std::string_view name_of(ValueKind kind) {
  constexpr std::array<std::string_view, 10> names = {"number",  "integer", "truth",  "word",
                                                      "words",   "numbers", "points", "vector3",
                                                      "vector6", "matrix6"};
  return names[static_cast<std::size_t>(kind)];
}

FieldInfo field_info(const AnyField& field, void* defaults) {
  FieldInfo info;
  info.key = field.key;
  info.unit = field.unit;
  info.doc = field.doc;
  info.required = field.required;
  info.range = field.range;
  info.choices.assign(field.choices.begin(), field.choices.end());
  std::visit(
      [&](const auto* value) {
        info.kind = kind_of(*value);
        if (!field.required)
          info.default_value = value_text(info, *value);
      },
      field.in(defaults));
  return info;
}

} // namespace hydrodae::model
