#pragma once
/// A table of a case file as the struct that declares its keys (`T::fields()`).

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/core/nested.h"
#include "hydrodae/io/toml_values.h"

namespace hydrodae::io {

/// Table with its name in messages.
struct Table {
  const toml::table& node;
  std::string label; ///< "[[body]] 'flap1'"
  std::string path;  ///< "body.flap1"
  FilePlace place;
  std::string kind; ///< "body", "body.initial"; "" for the case itself
  std::string type; ///< type of the entry, "" without one
  /// Names of the types of the list whose entries may have all keys of the entry; null without
  /// types.
  std::function<std::vector<std::string>()> other_types = {};
};

/// Places by key path, for messages of later checks.
using Places = std::map<std::string, FilePlace>;

/// Throws CaseError on the first key of the table that is not in `valid`; the message lists these.
/// It proposes only what the entry can take: a key that is not given yet, or a type with all its
/// keys.
void check_keys(const Table& table, const std::vector<std::string>& valid);

/// True: every key of `node` is in `valid`.
bool takes_all(const std::vector<std::string>& valid, const toml::table& node);

/// The value of `name` with the description of its key filled in, or null. Notes its place.
const toml::node* find_key(const Table& table, Key& key, Places& places);

/// Throws CaseError: a required key is missing.
[[noreturn]] void missing_key(const Table& table, std::string_view name, std::string_view unit,
                              std::string_view doc);

/// The table under `name` of `parent`, whose members it is read into; throws if it is not a table.
Table nested_table(const Table& parent, const toml::node& node, const std::string& name,
                   Places& places);

template <class T> T read_table(const Table& table, Places& places);

/// The table `name` of `parent`, if it has one.
template <class T>
void read_nested(const Table& parent, const std::string& name, Places& places, T& out) {
  if (const toml::node* node = parent.node.get(name))
    out = read_table<T>(nested_table(parent, *node, name, places), places);
}

/// Keys that a table of `T` may have, and the names of the tables inside.
template <class T> std::vector<std::string> valid_keys() {
  std::vector<std::string> valid;
  for (const Field<T>& field : T::fields())
    valid.emplace_back(field.key);
  if constexpr (NamedType<T>)
    valid.insert(valid.begin() + 1, "type"); // behind the name
  for_each_nested<T>([&](const char* name, auto) { valid.emplace_back(name); });
  return valid;
}

/// Reads and checks all keys of `table`. Throws CaseError.
template <class T> T read_table(const Table& table, Places& places) {
  T value{};
  const Fields<T> fields = T::fields();
  check_keys(table, valid_keys<T>());

  for (const Field<T>& field : fields) {
    Key key{field.key, field.unit, field.range, field.choices};
    const toml::node* node = find_key(table, key, places);
    if (node)
      std::visit([&](auto member) { read_value(*node, key, value.*member); }, field.member);
    else if (field.required)
      missing_key(table, field.key, field.unit, field.doc);
  }
  for_each_nested<T>(
      [&](const char* name, auto member) { read_nested(table, name, places, value.*member); });
  return value;
}

} // namespace hydrodae::io
