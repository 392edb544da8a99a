#include "hydrodae/model/tables.h"

#include <algorithm>

#include "hydrodae/core/nested.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/field_info.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/joint_keys.h"
#include "hydrodae/model/scene_tables.h"

namespace hydrodae::model {
namespace {

/// Table of a struct without types.
template <class T> TableInfo plain_table(const std::string& name) {
  TableInfo table{
      name, std::string(doc_of<T>()), false, is_required_table(name), field_infos<T>(), {}, {}};
  for_each_nested<T>([&](const std::string& inner, auto member) {
    using Inner = std::remove_cvref_t<decltype(std::declval<T>().*member)>;
    table.nested.push_back(plain_table<Inner>(inner));
  });
  return table;
}

/// Keeps only the keys that all types of a table share.
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

/// Key `type`, which is no field of the structs: they name theirs as a constant.
FieldInfo type_field(const std::string& doc, std::vector<std::string> choices) {
  FieldInfo field{"type", "-", doc, ValueKind::word, true, any_value, std::move(choices), ""};
  return field;
}

/// List whose entries are one of several structs; `for_each_type` calls with each of them.
template <class ForEach>
TableInfo typed_table(const std::string& name, const std::string& doc, const ForEach& for_each) {
  TableInfo table{name, doc, true, false, {}, {}, {}};
  std::vector<std::string> names;
  for_each([&]<class T>(std::type_identity<T>) {
    TableInfo type = plain_table<T>(std::string(T::type));
    type.list = true;
    const auto place = type.fields.begin() + (type.fields.empty() ? 0 : 1); // after the name
    type.fields.insert(place, type_field("Kind of " + name + ".", {type.name}));
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

/// Table [[joint]]: the rows of the joint table are its types, each with the keys that it needs.
TableInfo joint_table(const std::string& name) {
  TableInfo table = plain_table<Joint>(name);
  table.list = true;
  for (const joint::JointType& row : joint::joint_types()) {
    TableInfo type = table;
    type.name = row.name;
    type.doc = row.doc;
    const JointKeys keys = joint_keys(row);
    const auto strange = [](const std::vector<std::string>& own, const std::string& key) {
      return std::find(own.begin(), own.end(), key) == own.end();
    };
    std::erase_if(type.fields, [&](const FieldInfo& f) { return strange(keys.own, f.key); });
    std::erase_if(type.nested, [&](const TableInfo& t) { return strange(keys.own, t.name); });
    for (FieldInfo& field : type.fields) {
      if (field.key == "type")
        field.choices = {type.name};
      if (!strange(keys.needed, field.key)) {
        field.required = true;
        field.default_value.clear();
      }
    }
    for (TableInfo& inner : type.nested)
      std::erase_if(inner.fields, [&](const FieldInfo& f) { return strange(keys.initial, f.key); });
    table.types.push_back(std::move(type));
  }
  keep_common(table);
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
    out.push_back(std::move(table));
  }
  template <class Shared, class... T>
  void operator()(const std::string& name, std::vector<OneOf<Shared, T...>> Scene::*) const {
    out.push_back(typed_table(name, std::string(Shared::list_doc), [](const auto& visit) {
      OneOf<Shared, T...>::for_each_type(visit);
    }));
  }
  void operator()(const std::string& name, std::vector<Joint> Scene::*) const {
    out.push_back(joint_table(name));
  }
  void operator()(const std::string& name, Indirect<Forces> Scene::*) const {
    out.push_back(typed_table(name, "What loads the bodies beside weight, water and joints.",
                              [](const auto& visit) { for_each_force_type(visit); }));
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
