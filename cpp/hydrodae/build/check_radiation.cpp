#include "hydrodae/build/check_radiation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hydrodae/build/radiation_damping.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/mass.h"

namespace hydrodae::build {

namespace {

/// Allowed negative damping of one coordinate, as part of its own largest
constexpr double of_itself = 0.05;
/// Damping of a coordinate that counts as noise, as part of the largest
constexpr double negligible = 1e-4;

/// Root of mass plus added mass of each coordinate: damping over mass is a rate comparable between
/// bodies of all sizes.
VectorX mass_scale(const system::System& s) {
  const system::HydroData& h = s.hydro;
  VectorX scale(h.n_moving);
  for (int u = 0; u < h.n_moving; ++u) {
    const system::HydroData::Coordinate& k = h.coordinates[static_cast<std::size_t>(u)];
    const system::BodyData& b =
        s.bodies[static_cast<std::size_t>(h.bodies[static_cast<std::size_t>(k.hydro_body)].body)];
    const double mass = system::rigid_mass(b)(k.component, k.component);
    scale[u] = std::sqrt(std::max(mass + h.added_mass.moving(u, u), 1e-300));
  }
  return scale;
}

std::string coordinate_name(const system::System& s, Index u) {
  const system::HydroData::Coordinate& k = s.hydro.coordinates[static_cast<std::size_t>(u)];
  const system::HydroBody& body = s.hydro.bodies[static_cast<std::size_t>(k.hydro_body)];
  return s.bodies[static_cast<std::size_t>(body.body)].name + " in " +
         std::string(model::coordinate_names[static_cast<std::size_t>(k.component)]);
}

[[noreturn]] void refuse(const system::System& s, const std::string& what, Index u,
                         double frequency, double part) {
  char size[32], at[32];
  std::snprintf(size, sizeof size, "%.2g", 100.0 * part);
  std::snprintf(at, sizeof at, "%.3g", frequency);
  throw ModelError("hydro.database",
                   "the radiation would feed the motion of " + coordinate_name(s, u) + ": " + what +
                       " falls to -" + size + " % of its largest at " + at +
                       " rad/s, and damping must not be negative. Check signs, mesh and irregular "
                       "frequencies of the source, and make the database or its fit again; "
                       "solver.force (--force) runs it all the same");
}

/// Smallest eigenvalue, and the coordinate with the largest part in its vector.
std::pair<double, Index> lowest(const Damping& d, Index frequency) {
  Eigen::MatrixXcd lower = Eigen::MatrixXcd::Zero(d.size(), d.size());
  for (std::size_t k = 0; k < d.places.size(); ++k) {
    const auto at = static_cast<Index>(k);
    lower(d.places[k].row, d.places[k].column) = {
        d.real(frequency, at), d.imaginary.size() > 0 ? d.imaginary(frequency, at) : 0.0};
  }
  const auto [value, vector] = lowest_eigenpair(lower);
  Index u = 0;
  vector.cwiseAbs2().maxCoeff(&u);
  return {value, d.coordinates[static_cast<std::size_t>(u)]};
}

/// @param largest  damping over mass of each coordinate, largest over all frequencies
void judge(const system::System& s, const std::vector<Damping>& all, const VectorX& largest,
           const std::string& what, double allowed) {
  const double scale = largest.maxCoeff();
  if (!(scale > 0.0))
    return; // no radiation
  double at = 0.0, part = of_itself;
  Index which = -1;
  for (const Damping& d : all)
    for (Index k = 0; k < d.size(); ++k) {
      const Index u = d.coordinates[static_cast<std::size_t>(k)];
      Index i = 0;
      const double least = d.diagonal.col(k).minCoeff(&i);
      if (largest[u] > negligible * scale && -least > part * largest[u]) {
        part = -least / largest[u];
        at = d.frequency[static_cast<std::size_t>(i)];
        which = u;
      }
    }
  if (which >= 0)
    refuse(s, what, which, at, part);
  double least = -allowed * scale;
  for (const Damping& d : all) {
    const Definite definite(d.places.empty() ? 0 : d.size(), d.places);
    for (Index i = 0; i < d.real.rows(); ++i) {
      const double* imaginary = d.imaginary.size() > 0 ? d.imaginary.row(i).data() : nullptr;
      if (definite.test(d.real.row(i).data(), imaginary, -least))
        continue;
      const auto [value, u] = lowest(d, i);
      if (value < least) {
        least = value;
        at = d.frequency[static_cast<std::size_t>(i)];
        which = u;
      }
    }
  }
  if (which >= 0)
    refuse(s, what, which, at, -least / scale);
}

} // namespace

void check_radiation(const model::Scene& scene, const system::System& s) {
  const system::HydroData& h = s.hydro;
  if (scene.solver.force || !h.radiates())
    return;
  const VectorX mass = mass_scale(s);
  h.visit([&](const auto& rung) {
    const Judged judged = damping_of(rung, mass);
    VectorX most = VectorX::Zero(h.n_moving);
    if (judged.largest.size() > 0)
      most = judged.largest.cwiseQuotient(mass.cwiseAbs2());
    for (const Damping& d : judged.sets)
      for (Index k = 0; k < d.size(); ++k) {
        double& own_most = most[d.coordinates[static_cast<std::size_t>(k)]];
        own_most = std::max(own_most, d.diagonal.col(k).cwiseAbs().maxCoeff());
      }
    judge(s, judged.sets, most, judged.what, judged.allowed);
  });
}

} // namespace hydrodae::build
