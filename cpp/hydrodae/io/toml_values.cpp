#include "hydrodae/io/toml_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::io {
namespace {

std::string found(const toml::node& node) {
  if (const auto* text = node.as_string())
    return "the string " + in_quotes(text->get());
  if (const auto* number = node.as_integer())
    return std::to_string(number->get());
  if (const auto* number = node.as_floating_point())
    return number_text(number->get());
  if (const auto* truth = node.as_boolean())
    return truth->get() ? "true" : "false";
  if (const auto* list = node.as_array())
    return "a list of " + std::to_string(list->size()) + (list->size() == 1 ? " item" : " items");
  if (node.is_table())
    return "a table";
  return "a date or time";
}

std::string in_unit(const Key& key) {
  return key.unit == "-" ? "" : " [" + std::string(key.unit) + "]";
}

[[noreturn]] void refuse(const Key& key, const std::string& what) {
  throw CaseError(key.place, key.path, key.label + ": " + what);
}

[[noreturn]] void refuse(const Key& key, const std::string& expected, const toml::node& node) {
  refuse(key, "expected " + expected + ", got " + found(node));
}

/// Text of the allowed range of `x`.
std::string range_text(const Range& range, double x) {
  const bool low = std::isfinite(range.min),
             high = std::isfinite(range.max) && (!range.far_max || x > range.max);
  const std::string lowest = (range.open_min ? "> " : ">= ") + number_text(range.min);
  if (low && high)
    return lowest + " and <= " + number_text(range.max);
  return low ? lowest : "<= " + number_text(range.max);
}

/// One number in the unit of the file: finite and in range.
double number(const toml::node& node, const Key& key) {
  double x = 0.0;
  if (const auto* integer = node.as_integer())
    x = static_cast<double>(integer->get());
  else if (const auto* real = node.as_floating_point())
    x = real->get();
  else
    refuse(key, "a number" + in_unit(key), node);
  const std::string unit = key.unit == "-" ? "" : " " + std::string(key.unit);
  if (!std::isfinite(x))
    refuse(key, "must be finite, got " + number_text(x) + unit);
  if (x < key.range.min || x > key.range.max || (key.range.open_min && x == key.range.min))
    refuse(key, "must be " + range_text(key.range, x) + unit + ", got " + number_text(x) + unit);
  return x;
}

double in_radians(double x, const Key& key) {
  return key.name.ends_with("_deg") ? x * (pi / 180.0) : x;
}

/// Exactly `count` numbers.
const toml::array& numbers(const toml::node& node, const Key& key, std::size_t count,
                           const std::string& expected) {
  const toml::array* list = node.as_array();
  if (!list || list->size() != count)
    refuse(key, expected + in_unit(key), node);
  return *list;
}

template <class Vector> void read_vector(const toml::node& node, const Key& key, Vector& out) {
  const auto count = static_cast<std::size_t>(out.size());
  const toml::array& list = numbers(node, key, count, std::to_string(count) + " numbers");
  for (std::size_t i = 0; i < count; ++i)
    out[static_cast<Eigen::Index>(i)] = in_radians(number(list[i], key), key);
}

std::string word(const toml::node& node, const Key& key) {
  const auto* text = node.as_string();
  if (!text)
    refuse(key, "a string", node);
  const auto& choices = key.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text->get()) == choices.end())
    refuse(key, "unknown value " + in_quotes(text->get()) +
                    suggestion(text->get(), {choices.begin(), choices.end()}));
  return text->get();
}

/// `expected`: what a value is.
template <class V>
void read_or_word(const toml::node& node, const Key& key, const std::string& expected,
                  ValueOrWord<V>& out) {
  out.word.clear();
  const auto* text = node.as_string();
  if (!text) {
    read_value(node, key, out.value);
    return;
  }
  out.word = text->get();
  if (std::find(key.choices.begin(), key.choices.end(), out.word) == key.choices.end()) {
    std::string words;
    for (const std::string_view choice : key.choices)
      words += " or \"" + std::string(choice) + "\"";
    refuse(key, expected + in_unit(key) + words, node);
  }
}

} // namespace

FilePlace place_of(const toml::source_region& source) {
  const std::string name = source.path ? *source.path : "<case>";
  if (name.starts_with("--set "))
    return {name};
  return {name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

void read_value(const toml::node& node, const Key& key, double& out) {
  out = in_radians(number(node, key), key);
}

void read_value(const toml::node& node, const Key& key, bool& out) {
  const auto* truth = node.as_boolean();
  if (!truth)
    refuse(key, "true or false", node);
  out = truth->get();
}

void read_value(const toml::node& node, const Key& key, int& out) {
  const auto* integer = node.as_integer();
  if (!integer)
    refuse(key, "an integer" + in_unit(key), node);
  const double x = number(node, key);
  if (std::abs(x) > static_cast<double>(std::numeric_limits<int>::max()))
    refuse(key, "a smaller integer", node);
  out = static_cast<int>(integer->get());
}

void read_value(const toml::node& node, const Key& key, std::string& out) { out = word(node, key); }

void read_value(const toml::node& node, const Key& key, std::vector<std::string>& out) {
  out.clear();
  if (node.is_string()) {
    out.push_back(word(node, key));
    return;
  }
  const toml::array* list = node.as_array();
  if (!list)
    refuse(key, "a string or a list of strings", node);
  for (const toml::node& item : *list)
    out.push_back(word(item, key));
}

void read_value(const toml::node& node, const Key& key, std::vector<double>& out) {
  const toml::array* list = node.as_array();
  if (!list || list->empty())
    refuse(key, "a list of numbers" + in_unit(key), node);
  out.clear();
  for (const toml::node& item : *list)
    out.push_back(in_radians(number(item, key), key));
}

void read_value(const toml::node& node, const Key& key, std::vector<Vector3>& out) {
  const toml::array* list = node.as_array();
  if (!list || list->empty() || !list->get(0)->is_array())
    refuse(key, "a list of points, each of 3 numbers" + in_unit(key), node);
  out.clear();
  for (const toml::node& item : *list)
    read_vector(item, key, out.emplace_back());
}

void read_value(const toml::node& node, const Key& key, Vector3& out) {
  read_vector(node, key, out);
}

void read_value(const toml::node& node, const Key& key, Vector6& out) {
  read_vector(node, key, out);
}

void read_value(const toml::node& node, const Key& key, Matrix6& out) {
  const toml::array& rows =
      numbers(node, key, 6, "6 numbers (the diagonal) or 6 rows of 6 numbers");
  Vector6 row;
  if (!rows[0].is_array()) {
    read_vector(node, key, row);
    out = row.asDiagonal();
    return;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    read_vector(rows[i], key, row);
    out.row(static_cast<Eigen::Index>(i)) = row;
  }
}

void read_value(const toml::node& node, const Key& key, ValueOrWord<double>& out) {
  read_or_word(node, key, "a number", out);
}

void read_value(const toml::node& node, const Key& key, ValueOrWord<Vector3>& out) {
  read_or_word(node, key, "3 numbers", out);
}

} // namespace hydrodae::io
