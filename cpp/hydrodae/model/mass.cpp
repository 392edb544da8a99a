#include "hydrodae/model/mass.h"

#include "hydrodae/core/text.h"
#include "hydrodae/hull/floating.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {

Matrix3 inertia_tensor(const Body& body) {
  if (body.principal_axes) {
    const Matrix3 R =
        rotation_matrix<double>(quaternion_from_rotation_vector(*body.principal_axes));
    const Matrix3 tensor = R * body.inertia.value.asDiagonal() * R.transpose();
    return 0.5 * (tensor + tensor.transpose());
  }
  const Vector3 &d = body.inertia.value, &o = body.products_of_inertia; // products Ixy, Iyz, Izx
  Matrix3 tensor;
  tensor << d[0], o[0], o[2], o[0], d[1], o[1], o[2], o[1], d[2];
  return tensor;
}

namespace {

/// Displaced volume in the reference pose [m3], from the source of the buoyancy; nothing if
/// unknown.
std::optional<double> displaced_volume(const Scene& scene, const Body& body) {
  if (body.hull && body.hydrostatics_by_mesh())
    return hull::floating_in_reference_pose(*body.hull, body.center_of_gravity).volume;
  const hydro::DatabaseBody* entry =
      body.hydro && scene.database ? hydro::find_body(*scene.database, *body.hydro) : nullptr;
  if (entry && entry->hydrostatics)
    return entry->hydrostatics->displaced_volume;
  if (body.volume > 0.0)
    return body.volume;
  return {};
}

/// Sets the mass m = rho V.
void fill_in_mass(const Scene& scene, Body& body) {
  if (body.mass.word.empty())
    return;
  const Entry entry{"body", body.name};
  if (body.hydro && !(scene.database && hydro::find_body(*scene.database, *body.hydro)))
    return; // the check of the scene refuses `hydro`
  const std::optional<double> volume = displaced_volume(scene, body);
  if (!volume)
    refuse(entry, "mass",
           body.hydro
               ? "mass = \"equilibrium\" needs a displaced volume, which the database lacks for " +
                     in_quotes(*body.hydro) + "; give the mass in kg, or a 'mesh'"
               : "mass = \"equilibrium\" needs what the body displaces: 'hydro', 'mesh' with "
                 "hydrostatics = \"mesh\", or 'volume'");
  const double density = water(scene).density;
  if (!(density > 0.0))
    refuse(entry, "mass",
           "mass = \"equilibrium\" needs the density of the water: a database, or "
           "environment.water_density");
  if (!(*volume > 0.0))
    refuse(entry, "mass",
           "mass = \"equilibrium\": the body displaces no water in the reference pose; give the "
           "mass in kg");
  body.mass.value = density * *volume;
}

void fill_in_inertia(Body& body) {
  const Entry entry{"body", body.name};
  if (body.radii_of_gyration) {
    if (!body.inertia.word.empty() || !body.inertia.value.isZero(0.0))
      refuse(entry, "radii_of_gyration", "give either 'inertia' or 'radii_of_gyration'");
    body.inertia = body.mass.value * body.radii_of_gyration->cwiseAbs2();
  }
  if (body.inertia.word.empty())
    return;
  if (!body.hull)
    refuse(entry, "inertia", "inertia = \"mesh\" needs 'mesh', the file of the surface");
  if (body.principal_axes || !body.products_of_inertia.isZero(0.0))
    refuse(entry, body.principal_axes ? "principal_axes_deg" : "products_of_inertia",
           "inertia = \"mesh\" has its own products of inertia; leave this out");
  // Inertia J = m / V (tr S - S), with S the integral of x x^T over the solid.
  const Matrix3& S = body.hull->spread;
  const Matrix3 J = body.mass.value / body.hull->volume * (S.trace() * Matrix3::Identity() - S);
  body.inertia.value = J.diagonal();
  body.products_of_inertia = {J(0, 1), J(1, 2), J(2, 0)};
}

} // namespace

void fill_in_masses(Scene& scene) {
  for (Body& body : scene.bodies) {
    fill_in_mass(scene, body);
    fill_in_inertia(body);
  }
}

} // namespace hydrodae::model
