#include <Eigen/Eigenvalues>
#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/mass.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

[[noreturn]] void refuse(const Body& body, const std::string& key, const std::string& message) {
  refuse(Entry{"body", body.name}, key, message);
}

Vector3 principal_moments(const Matrix3& tensor) {
  return Eigen::SelfAdjointEigenSolver<Matrix3>(tensor).eigenvalues();
}

/// Checks the tensor of a body that turns freely or has all moments given: no principal moment is
/// negative, and I1 + I2 >= I3 (moments of a mass distribution). Zero moments are those of points
/// and rods; the start checks whether constraints hold such a direction.
void check_tensor(const Body& body, const Matrix3& tensor) {
  const Vector3 moments = principal_moments(tensor);
  const std::string text = "principal moments " + number_text(moments[0]) + ", " +
                           number_text(moments[1]) + ", " + number_text(moments[2]) + " kg m2";
  if (moments[0] < -1e-9 * moments[2])
    refuse(body, "inertia", "no mass distribution has this inertia: a moment is negative; " + text);
  if (moments[0] + moments[1] < moments[2] * (1.0 - 1e-6))
    refuse(body, "inertia",
           "no mass distribution has this inertia: the largest principal moment "
           "exceeds the sum of the other two; " +
               text);
}

void check_inertia(const Body& body, const std::array<bool, 6>& free) {
  static constexpr std::array<const char*, 3> symbols = {"Ixx", "Iyy", "Izz"};
  if (body.principal_axes && !body.products_of_inertia.isZero(0.0))
    refuse(body, "principal_axes_deg",
           "principal_axes_deg and products_of_inertia exclude each other: with principal axes, "
           "'inertia' holds the principal moments");
  const Matrix3 tensor = inertia_tensor(body);
  for (std::size_t i = 0; i < 3; ++i)
    if (const double moment = tensor.diagonal()[static_cast<Eigen::Index>(i)];
        free[3 + i] && (body.hydro ? !(moment > 0.0) : moment < 0.0))
      refuse(body, "inertia",
             std::string(symbols[i]) + (body.hydro ? " must be > 0" : " must be >= 0") +
                 " kg m2, because the body is free in " + std::string(coordinate_names[3 + i]));
  // Moments about locked axes may be left at zero.
  if ((free[3] && free[4] && free[5]) || principal_moments(tensor)[0] > 0.0)
    check_tensor(body, tensor);
}

/// Checks the initial velocity: zero along locked coordinates. A body with one free rotation turns
/// about that axis only.
void check_initial(const Body& body, const std::array<bool, 6>& free) {
  const bool turns = free[3] || free[4] || free[5];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const auto locked_in = [&](std::size_t k) {
      return " along " + std::string(coordinate_names[k]) + ", which is locked";
    };
    if (!free[i] && body.initial.velocity.value_or(Vector3::Zero())[c] != 0.0)
      refuse(body, "initial.velocity", "initial velocity" + locked_in(i));
    if (!free[3 + i] && body.initial.angular_velocity.value_or(Vector3::Zero())[c] != 0.0)
      refuse(body, "initial.angular_velocity", "initial angular velocity" + locked_in(3 + i));
    if (turns && !free[3 + i] && body.initial.rotation[c] != 0.0)
      refuse(body, "initial.rotation_deg",
             "initial rotation" + locked_in(3 + i) + " while another rotation is free");
  }
}

void check_volume(const Scene& scene, const Body& body) {
  if (body.center_of_buoyancy && body.volume == 0.0)
    refuse(body, "center_of_buoyancy", "a centre of buoyancy needs a 'volume'");
  if (body.volume == 0.0)
    return;
  if (water(scene).density <= 0.0)
    refuse(body, "volume",
           "buoyancy needs the density of the water: a database, or environment.water_density");
  if (const double z = body.center_of_buoyancy.value_or(body.center_of_gravity)[2];
      z > 0.0 && !body.is_point())
    refuse(body, body.center_of_buoyancy ? "center_of_buoyancy" : "volume",
           "a volume under water has its centre below z = 0, this one at " + number_text(z) + " m");
}

/// Checks the requirements of a mesh.
void check_mesh(const Scene& scene, const Body& body) {
  const bool statics = body.hydrostatics_by_mesh(), waves = body.waves_by_mesh();
  if (!body.mesh && !body.mesh_origin.isZero(0.0))
    refuse(body, "mesh_origin", "this is the place of a 'mesh': give that file, or leave this out");
  if (body.mesh && !statics)
    refuse(body, "mesh", "a mesh does nothing without hydrostatics = \"mesh\"");
  if (statics && !body.mesh)
    refuse(body, "hydrostatics", "hydrostatics = \"mesh\" needs 'mesh', the file of the surface");
  if (waves && !statics)
    refuse(body, "froude_krylov",
           "froude_krylov = \"mesh\" takes the whole pressure on the wetted surface, so it needs "
           "hydrostatics = \"mesh\" too");
  if (!statics)
    return;
  if (water(scene).density <= 0.0)
    refuse(body, "hydrostatics",
           "a mesh needs the density of the water: a database, or environment.water_density");
  if (scene.hydro && body.hydro && scene.hydro->axes_kind() == water::HydroAxes::body)
    refuse(body, "hydrostatics",
           "axes = \"body\" is for linear loads that turn with the body; with a mesh use axes = "
           "\"mean\" or \"yaw\"");
}

} // namespace

void check_body(const Scene& scene, const Body& body) {
  const std::array<bool, 6> free = free_coordinates(body);
  if (moves(body) && body.hydro && body.mass.word.empty() && !(body.mass.value > 0.0))
    refuse(body, "mass",
           "a body in the water that moves needs a mass > 0 kg, this one has " +
               number_text(body.mass.value) + " kg");
  check_inertia(body, free);
  check_initial(body, free);
  check_volume(scene, body);
  check_mesh(scene, body);
  if (body.hydro && !scene.hydro)
    refuse(body, "hydro", "key 'hydro' needs a table [hydro] with a database");
}

} // namespace hydrodae::model
