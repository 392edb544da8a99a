#pragma once
/// A table of a case file as the struct that declares its keys (`T::fields()`).

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
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

/// Table under `name` of `parent`, which is read into a member; throws if it is no table.
Table nested_table(const Table& parent, const toml::node& node, const std::string& name,
                   Places& places);

/// Struct that a table is read into: its fields, and the tables inside it.
struct Target {
  std::string name; ///< key of a table inside another
  void* value = nullptr;
  std::vector<AnyField> fields;
  bool typed = false; ///< whether the key `type` stands behind the name
  std::vector<Target> nested;
};

template <class T> Target target_of(T& value, const char* name = "") {
  Target target{name, &value, T::fields(), NamedType<T>, {}};
  for_each_nested<T>([&](const char* inner, auto member) {
    target.nested.push_back(target_of(value.*member, inner));
  });
  return target;
}

/// Keys that a table may have, and the names of the tables inside.
std::vector<std::string> valid_keys(const Target& target);

/// Reads and checks all keys of `table`. Throws CaseError.
void read_target(const Table& table, Places& places, const Target& target);

template <class T> T read_table(const Table& table, Places& places) {
  T value{};
  read_target(table, places, target_of(value));
  return value;
}

} // namespace hydrodae::io
