/// Meshes in the water: hydrostatics and Froude-Krylov loads of the wetted surface.

#include <cmath>
#include <complex>

#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hull/floating.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/water/hull_list.h"

namespace hydrodae::build {

namespace {

using Vector6c = Eigen::Matrix<std::complex<double>, 6, 1>;

constexpr double small_wave = 1e-4; ///< height of small waves, relative to body and wave length
/// Relative difference to the volume of the database without a note
constexpr double same_volume = 0.01;

hull::Water water_of_hulls(const model::Scene& scene) {
  const model::Water water = model::water(scene);
  const std::string& name = scene.sea.stretching;
  const hull::Stretching stretching = name == "wheeler"        ? hull::Stretching::wheeler
                                      : name == "extrapolated" ? hull::Stretching::extrapolated
                                      : name == "none"         ? hull::Stretching::none
                                                               : hull::Stretching::vertical;
  return {water.density, water.gravity, water.depth, stretching, scene.sea.bernoulli};
}

std::vector<hull::Wave> waves_of_hulls(const Sea& sea) {
  std::vector<hull::Wave> out;
  for (const sea::Component& c : sea.all)
    if (c.amplitude != 0.0)
      out.push_back({c.omega, c.wavenumber, c.heading, c.amplitude, c.phase});
  return out;
}

/// Notes the displaced volume of the mesh in the reference pose, compared with the database.
void note_volume(const model::Scene& scene, const model::Body& body, system::System& s) {
  const hull::Floating f = hull::floating_in_reference_pose(*body.hull, body.center_of_gravity);
  std::string text = "body " + in_quotes(body.name) + ": the mesh displaces " +
                     rounded_text(f.volume, 5) + " m3 in the reference pose";
  const hydro::DatabaseBody* entry =
      body.hydro && scene.database ? hydro::find_body(*scene.database, *body.hydro) : nullptr;
  if (entry && entry->hydrostatics) {
    const double volume = entry->hydrostatics->displaced_volume;
    text += ", the body of the database " + rounded_text(volume, 5) + " m3";
    if (std::abs(f.volume - volume) > same_volume * volume)
      text = "looks wrong: " + text;
  }
  s.notes.push_back(text);
}

/// Complex amplitudes (6,) of the load on a mesh in waves of 1 m, phase zero at the centre of
/// gravity: differences of the nonlinear load at +-a, with an error of order a^2.
Vector6c linear_load(const hull::Mesh& mesh, const hull::Water& water, const hull::Pose& pose,
                     const sea::Component& c, double heading) {
  const double a = small_wave * std::min(mesh.radius, 1.0 / c.wavenumber);
  const auto load = [&](double amplitude, double phase) -> Vector6 {
    const hull::WaveField field(water, {{c.omega, c.wavenumber, heading, amplitude, phase}},
                                mesh.radius);
    hull::Workspace work(mesh, field);
    const hull::Loads l = hull::loads(mesh, field, pose, {}, work);
    return l.hydrostatic + l.dynamic;
  };
  const Vector6 real = (load(a, 0.0) - load(-a, 0.0)) / (2.0 * a);
  const Vector6 imaginary = -(load(a, 0.5 * pi) - load(-a, 0.5 * pi)) / (2.0 * a);
  return real.cast<std::complex<double>>() + std::complex<double>(0.0, 1.0) * imaginary;
}

} // namespace

Eigen::MatrixXcd mesh_coefficients(const model::Scene& scene, const hull::Mesh& mesh,
                                   const hull::Pose& body, const Meeting& meeting,
                                   const YawSamples& samples,
                                   const std::vector<sea::Component>& components) {
  const hull::Water water = water_of_hulls(scene);
  // Phases refer to the point where the body meets the waves: the pose is above the origin.
  const hull::Pose pose{{0.0, 0.0, body.position[2]}, body.rotation};
  Eigen::MatrixXcd out(6 * samples.transform.rows(), std::ssize(components));
  for (Index i = 0; i < out.cols(); ++i) {
    const sea::Component& c = components[static_cast<std::size_t>(i)];
    Eigen::MatrixXcd force(samples.yaws.size(), 6);
    for (Index k = 0; k < force.rows(); ++k)
      force.row(k) = linear_load(mesh, water, pose, c, c.heading - samples.yaws[k]).transpose();
    const double lag = c.wavenumber * (meeting.point[0] * std::cos(c.heading) +
                                       meeting.point[1] * std::sin(c.heading));
    force *= std::polar(c.amplitude, c.phase - lag);
    out.col(i) = (samples.transform * force).reshaped();
  }
  return out;
}

void add_hulls(const model::Scene& scene, const Sea& sea, bool with_waves, system::System& s) {
  const hull::Water water = water_of_hulls(scene);
  for (const bool in_waves : {false, true}) {
    std::shared_ptr<water::HullList> list;
    system::ElementList entry;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const model::Body& body = scene.bodies[i];
      if (!body.hull || body.waves_by_mesh() != in_waves)
        continue;
      if (!list)
        list = std::make_shared<water::HullList>(
            water, in_waves && with_waves ? waves_of_hulls(sea) : std::vector<hull::Wave>(),
            scene.sea.ramp);
      list->add(body.name, body.hull, body.center_of_gravity, s.bodies[i].n_active > 0);
      note_volume(scene, body, s);
      system::PortData port;
      port.component = list->type;
      port.body = static_cast<int>(i);
      entry.ports.push_back(port);
    }
    if (!list)
      continue;
    entry.laws = std::move(list);
    s.elements.push_back(std::move(entry));
  }
}

} // namespace hydrodae::build
