#include "hydrodae/model/tables.h"

#include <pybind11/stl.h>

#include <cmath>

#include "bindings.h"
#include "hydrodae/core/methods.h"
#include "hydrodae/core/text.h"

namespace py = pybind11;

namespace hydrodae::bindings {
namespace {

py::object bound(double value) {
  return std::isfinite(value) ? py::object(py::float_(value)) : py::object(py::none());
}

py::dict field_dict(const model::FieldInfo& field) {
  py::dict out;
  out["key"] = field.key;
  out["unit"] = field.unit;
  out["doc"] = field.doc;
  out["kind"] = model::name_of(field.kind);
  out["required"] = field.required;
  out["minimum"] = bound(field.range.min);
  out["maximum"] = bound(field.range.max);
  out["above_minimum"] = field.range.open_min;
  out["far_maximum"] = field.range.far_max;
  out["choices"] = field.choices;
  out["default"] = field.default_value;
  return out;
}

py::dict table_dict(const model::TableInfo& table) {
  const auto dicts = [](const auto& items, const auto& make) {
    py::list list;
    for (const auto& item : items)
      list.append(make(item));
    return list;
  };
  py::dict out;
  out["name"] = table.name;
  out["doc"] = table.doc;
  out["list"] = table.list;
  out["required"] = table.required;
  out["fields"] = dicts(table.fields, field_dict);
  out["nested"] = dicts(table.nested, table_dict);
  out["types"] = dicts(table.types, table_dict);
  return out;
}

} // namespace

void bind_tables(py::module_& module) {
  module.def(
      "tables",
      [] {
        py::list list;
        for (const model::TableInfo& table : model::tables())
          list.append(table_dict(table));
        return list;
      },
      "Every table of a case file with its keys, as nested dicts.");
  module.def(
      "methods",
      [] {
        py::list list;
        for (const MethodTraits& m : methods()) {
          py::dict out;
          out["name"] = m.name;
          out["orders"] = m.orders;
          out["adapts"] = m.adapts;
          out["fixes"] = m.fixes;
          out["limits_order"] = m.limits_order;
          out["takes_radius"] = m.takes_radius;
          list.append(out);
        }
        return list;
      },
      "Every integrator: name, orders that it may be given, whether it adapts its steps, fixes "
      "them, has a highest order, and takes a spectral radius.");
  module.def(
      "suggestion",
      [](const std::string& wanted, const std::vector<std::string>& names) {
        return suggestion(wanted, names);
      },
      py::arg("wanted"), py::arg("names"),
      "The end of a message about an unknown name: the nearest one and all that are valid.");
}

} // namespace hydrodae::bindings
