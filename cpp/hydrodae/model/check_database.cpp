#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

[[noreturn]] void refuse(const Body& body, const std::string& message) {
  throw ModelError("body." + body.name + ".hydro", "body " + in_quotes(body.name) + ": " + message);
}

std::string point_text(const Vector3& point, const char* separator) {
  return number_text(point[0]) + separator + number_text(point[1]) + separator +
         number_text(point[2]);
}

/// A, B, F and C_hs act at the centre of gravity, so the database must be about it.
void check_reference_point(const Body& body, const hydro::DatabaseBody& entry) {
  if ((entry.reference_point - body.center_of_gravity).cwiseAbs().maxCoeff() > 1e-6)
    refuse(body, "the database is about the point [" + point_text(entry.reference_point, ", ") +
                     "] m, but the center_of_gravity is [" +
                     point_text(body.center_of_gravity, ", ") +
                     "] m; make the database for it with: hydrodae hdb import ... --cog " +
                     entry.name + "=" + point_text(body.center_of_gravity, ","));
}

/// Refuses a stiffness that no still water has: it feels neither surge, sway nor yaw, and has a
/// potential. Buoyancy that turns with the body gives roll and pitch moments by yaw.
void check_still_water(const hydro::Database& database, const Body& body,
                       const hydro::Hydrostatics& h) {
  constexpr double noise = 1e-3; // noise of tables, as in the symmetry of headings (docs/axes.md)
  const Matrix6& K = h.stiffness;
  const double weight = database.rho * database.gravity, size = std::cbrt(h.displaced_volume),
               rise = std::max(std::abs(K(2, 2)), weight * size * size),
               tilt = std::max({std::abs(K(3, 3)), std::abs(K(4, 4)), rise * size * size});
  const auto within = [](int c) { return c >= 2 && c < 5; };
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      if (j == 5 && (i == 3 || i == 4))
        continue;
      const double wrong = within(i) && within(j) ? K(i, j) - K(j, i) : K(i, j);
      if (std::abs(wrong) > noise * std::sqrt((i < 3 ? rise : tilt) * (j < 3 ? rise : tilt)))
        refuse(body,
               "axes = \"yaw\" needs the stiffness of still water, symmetric and zero in surge, "
               "sway and yaw, and the hydrostatic stiffness of " +
                   in_quotes(*body.hydro) + " in " + database.path + " has " +
                   number_text(K(i, j)) + " in row " + std::string(coordinate_names[i]) +
                   ", column " + std::string(coordinate_names[j]) +
                   "; give the stiffness of a mooring as a force mooring_matrix");
    }
}

void check_wet_body(const hydro::Database& database, const Body& body, water::HydroAxes axes) {
  const hydro::DatabaseBody* entry = hydro::find_body(database, *body.hydro);
  if (!entry) {
    std::vector<std::string> names;
    for (const hydro::DatabaseBody& b : database.bodies)
      names.push_back(b.name);
    refuse(body, "hydro = " + in_quotes(*body.hydro) + " is no body of " + database.path +
                     suggestion(*body.hydro, names));
  }
  check_reference_point(body, *entry);
  if (moves(body) && !body.hydrostatics_by_mesh() && !entry->hydrostatics)
    refuse(body, database.path + " holds no hydrostatics of " + in_quotes(*body.hydro) +
                     ", and a body that moves needs them");
  if (axes == water::HydroAxes::yaw && !body.hydrostatics_by_mesh() && entry->hydrostatics)
    check_still_water(database, body, *entry->hydrostatics);
}

/// Part of int |K| of a coordinate on itself beyond `length` [-].
double part_beyond(const hydro::RadiationKernel& kernel, const std::string& label, double length) {
  const auto place = [&](const std::vector<std::string>& labels) {
    return std::find(labels.begin(), labels.end(), label) - labels.begin();
  };
  const auto row = place(kernel.outputs), column = place(kernel.inputs);
  double all = 0.0, beyond = 0.0;
  for (std::size_t k = 0; k < kernel.values.size(); ++k) {
    const double time = static_cast<double>(k) * kernel.step;
    const double size = std::abs(kernel.values[k](row, column)) * (k == 0 ? 0.5 : 1.0);
    all += size; // trapezoidal rule
    if (time >= length - 1e-9 * kernel.step)
      beyond += time > length + 1e-9 * kernel.step ? size : 0.5 * size;
  }
  return all > 0.0 ? beyond / all : 0.0;
}

