#pragma once
/// Keys of case files as text, for `hydrodae-solve --keys [TABLE [TYPE]]`.

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/tables.h"

namespace hydrodae::app {

/// Table with this name; throws CaseError with the nearest one.
inline const model::TableInfo& find_table(const std::vector<model::TableInfo>& tables,
                                          const std::string& name, const std::string& sort) {
  std::vector<std::string> names;
  for (const model::TableInfo& table : tables) {
    if (table.name == name)
      return table;
    names.push_back(table.name);
  }
  throw CaseError("there is no " + sort + " " + in_quotes(name) + suggestion(name, names));
}

/// Text with a line for each table: name and meaning.
inline std::string tables_text(const std::vector<model::TableInfo>& tables) {
  std::ostringstream text;
  for (const model::TableInfo& table : tables)
    text << "  " << std::left << std::setw(18) << table.name << ' ' << table.doc << '\n';
  return text.str();
}

/// Limits as text: "required, > 0", "default 0", "0 to 1"; "" for no limits.
inline std::string limits_text(const model::FieldInfo& field) {
  std::vector<std::string> parts;
  if (field.required)
    parts.emplace_back("required");
  if (!field.default_value.empty())
    parts.push_back("default " + field.default_value);
  if (!field.choices.empty())
    parts.push_back("one of " + joined(field.choices));
  if (field.range.min > any_value.min)
    parts.push_back((field.range.open_min ? "> " : ">= ") + number_text(field.range.min));
  if (field.range.max < any_value.max && !field.range.far_max)
    parts.push_back("<= " + number_text(field.range.max));
  return joined(parts);
}

/// Text of keys with unit, limits and meaning; inner tables have dotted names.
inline std::string keys_text(const model::TableInfo& table, const std::string& prefix = "") {
  std::ostringstream text;
  for (const model::FieldInfo& field : table.fields) {
    text << "  " << prefix << field.key;
    if (field.unit != "-")
      text << " [" << field.unit << ']';
    const std::string limits = limits_text(field);
    text << (limits.empty() ? "" : " (" + limits + ")") << "\n      " << field.doc << '\n';
  }
  for (const model::TableInfo& inner : table.nested)
    text << keys_text(inner, prefix + inner.name + ".");
  return text.str();
}

/// Output of `--keys` for these words. Throws CaseError on unknown names.
inline std::string keys_answer(const std::vector<std::string>& words) {
  const std::vector<model::TableInfo> tables = model::tables();
  if (words.empty())
    return tables_text(tables);
  const model::TableInfo& table = find_table(tables, words[0], "table");
  if (words.size() == 1)
    return table.doc + "\n" + tables_text(table.types) +
           (table.types.empty() ? "" : "Keys of every type:\n") + keys_text(table);
  if (table.types.empty())
    throw CaseError("the table " + in_quotes(table.name) + " has no types");
  const model::TableInfo& type = find_table(table.types, words[1], table.name + " of type");
  return type.doc + "\n" + keys_text(type);
}

} // namespace hydrodae::app
