#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "hydrodae/core/error.h"
#include "hydrodae/line/catenary_line.h"

namespace py = pybind11;

namespace hydrodae::bindings {

namespace {

/// The line of a force of type `catenary` with these values. Throws CaseError.
line::CatenaryLine make_line(const std::vector<double>& length, const std::vector<double>& weight,
                             const std::vector<double>& stiffness, const std::vector<double>& loads,
                             bool seabed, double friction, double X, double Z) {
  line::CatenaryLine line;
  line.name = "catenary";
  line.length = length;
  line.weight = weight;
  line.stiffness = stiffness;
  line.loads = loads;
  line.seabed = seabed;
  line.friction = friction;
  line.point_b = Vector3(X, 0.0, Z);
  const auto refuse = [](const std::string& message) { throw CaseError("catenary: " + message); };
  if (const std::optional<Fault> fault = line.fault())
    refuse(fault->message);
  for (const double value : length)
    if (!(value > 0.0))
      refuse("'length' must be above 0");
  for (const double value : stiffness)
    if (!(value > 0.0))
      refuse("'stiffness' must be above 0");
  if (!(X >= 0.0))
    refuse("'x' must not be below 0");
  return line;
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
         const std::vector<double>& stiffness, const std::vector<double>& loads, bool seabed,
         double friction, const std::vector<double>& points) {
        const Catenary line =
            make_line(length, weight, stiffness, loads, seabed, friction, X, Z).law().line;
        const CatenaryHold found = hold(line, X, Z);
        MatrixX shape(4, static_cast<Index>(points.size()));
        const std::vector<LinePoint> profile = hydrodae::profile(line, found, X, points);
        for (std::size_t i = 0; i < profile.size(); ++i)
          shape.col(static_cast<Index>(i)) << profile[i].s, profile[i].x, profile[i].z,
              profile[i].tension;
        return std::pair{found, shape};
      },
      py::arg("x"), py::arg("z"), py::arg("length"), py::arg("weight"), py::arg("stiffness"),
      py::arg("loads"), py::arg("seabed"), py::arg("friction"), py::arg("points"));
}

} // namespace hydrodae::bindings
