#pragma once
/// Tables of a case file with their keys, as data. `hydrodae keys`, `hydrodae schema`, the pages of
/// docs/reference and the Python class Scene use them.

#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"

namespace hydrodae::model {

/// Kind of a key's value; see `Member` for the short forms of words and matrix6.
enum class ValueKind {
  number,
  integer,
  truth,
  word,
  words,
  numbers,
  points,
  vector3,
  vector6,
  matrix6
};

/// Name of a kind: "number", ...
std::string_view name_of(ValueKind kind);

struct FieldInfo {
  std::string key, unit, doc;
  ValueKind kind = ValueKind::number;
  bool required = false;
  Range range;                      ///< range of every number of the value, in the unit of the file
  std::vector<std::string> choices; ///< allowed words; empty: any
  std::string default_value;        ///< default as TOML (also valid JSON); "" without a default
};

struct TableInfo {
  std::string name; ///< "body", or "initial" inside it; for a type, the word of the key `type`
  std::string doc;
  bool list = false;             ///< [[name]] rather than [name]
  bool required = false;         ///< true: every case must have it
  std::vector<FieldInfo> fields; ///< keys; for a list with types, those that all types share
  std::vector<TableInfo> nested;
  std::vector<TableInfo> types; ///< types, each with all its keys; empty if entries are of one kind
};

std::vector<TableInfo> tables();

/// Names of the tables.
std::vector<std::string> table_names();

} // namespace hydrodae::model
