#include "hydrodae/water/radiation_constant.h"

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/hydro/frequency.h"

namespace hydrodae::water {

std::vector<std::string> ConstantRadiation::read(const RadiationSource& from, const Keys& keys,
                                                 AddedMass& added) {
  const hydro::Database& db = from.database;
  frequency = *keys.frequency;
  if (!hydro::covers_frequency(db, frequency))
    throw ModelError("hydro.frequency", "frequency = " + number_text(frequency) +
                                            " rad/s is outside the database, " +
                                            number_text(db.omega[0]) + " to " +
                                            number_text(db.omega[db.omega.size() - 1]) + " rad/s");
  const auto at = [&](const std::vector<MatrixX>& table) {
    return from.cut(db.coordinates, db.coordinates, hydro::at_frequency(db, table, frequency));
  };
  added.all = at(db.added_mass);
  damping_all = at(db.damping);
  damping = from.wet.moving_rows(damping_all);
  largest = VectorX::Zero(from.wet.n_moving);
  const std::vector<int> place = from.places(db.coordinates);
  for (Index u = 0; u < largest.size(); ++u)
    if (const int i = place[static_cast<std::size_t>(u)]; i >= 0)
      for (const MatrixX& B : db.damping)
        largest[u] = std::max(largest[u], std::abs(B(i, i)));
  return db.coordinates;
}

} // namespace hydrodae::water
