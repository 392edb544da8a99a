#include "hydrodae/io/toml_table.h"

#include <algorithm>
#include <variant>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::io {
namespace {

std::string path_of(const Table& table, std::string_view key) {
  return (table.path.empty() ? "" : table.path + ".") + std::string(key);
}

/// Text "; types with all the keys given: a, b", or "" if no type has them.
std::string types_hint(const Table& table) {
  const std::vector<std::string> types =
      table.other_types ? table.other_types() : std::vector<std::string>{};
  return types.empty() ? "" : "; types with all the keys given: " + joined(types);
}

/// Keys that a table has, and cannot have again: a list of tables takes more of them.
std::vector<std::string> taken_keys(const toml::table& node) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : node)
    if (!value.is_array_of_tables())
      keys.emplace_back(key.str());
  return keys;
}

} // namespace

void check_keys(const Table& table, const std::vector<std::string>& valid) {
  for (const auto& [key, node] : table.node) {
    if (std::find(valid.begin(), valid.end(), key.str()) != valid.end())
      continue;
    throw CaseError(place_of(key.source()), path_of(table, key.str()),
                    "unknown key " + in_quotes(key.str()) + " in " + table.label +
                        (table.type.empty() ? "" : " of type " + table.type) + types_hint(table) +
                        suggestion(key.str(), valid, taken_keys(table.node)));
  }
}

bool takes_all(const std::vector<std::string>& valid, const toml::table& node) {
  return std::all_of(node.begin(), node.end(), [&](const auto& entry) {
    return std::find(valid.begin(), valid.end(), entry.first.str()) != valid.end();
  });
}

const toml::node* find_key(const Table& table, Key& key, Places& places) {
  const auto found = table.node.find(key.name);
  if (found == table.node.end())
    return nullptr;
  key.place = place_of(found->first.source());
  key.path = path_of(table, key.name);
  key.label = "key " + in_quotes(key.name) + " in " + table.label;
  places[key.path] = key.place;
  return &found->second;
}

void missing_key(const Table& table, std::string_view name, std::string_view unit,
                 std::string_view doc) {
  const std::string text(doc.substr(0, doc.find_last_not_of('.') + 1));
  throw CaseError(table.place, path_of(table, name),
                  "missing key " + in_quotes(name) + " in " + table.label + " (" + text +
                      (unit == "-" ? "" : " [" + std::string(unit) + "]") + ")");
}

Table nested_table(const Table& parent, const toml::node& node, const std::string& name,
                   Places& places) {
  const FilePlace place = place_of(parent.node.find(name)->first.source());
  const std::string label = name + " of " + parent.label, path = path_of(parent, name);
  if (!node.is_table())
    throw CaseError(place, path, label + " must be a table, such as " + name + " = { ... }");
  places[path] = place;
  return {*node.as_table(), label, path, place, parent.kind + "." + name, parent.type};
}

std::vector<std::string> valid_keys(const Target& target) {
  std::vector<std::string> valid;
  for (const AnyField& field : target.fields)
    valid.emplace_back(field.key);
  if (target.typed)
    valid.insert(valid.begin() + 1, "type"); // behind the name
  for (const Target& inner : target.nested)
    valid.push_back(inner.name);
  return valid;
}

void read_target(const Table& table, Places& places, const Target& target) {
  check_keys(table, valid_keys(target));

  for (const AnyField& field : target.fields) {
    Key key{field.key, field.unit, field.range, field.choices};
    const toml::node* node = find_key(table, key, places);
    if (node)
      std::visit([&](auto* value) { read_value(*node, key, *value); }, field.in(target.value));
    else if (field.required)
      missing_key(table, field.key, field.unit, field.doc);
  }
  for (const Target& inner : target.nested)
    if (const toml::node* node = table.node.get(inner.name))
      read_target(nested_table(table, *node, inner.name, places), places, inner);
}

} // namespace hydrodae::io
