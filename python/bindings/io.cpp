#include <pybind11/stl.h>

#include "bindings.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/io/libraries.h"

namespace py = pybind11;

namespace hydrodae::bindings {

void bind_io(py::module_& module) {
  module.def(
      "load_case",
      [](const std::string& path, const io::Overrides& overrides) {
        return io::read_case(path, overrides);
      },
      py::arg("path"), py::arg("overrides"), py::call_guard<py::gil_scoped_release>(),
      "Read a case file; `overrides` maps dotted keys to TOML values. Raises CaseError.");
  module.def(
      "parse_case",
      [](const std::string& text, const std::string& directory, const io::Overrides& overrides) {
        return io::parse_case(text, directory, overrides);
      },
      py::arg("text"), py::arg("directory"), py::arg("overrides"),
      py::call_guard<py::gil_scoped_release>(),
      "Read a case from a string; paths in it are relative to `directory`. Raises CaseError.");
  module.def(
      "join_libraries",
      [](model::Scene scene, const std::vector<std::string>& paths) {
        io::join_libraries(paths, scene);
        return scene;
      },
      py::arg("scene"), py::arg("paths"),
      "A copy of the scene whose forces have their laws from these shared libraries. Raises "
      "CaseError.");
  module.def("changed_file", &model::changed_file, py::arg("before"), py::arg("now"),
             "The first difference between two texts of `Scene.text_of_files` in words; empty: "
             "none.");
  module.def("check_tables", &io::check_tables, py::arg("text"),
             py::call_guard<py::gil_scoped_release>(),
             "Read the tables of a part of a case, each by itself. Raises CaseError.");
}

} // namespace hydrodae::bindings
