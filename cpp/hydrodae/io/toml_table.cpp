#include "hydrodae/io/toml_table.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::io {

void check_keys(const Table& table, const std::vector<std::string>& valid) {
  for (const auto& [key, node] : table.node) {
    if (std::find(valid.begin(), valid.end(), key.str()) != valid.end())
      continue;
    throw CaseError(position(key.source()) + ": unknown key " + in_quotes(key.str()) + " in " +
                    table.label + (table.type.empty() ? "" : " of type " + table.type) +
                    suggestion(key.str(), valid));
  }
}

const toml::node* find_key(const Table& table, Key& key, Positions& positions) {
  const auto found = table.node.find(key.name);
  if (found == table.node.end())
    return nullptr;
  const std::string where = position(found->first.source());
  positions[(table.path.empty() ? "" : table.path + ".") + std::string(key.name)] = where;
  key.where = where + ": key " + in_quotes(key.name) + " in " + table.label;
  return &found->second;
}

void missing_key(const Table& table, std::string_view name, std::string_view unit,
                 std::string_view doc) {
  const std::string text(doc.substr(0, doc.find_last_not_of('.') + 1));
  throw CaseError(table.position + ": missing key " + in_quotes(name) + " in " + table.label +
                  " (" + text + (unit == "-" ? "" : " [" + std::string(unit) + "]") + ")");
}

Table nested_table(const Table& parent, const toml::node& node, const std::string& name,
                   Positions& positions) {
  const std::string where = position(parent.node.find(name)->first.source());
  const std::string label = name + " of " + parent.label;
  if (!node.is_table())
    throw CaseError(where + ": " + label + " must be a table, such as " + name + " = { ... }");
  const std::string path = parent.path + "." + name;
  positions[path] = where;
  return {*node.as_table(), label, path, where, parent.kind + "." + name, parent.type};
}

} // namespace hydrodae::io
