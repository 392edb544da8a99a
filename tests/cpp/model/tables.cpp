#include "hydrodae/model/tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "hydrodae/core/text.h"

using namespace hydrodae;
using model::FieldInfo;
using model::TableInfo;

namespace {

template <class T> const T& named(const std::vector<T>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const T& item) {
    if constexpr (requires { item.key; })
      return item.key == name;
    else
      return item.name == name;
  });
  REQUIRE_MESSAGE(found != items.end(), name);
  return *found;
}

std::string keys_of(const TableInfo& table) {
  std::vector<std::string> keys;
  for (const FieldInfo& field : table.fields)
    keys.push_back(field.key);
  for (const TableInfo& inner : table.nested)
    keys.push_back(inner.name);
  return joined(keys, " ");
}

void for_each(const std::vector<TableInfo>& tables,
              const std::function<void(const TableInfo&)>& visit) {
  for (const TableInfo& table : tables) {
    visit(table);
    for_each(table.nested, visit);
    for_each(table.types, visit);
  }
}

} // namespace

TEST_CASE("every table, type and key says what it means") {
  for_each(model::tables(), [](const TableInfo& table) {
    CHECK_MESSAGE(!table.doc.empty(), table.name);
    for (const FieldInfo& field : table.fields)
      CHECK_MESSAGE((field.doc.ends_with(".") && !field.unit.empty()), table.name, ".", field.key);
  });
}

TEST_CASE("each type of a list is chosen by its name") {
  for (const TableInfo& table : model::tables())
    for (const TableInfo& type : table.types)
      CHECK(named(type.fields, "type").choices == std::vector<std::string>{type.name});
}

TEST_CASE("a list with types has what all types have") {
  const std::vector<TableInfo> all = model::tables();
  CHECK(keys_of(named(all, "force")) == "name type");
  CHECK(keys_of(named(all, "joint")) == "name type body_a body_b point");
  CHECK(keys_of(named(named(all, "joint").types, "screw")) ==
        "name type body_a body_b point axis axis_x pitch initial");
  CHECK(keys_of(named(named(all, "joint").types, "fixed")) ==
        "name type body_a body_b point axis axis_x");
  const TableInfo& hinge = named(named(all, "joint").types, "revolute");
  CHECK(keys_of(hinge.nested.at(0)) == "angle_deg angle_rate");
  CHECK(keys_of(named(named(all, "force").types, "pto_linear")) ==
        "name type joint coordinate damping stiffness neutral delay");
}

TEST_CASE("defaults are those of the structs, and none where a value means that there is none") {
  const std::vector<TableInfo> all = model::tables();
  const auto value = [&](const std::string& table, const std::string& key) {
    return named(named(all, table).fields, key).default_value;
  };
  CHECK(value("solver", "rtol") == "1e-06");
  CHECK(value("solver", "method") == "\"auto\"");
  CHECK(value("solver", "branch_guard") == "true");
  CHECK(value("solver", "end_time").empty()); // required
  CHECK(value("solver", "length_scale").empty());
  CHECK(value("body", "motion") == "\"rigid\"");
  CHECK(value("body", "inertia") == "[0, 0, 0]");
  const TableInfo& drive = named(all, "constraint").types.at(0).nested.at(0);
  CHECK(named(drive.fields, "period").default_value.empty()); // zero is out of its range
  const TableInfo& mooring = named(named(all, "force").types, "mooring_matrix");
  CHECK(named(mooring.fields, "damping").default_value == "[0, 0, 0, 0, 0, 0]");
  CHECK(named(named(all, "joint").types, "screw").fields.back().key == "pitch");
  CHECK(named(named(named(all, "joint").types, "screw").fields, "pitch").required);
}

TEST_CASE("the list of tables is in the order of the reader") {
  CHECK(model::table_names().front() == "environment");
  CHECK(model::table_names().size() == model::tables().size());
  CHECK(named(model::tables(), "solver").required);
  CHECK(named(model::tables(), "body").required);
  CHECK(named(model::tables(), "body").list);
  CHECK_FALSE(named(model::tables(), "hydro").required);
}
