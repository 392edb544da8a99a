#include "hydrodae/model/tables.h"

#include <algorithm>

#include "hydrodae/core/nested.h"
#include "hydrodae/model/field_info.h"
#include "hydrodae/model/scene_tables.h"
#include "hydrodae/model/type_keys.h"

namespace hydrodae::model {
namespace {

bool is_among(const std::string& key, const std::vector<std::string>& keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// The table of a struct, without types.
template <class T> TableInfo plain_table(const std::string& name) {
  TableInfo table{
      name, std::string(doc_of<T>()), false, is_required_table(name), field_infos<T>(), {}, {}};
  for_each_nested<T>([&](const std::string& inner, auto member) {
    using Inner = std::remove_cvref_t<decltype(std::declval<T>().*member)>;
    table.nested.push_back(plain_table<Inner>(inner));
  });
  return table;
}

/// Leaves what an entry of this type has. `kind` is the path of the table: "joint", then
/// "joint.initial".
void narrow(TableInfo& table, const std::string& kind, const std::string& type) {
  const std::vector<std::string> own = keys_of_type(kind, type);
  if (own.empty())
    return;
  const std::vector<std::string> needed = needed_keys(kind, type);
  std::erase_if(table.fields, [&](const FieldInfo& field) { return !is_among(field.key, own); });
  std::erase_if(table.nested, [&](const TableInfo& inner) { return !is_among(inner.name, own); });
  for (FieldInfo& field : table.fields) {
    if (field.key == "type")
      field.choices = {type};
    if (!is_among(field.key, needed))
      continue;
    field.required = true;
    field.default_value.clear();
  }
  for (TableInfo& inner : table.nested)
    narrow(inner, kind + "." + inner.name, type);
}

/// Splits a list by the choices of its key `type`, if it has one.
void split_by_type(TableInfo& table) {
  const TableInfo whole = table;
  for (const FieldInfo& field : whole.fields) {
    if (field.key != "type")
      continue;
    for (const std::string& name : field.choices) {
      TableInfo type = whole;
      type.name = name;
      type.doc = doc_of_type(table.name, name);
      type.required = false;
      narrow(type, table.name, name);
      table.types.push_back(std::move(type));
    }
  }
}

/// Of a table with types only what they all have.
void keep_common(TableInfo& table) {
  const auto in_all = [&](const auto& has) {
    return std::all_of(table.types.begin(), table.types.end(), has);
  };
  std::erase_if(table.fields, [&](const FieldInfo& field) {
    return !in_all([&](const TableInfo& type) {
      return std::any_of(type.fields.begin(), type.fields.end(),
                         [&](const FieldInfo& other) { return other.key == field.key; });
    });
  });
  std::erase_if(table.nested, [&](const TableInfo& inner) {
    return !in_all([&](const TableInfo& type) {
      return std::any_of(type.nested.begin(), type.nested.end(),
                         [&](const TableInfo& other) { return other.name == inner.name; });
    });
  });
}

/// The key `type`, which is no field of the structs that name theirs as a constant.
FieldInfo type_field(const std::string& doc, std::vector<std::string> choices) {
  FieldInfo field{"type", "-", doc, ValueKind::word, true, any_value, std::move(choices), ""};
  return field;
}

TableInfo force_table(const std::string& name) {
  TableInfo table{
      name, "What loads the bodies beside weight, water and joints.", true, false, {}, {}, {}};
  std::vector<std::string> names;
  for_each_force_type([&]<class Force>(std::type_identity<Force>) {
    TableInfo type = plain_table<Force>(std::string(Force::type));
    type.list = true;
    const auto place = type.fields.begin() + (type.fields.empty() ? 0 : 1); // after the name
    type.fields.insert(place, type_field("Kind of force.", {type.name}));
    names.push_back(type.name);
    table.types.push_back(std::move(type));
  });
  table.fields = table.types.front().fields;
  keep_common(table);
  for (FieldInfo& field : table.fields)
    if (field.key == "type")
      field.choices = names;
  return table;
}

/// Appends the table of each member of the scene.
struct Collector {
  std::vector<TableInfo>& out;

  template <class T> void operator()(const std::string& name, T Scene::*) const {
    out.push_back(plain_table<T>(name));
  }
  template <class T> void operator()(const std::string& name, std::optional<T> Scene::*) const {
    out.push_back(plain_table<T>(name));
  }
  template <class T> void operator()(const std::string& name, std::vector<T> Scene::*) const {
    TableInfo table = plain_table<T>(name);
    table.list = true;
    split_by_type(table);
    keep_common(table);
    out.push_back(std::move(table));
  }
  void operator()(const std::string& name, Forces Scene::*) const {
    out.push_back(force_table(name));
  }
};

} // namespace

std::vector<TableInfo> tables() {
  std::vector<TableInfo> out;
  for_each_table(Collector{out});
  return out;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for_each_table([&](const char* name, auto) { names.emplace_back(name); });
  return names;
}

} // namespace hydrodae::model