/// Checks the length of the memory: a memory cut too short is that of another device.
void check_memory_length(const Scene& scene, double length) {
  constexpr double allowed = 0.1;
  const hydro::RadiationKernel& kernel = *scene.database->kernel;
  for (const std::string& label : moving_coordinates(scene)) {
    const double lost = part_beyond(kernel, label, length);
    if (lost > allowed && !scene.solver.force)
      throw ModelError("hydro.memory_length",
                       "memory_length = " + number_text(length) + " s cuts off " +
                           number_text(std::round(1000.0 * lost) / 10.0) + " % of the kernel of " +
                           label +
                           " (of int |K|), more than 10 %: the motion would be that of another "
                           "device; a longer one, or solver.force = true for comparisons");
  }
}

/// Checks that the kernel exists, covers the moving coordinates, and is as long as the case asks.
void check_kernel(const Scene& scene) {
  const HydroOptions& hydro = *scene.hydro;
  const hydro::Database& database = *scene.database;
  if (!hydro.reads().kernel)
    return;
  const std::string advice = "; make it with: hydrodae hdb kernel " + database.path + " " +
                             joined(moving_coordinates(scene), ",");
  if (!database.kernel)
    throw ModelError("hydro.database",
                     database.path + " holds no radiation kernel for the convolution" + advice);
  std::vector<std::string> missing;
  for (const std::string& label : moving_coordinates(scene)) {
    const std::vector<std::string>& inputs = database.kernel->inputs;
    if (std::find(inputs.begin(), inputs.end(), label) == inputs.end())
      missing.push_back(label);
  }
  if (!missing.empty())
    throw ModelError("hydro.database", "the radiation kernel of " + database.path +
                                           " lacks coordinates that move: " + joined(missing) +
                                           advice);
  const double least = 7.0 * database.kernel->step, most = database.kernel->length();
  const double length = hydro.memory_length.value_or(most);
  if (length > most * (1.0 + 1e-9) || length < least)
    throw ModelError("hydro.memory_length", "memory_length = " + number_text(length) +
                                                " s: the kernel of " + database.path + " allows " +
                                                number_text(least) + " to " + number_text(most) +
                                                " s");
  check_memory_length(scene, length);
}

/// A key that belongs to one rung stands beside no other; a key that its rung needs is there.
void check_rung(HydroOptions hydro) {
  water::for_each_rung([&]<class Rung>(std::type_identity<Rung>) {
    const std::string name = "radiation = " + in_quotes(std::string(Rung::type));
    const bool own = Rung::type == hydro.radiation;
    for (const AnyField& field : Rung::template keys<HydroOptions>()) {
      const std::string key(field.key);
      const bool given = std::visit(
          [](auto* value) {
            if constexpr (requires { value->has_value(); })
              return value->has_value();
            else
              return false;
          },
          field.in(&hydro));
      if (given && !own)
        throw ModelError("hydro." + key, "'" + key + "' belongs to " + name +
                                             "; the radiation is " + in_quotes(hydro.radiation));
      if (own && !given && key == Rung::needs)
        throw ModelError("hydro.radiation",
                         name + " needs the key '" + key + "' [" + std::string(field.unit) + "]");
    }
  });
}

} // namespace

void check_database(const Scene& scene) {
  const hydro::Database& database = *scene.database;
  const double gravity = scene.environment.gravity.value_or(database.gravity);
  if (std::abs(gravity - database.gravity) > 1e-6 * database.gravity)
    throw ModelError("environment.gravity", "gravity is " + number_text(gravity) +
                                                " m/s2, but the database " + database.path +
                                                " was made with " + number_text(database.gravity) +
                                                " m/s2");
  std::vector<std::string> used;
  for (const Body& body : scene.bodies) {
    if (!body.hydro || body.part)
      continue;
    check_wet_body(database, body, scene.hydro->axes_kind());
    if (std::find(used.begin(), used.end(), *body.hydro) != used.end())
      refuse(body, "hydro = " + in_quotes(*body.hydro) + " already belongs to another body");
    used.push_back(*body.hydro);
  }
  if (used.empty())
    throw ModelError("hydro", "[hydro] is given, but no [[body]] has the key 'hydro'");

  const std::vector<std::string> missing =
      hydro::missing_coordinates(database, moving_coordinates(scene));
  if (!missing.empty())
    throw ModelError("hydro.database",
                     database.path + " lacks coordinates that move: " + joined(missing));
  check_rung(*scene.hydro);
  check_kernel(scene);
  const hydro::MemoryFit* fit = memory_fit(scene);
  if (fit && !fit->passive && !scene.solver.force)
    throw ModelError(
        "hydro.database",
        database.path +
            ": the memory fit is not passive, so that the waves may feed the motion; fit it again "
            "with hydrodae hdb import --fit (solver.force, --force, runs it all the same)");
}

} // namespace hydrodae::model
