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

template <class Numbers> std::string list_text(const FieldInfo& field, const Numbers& numbers) {
  std::vector<std::string> items;
  for (const double number : numbers)
    items.push_back(value_text(field, number));
  return items.empty() ? "" : "[" + joined(items) + "]";
}

} // namespace

std::string_view name_of(ValueKind kind) {
  constexpr std::array<std::string_view, 10> names = {"number",  "integer", "truth",  "word",
                                                      "words",   "numbers", "points", "vector3",
                                                      "vector6", "matrix6"};
  return names[static_cast<std::size_t>(kind)];
}

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

std::string value_text(const FieldInfo& field, const std::vector<double>& value) {
  return list_text(field, value);
}

std::string value_text(const FieldInfo& field, const std::vector<Vector3>& value) {
  std::vector<std::string> items;
  for (const Vector3& point : value)
    items.push_back(value_text(field, point));
  return items.empty() ? "" : "[" + joined(items) + "]";
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

} // namespace hydrodae::model
