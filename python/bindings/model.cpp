#include "hydrodae/model/forces.h"
#include "hydrodae/model/scene.h"

#include <pybind11/stl.h>

#include "bindings.h"

namespace py = pybind11;

namespace hydrodae::bindings {
namespace {
using Place = std::tuple<std::string, int, int>; ///< file, line, column
} // namespace
namespace {

template <class T> std::vector<std::string> names(const std::vector<T>& items) {
  std::vector<std::string> out;
  for (const T& item : items)
    out.push_back(name_of_entry(item));
  return out;
}

} // namespace

void bind_model(py::module_& module) {
  using model::Scene;
  py::class_<Scene>(module, "Scene", "A case file that was read and checked; immutable.")
      .def_property_readonly("title", [](const Scene& s) { return s.title; })
      .def_property_readonly("body_names", [](const Scene& s) { return names(s.bodies); })
      .def_property_readonly("joint_names", [](const Scene& s) { return names(s.joints); })
      .def_property_readonly("wave_names", [](const Scene& s) { return names(s.waves); })
      .def_property_readonly(
          "text", [](const Scene& s) { return s.text; }, "The case file as it was read.")
      .def_property_readonly(
          "end_time", [](const Scene& s) { return s.solver.end_time; }, "End of the run, s.")
      .def_property_readonly(
          "output_step", [](const Scene& s) { return s.output.step; }, "Between samples, s.")
      .def_property_readonly(
          "python_drives",
          [](const Scene& s) {
            std::vector<std::string> out;
            for (const model::Constraint& c : s.constraints)
              if (const auto* driven = c.as<model::DrivenCoordinate>();
                  driven && driven->drive.python)
                out.push_back(driven->name);
            return out;
          },
          "Constraints whose drive is a Python function.")
      .def_property_readonly(
          "python_forces",
          [](const Scene& s) {
            std::vector<std::string> out;
            model::for_each_force(s, [&](const auto& force) {
              if constexpr (requires { force.function; })
                out.push_back(force.name);
            });
            return out;
          },
          "Forces whose law is a Python function.")
      .def_property_readonly(
          "python_controllers",
          [](const Scene& s) {
            std::vector<std::string> out;
            for (const model::Controller& c : s.controllers)
              if (c.as<control::Python>())
                out.push_back(c->name);
            return out;
          },
          "Controllers that are Python functions.")
      .def_property_readonly(
          "database_path",
          [](const Scene& s) { return s.database ? s.database->path : std::string(); },
          "The hydrodynamic database, \"\" without.")
      .def_property_readonly(
          "database_water",
          [](const Scene& s) {
            std::array<double, 3> out{};
            if (s.database)
              out = {s.database->rho, s.database->gravity, s.database->water_depth};
            return std::make_tuple(out[0], out[1], out[2]);
          },
          "Density [kg/m3], gravity [m/s2] and depth [m] of the database, zeros without.")
      .def_property_readonly(
          "files",
          [](const Scene& s) {
            std::vector<std::tuple<std::string, std::string, std::string, std::string>> out;
            for (const model::InputFile& f : s.files)
              out.emplace_back(f.key, f.name, f.path, f.sha256);
            return out;
          },
          "Files that the case reads: key, path in the case, path as opened, SHA-256.")
      .def_property_readonly(
          "text_of_files", [](const Scene& s) { return model::text_of_files(s.files); },
          "A line 'SHA256 KEY = PATH' for each of them, as results files keep it.")
      .def(
          "with_functions",
          [](const Scene& s, const std::map<std::string, std::string>& digests) {
            Scene copy = s;
            for (const auto& [key, digest] : digests)
              copy.files.push_back({key, "Python function", "", digest});
            return copy;
          },
          py::arg("digests"), "A copy that counts Python functions, by key, among its files.")
      .def_property_readonly(
          "places",
          [](const Scene& s) {
            std::map<std::string, Place> out;
            for (const auto& [key, at] : s.places)
              out[key] = {at.file, at.line, at.column};
            return out;
          },
          "Where each key stands: key path -> (file, line, column).")
      .def(
          "with_places",
          [](const Scene& s, const std::map<std::string, Place>& places) {
            Scene copy = s;
            copy.places.clear();
            for (const auto& [key, at] : places)
              copy.places[key] = {std::get<0>(at), std::get<1>(at), std::get<2>(at)};
            return copy;
          },
          py::arg("places"), "A copy in whose messages the keys stand at other places.")
      .def("summary", &model::summary)
      .def("__repr__", [](const Scene& s) {
        return "<hydrodae._core.Scene '" + s.title + "': " + std::to_string(s.bodies.size()) +
               " bodies, " + std::to_string(s.joints.size()) + " joints>";
      });
}

} // namespace hydrodae::bindings
