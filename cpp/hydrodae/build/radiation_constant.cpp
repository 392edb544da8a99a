/// Radiation by added mass alone, or by added mass and damping at one frequency.

#include "hydrodae/build/radiation.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/hydro/frequency.h"

namespace hydrodae::build {

namespace {

/// A(w) or B(w) at the frequency of constant radiation.
MatrixX table_at(const model::Scene& scene, const std::vector<MatrixX>& table) {
  const hydro::Database& db = *scene.database;
  const double omega = *scene.hydro->frequency;
  if (!hydro::covers_frequency(db, omega))
    throw ModelError("hydro.frequency", "frequency = " + number_text(omega) +
                                            " rad/s is outside the database, " +
                                            number_text(db.omega[0]) + " to " +
                                            number_text(db.omega[db.omega.size() - 1]) + " rad/s");
  return hydro::at_frequency(db, table, omega);
}

} // namespace

std::vector<std::string> fill_no_radiation(const model::Scene& scene, system::System& s) {
  const hydro::Database& db = *scene.database;
  s.hydro.added_mass_all = cut(scene, s.hydro, db.coordinates, db.coordinates, db.added_mass_inf);
  return db.coordinates;
}

std::vector<std::string> fill_constant(const model::Scene& scene, system::System& s) {
  const hydro::Database& db = *scene.database;
  system::HydroData& h = s.hydro;
  const auto at = [&](const std::vector<MatrixX>& table) {
    return cut(scene, h, db.coordinates, db.coordinates, table_at(scene, table));
  };
  h.added_mass_all = at(db.added_mass);
  h.damped = true;
  h.damping_all = at(db.damping);
  h.damping = moving_rows(h, h.damping_all);
  return db.coordinates;
}

} // namespace hydrodae::build
