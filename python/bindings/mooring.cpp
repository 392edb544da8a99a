#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/line/catenary_line.h"

namespace py = pybind11;

namespace hydrodae::bindings {

namespace {

/// Refuses a line of a force of type `catenary` with these values. Throws CaseError.
void check_line(const line::CatenaryLine& line) {
  const auto refuse = [](const std::string& message) { throw CaseError("catenary: " + message); };
  if (const std::optional<Fault> fault = line.fault())
    refuse(fault->message);
  const auto all = [&](const char* key, const std::vector<double>& values, bool zero) {
    for (const double value : values)
      if (!(value > 0.0 || (zero && value == 0.0)))
        refuse(in_quotes(key) + " must " + (zero ? "not be below" : "be above") + " 0");
  };
  all("length", line.length, false);
  all("stiffness", line.stiffness, false);
  all("dry_weight", line.dry_weight, true);
  if (!(line.point_b[0] >= 0.0))
    refuse("'x' must not be below 0");
}

} // namespace

void bind_mooring(py::module_& module) {
  py::class_<CatenaryHold>(module, "CatenaryHold")
      .def_readonly("horizontal", &CatenaryHold::horizontal)
      .def_readonly("vertical", &CatenaryHold::vertical)
      .def_readonly("stiffness", &CatenaryHold::stiffness)
      .def_readonly("out_of_plane", &CatenaryHold::out_of_plane)
      .def_readonly("on_seabed", &CatenaryHold::on_bed)
      .def_readonly("anchor_horizontal", &CatenaryHold::anchor_horizontal)
      .def_readonly("anchor_vertical", &CatenaryHold::anchor_vertical)
      .def_property_readonly("tension", &CatenaryHold::tension);
  module.def(
      "catenary",
      [](double X, double Z, const std::vector<double>& length, const std::vector<double>& weight,
         const std::vector<double>& stiffness, const std::vector<double>& loads,
         const std::vector<double>& dry_weight, const std::vector<double>& dry_loads,
         double surface, bool seabed, double friction, const std::vector<double>& points) {
        line::CatenaryLine force;
        force.length = length;
        force.weight = weight;
        force.stiffness = stiffness;
        force.loads = loads;
        force.dry_weight = dry_weight;
        force.dry_loads = dry_loads;
        force.surface = surface;
        force.seabed = seabed;
        force.friction = friction;
        force.point_b = Vector3(X, 0.0, Z);
        check_line(force);
        const Catenary line = force.law().line;
        const CatenaryHold found = hold(line, X, Z, Z - surface);
        MatrixX shape(4, static_cast<Index>(points.size()));
        const std::vector<LinePoint> profile =
            hydrodae::profile(line, found, X, points, Z - surface);
        for (std::size_t i = 0; i < profile.size(); ++i)
          shape.col(static_cast<Index>(i)) << profile[i].s, profile[i].x, profile[i].z,
              profile[i].tension;
        return std::pair{found, shape};
      },
      py::arg("x"), py::arg("z"), py::arg("length"), py::arg("weight"), py::arg("stiffness"),
      py::arg("loads"), py::arg("dry_weight"), py::arg("dry_loads"), py::arg("surface"),
      py::arg("seabed"), py::arg("friction"), py::arg("points"));
}

} // namespace hydrodae::bindings
