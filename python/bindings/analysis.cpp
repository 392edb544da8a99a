#include "hydrodae/statics/analysis.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bindings.h"
#include "hydrodae/core/error.h"
#include "hydrodae/hydro/headings.h"
#include "hydrodae/hydro/symmetry.h"
#include "hydrodae/math/sampling.h"

namespace py = pybind11;

namespace hydrodae::bindings {
namespace {

py::list moorings(const statics::LinearModel& m) {
  using namespace py::literals;
  py::list out;
  for (const statics::Mooring& at : m.moorings)
    out.append(py::dict("name"_a = at.name, "type"_a = at.type, "bodies"_a = at.bodies,
                        "places"_a = at.places, "load"_a = at.load, "stiffness"_a = at.stiffness,
                        "damping"_a = at.damping, "channels"_a = at.channels, "units"_a = at.units,
                        "values"_a = at.values));
  return out;
}

py::dict linear_model(const model::Scene& scene) {
  using namespace py::literals;
  statics::LinearModel m;
  try {
    const py::gil_scoped_release release;
    m = statics::linearize(scene);
  } catch (const ModelError& error) {
    throw model::located(scene, error);
  }
  return py::dict(
      "coordinates"_a = m.coordinates, "mass"_a = m.mass, "damping"_a = m.damping,
      "stiffness"_a = m.stiffness, "constraints"_a = m.constraints,
      "load_by_state"_a = m.load_by_state, "state_by_state"_a = m.state_by_state,
      "state_by_xi"_a = m.state_by_xi, "state_by_rate"_a = m.state_by_rate,
      "state_of"_a = m.state_of, "hydro_labels"_a = m.hydro_labels, "hydro_map"_a = m.hydro_map,
      "hydro_yaws"_a = m.hydro_yaws, "hydro_points"_a = m.hydro_points, "motions"_a = m.motions,
      "motion_map"_a = m.motion_map, "dampers"_a = m.dampers, "damper_damping"_a = m.damper_damping,
      "damper_stiffness"_a = m.damper_stiffness, "damper_delay"_a = m.damper_delay,
      "damper_map"_a = m.damper_map, "reactions"_a = m.reactions,
      "reaction_by_xi"_a = m.reaction_by_xi, "reaction_by_lambda"_a = m.reaction_by_lambda,
      "bodies"_a = m.bodies, "offsets"_a = m.offsets, "rotations"_a = m.rotations,
      "places"_a = m.places, "moorings"_a = moorings(m), "reaction"_a = m.reaction,
      "supports"_a = m.supports, "support"_a = m.support, "notes"_a = m.notes,
      "water_points"_a = m.water_points, "water_loads"_a = m.water_loads,
      "water_depth"_a = m.water_depth, "gravity"_a = m.gravity);
}

/// `hydro::add_images` on tables as Python holds them: frequency first.
py::tuple with_images(const std::vector<std::string>& coordinates, const py::dict& points,
                      const MatrixX& added_mass_inf, const VectorX& omega,
                      const std::vector<MatrixX>& damping, const VectorX& heading,
                      const std::vector<Eigen::MatrixXcd>& excitation,
                      const std::vector<double>& water) {
  hydro::Database db;
  db.coordinates = coordinates;
  for (const auto& [name, point] : points) {
    hydro::DatabaseBody& body = db.bodies.emplace_back();
    body.name = name.cast<std::string>();
    body.reference_point = point.cast<Vector3>();
  }
  db.added_mass_inf = added_mass_inf;
  db.omega = omega;
  db.damping = damping;
  db.heading = heading;
  db.excitation = excitation;
  db.rho = water.at(0);
  db.gravity = water.at(1);
  db.water_depth = water.at(2);
  hydro::add_images(db);
  return py::make_tuple(db.heading, db.excitation);
}

std::optional<std::pair<double, double>> as_pair(const std::optional<Interval>& interval) {
  if (!interval)
    return std::nullopt;
  return std::pair{interval->low, interval->high};
}

} // namespace

void bind_analysis(py::module_& module) {
  module.def("linearize", &linear_model, py::arg("scene"),
             "The static equilibrium of the scene in still water and its linear model there; see "
             "cpp/hydrodae/analysis.h.\nRaises CaseError.");
  module.def("wave_components", &statics::wave_components, py::arg("scene"),
             "Components of all wave systems, (n, 4): frequency, heading, amplitude, phase.");
  module.def(
      "mean_interval",
      [](const std::vector<double>& values) { return as_pair(mean_interval(values)); },
      py::arg("values"),
      "95 % interval of the mean of the process that the values, at equal steps, are a sample of; "
      "None of too\nfew. See cpp/hydrodae/math/sampling.h.");
  module.attr("SAMPLING_SPANS") = sampling_spans;
  module.attr("SAMPLING_FEWEST") = sampling_fewest;
  module.attr("SAMPLING_PERIODS") = sampling_periods;
  module.def("with_images", &with_images, py::arg("coordinates"), py::arg("points"),
             py::arg("added_mass_inf"), py::arg("omega"), py::arg("damping"), py::arg("heading"),
             py::arg("excitation"), py::arg("water"),
             "Headings and excitation, one table (nw, n) a heading, with those that the symmetry "
             "of the bodies adds; see cpp/hydrodae/hydro/symmetry.h.\n`points`: reference point of "
             "each body; `water`: rho, gravity, depth.");
  py::class_<hydro::Headings>(module, "Headings", "See cpp/hydrodae/hydro/headings.h.")
      .def(py::init<VectorX>(), py::arg("heading"))
      .def("covered", &hydro::Headings::covered, py::arg("heading"))
      .def("weights", &hydro::Headings::weights, py::arg("heading"))
      .def("doubt", &hydro::Headings::doubt, py::arg("miss"))
      .def_property_readonly("misses", &hydro::Headings::misses);
}

} // namespace hydrodae::bindings
