/// Wave excitation of all hydrodynamic bodies as functions of time, computed ahead of the run.

#include <algorithm>
#include <optional>

#include "hydrodae/core/text.h"
#include "hydrodae/element/excitation.h"
#include "hydrodae/hydro/frequency.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/waves.h"
#include "hydrodae/system/build_parts.h"

namespace hydrodae::system {

namespace {

std::string degrees(double angle) { return number_text(angle * 180.0 / pi) + " deg"; }

/// How a body meets the waves: turned by its mean yaw, where it is at the start (or, when the phase
/// moves with it, where it is in the reference pose).
struct Meeting {
  double yaw = 0.0;                                                  ///< [rad]
  Vector3 point = Vector3::Zero(), database_point = Vector3::Zero(); ///< phases are about these [m]
};

std::vector<Meeting> meetings(const model::Scene& scene, const System& s) {
  std::vector<Meeting> out(s.hydro.bodies.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const HydroBody& hb = s.hydro.bodies[i];
    const BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    out[i] = {hb.yaw, scene.sea.phase == "fixed" ? b.position : b.reference, b.reference};
  }
  return out;
}

/// Load on all coordinates of all bodies per metre of amplitude, phase zero at the origin.
Eigen::VectorXcd meet(const hydro::Excitation& excitation, const std::vector<Meeting>& bodies,
                      const sea::Component& c) {
  const bool turned = std::any_of(bodies.begin(), bodies.end(), [](const Meeting& m) {
    return m.yaw != 0.0 || m.point != m.database_point;
  });
  const auto at = [&](double omega, double heading) {
    return excitation(omega, *excitation.headings().covered(heading));
  };
  Eigen::VectorXcd force = at(c.omega, c.heading - bodies.front().yaw);
  if (!turned)
    return force;
  const auto ahead = [](double heading) {
    return Vector3(std::cos(heading), std::sin(heading), 0.0);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Meeting& m = bodies[i];
    const double heading = c.heading - m.yaw;
    const double lag =
        c.wavenumber * (m.point.dot(ahead(c.heading)) - m.database_point.dot(ahead(heading)));
    const auto row = 6 * static_cast<Eigen::Index>(i);
    force.segment<6>(row) = std::polar(1.0, -lag) * at(c.omega, heading).segment<6>(row);
  }
  return force;
}

/// Refuses components that the database does not cover.
void check_coverage(const hydro::Database& db, const sea::Wave& wave,
                    const std::vector<sea::Component>& components,
                    const std::vector<Meeting>& bodies) {
  const hydro::Headings headings(db.heading);
  const std::string head = "wave " + in_quotes(wave.name) + ": ", key = "wave." + wave.name;
  for (const sea::Component& c : components) {
    if (!hydro::covers_frequency(db, c.omega))
      throw ModelError(key + (wave.type == "regular" ? ".period" : ".frequency_range"),
                       head + "a component at " + number_text(c.omega) +
                           " rad/s is outside the database, " + number_text(db.omega[0]) + " to " +
                           number_text(db.omega[db.omega.size() - 1]) + " rad/s" +
                           (wave.type == "regular" ? "" : "; set 'frequency_range'"));
    const auto covered = [&](const Meeting& m) {
      return headings.covered(c.heading - m.yaw).has_value();
    };
    if (std::all_of(bodies.begin(), bodies.end(), covered))
      continue;
    const double last = db.heading[db.heading.size() - 1];
    throw ModelError(key + (wave.spreading ? ".spreading" : ".heading_deg"),
                     head + "a component travels towards " + degrees(c.heading) +
                         (std::any_of(bodies.begin(), bodies.end(),
                                      [](const Meeting& m) { return m.yaw != 0.0; })
                              ? " less the yaw of the bodies"
                              : "") +
                         ", outside the headings of the database, " +
                         (db.heading.size() > 1 ? degrees(db.heading[0]) + " to " + degrees(last)
                                                : "which is " + degrees(last) + " alone"));
  }
}

std::shared_ptr<element::Excitation> excitation_list(const System& s, bool split) {
  std::vector<element::Excitation::Body> bodies;
  for (const HydroBody& hb : s.hydro.bodies) {
    const BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    bodies.push_back({b.name, hb, b.reference, b.length_scale});
  }
  return std::make_shared<element::Excitation>(s.hydro.axes, std::move(bodies), s.hydro.n_moving,
                                               split);
}

} // namespace

void add_sea(const model::Scene& scene, System& s) {
  if (scene.waves.empty() || !scene.database)
    return; // Morison elements feel the waves by themselves
  const hydro::Database& db = *scene.database;
  const HydroData& h = s.hydro;
  const std::vector<Meeting> bodies = meetings(scene, s);
  std::vector<sea::Component> all;
  for (const sea::Wave& wave : scene.waves) {
    std::string note;
    const std::vector<sea::Component> own = model::wave_components(scene, wave, &note);
    check_coverage(db, wave, own, bodies);
    all.insert(all.end(), own.begin(), own.end());
    if (!note.empty())
      s.notes.push_back(note);
  }
  std::vector<std::string> labels;
  for (const HydroBody& hb : h.bodies)
    for (std::string_view dof : model::coordinate_names)
      labels.push_back(*scene.bodies[hb.body].hydro + "." + std::string(dof));
  const bool split = !db.froude_krylov.empty();
  const hydro::Excitation excitation(db, db.excitation, labels);
  std::optional<hydro::Excitation> froude_krylov;
  if (split)
    froude_krylov.emplace(db, db.froude_krylov, labels);
  const auto n = static_cast<Eigen::Index>(all.size());
  const auto rows = static_cast<Eigen::Index>(labels.size());
  const Eigen::Index last = h.n_moving + rows * (split ? 2 : 1);
  VectorX omega(n);
  Eigen::MatrixXcd coefficients(last + 1, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const sea::Component& c = all[static_cast<std::size_t>(i)];
    const std::complex<double> elevation = std::polar(c.amplitude, c.phase);
    omega[i] = c.omega;
    const Eigen::VectorXcd force = elevation * meet(excitation, bodies, c);
    for (int u = 0; u < h.n_moving; ++u)
      coefficients(u, i) = force[6 * h.coordinates[u].hydro_body + h.coordinates[u].component];
    coefficients.col(i).segment(h.n_moving, rows) = force;
    if (split)
      coefficients.col(i).segment(h.n_moving + rows, rows) =
          elevation * meet(*froude_krylov, bodies, c);
    coefficients(last, i) = elevation;
  }
  auto list = excitation_list(s, split);
  if (scene.sea.phase == "fixed") {
    list->set(sea::Signals(omega, coefficients, scene.solver.end_time, scene.sea.ramp));
  } else {
    const auto moving =
        std::count_if(h.bodies.begin(), h.bodies.end(), [](const HydroBody& b) { return b.moves; });
    s.notes.push_back("the phase of the waves follows the bodies: every evaluation sums " +
                      std::to_string(all.size()) + " wave components for " +
                      std::to_string(moving) + (moving == 1 ? " body" : " bodies"));
    list->set(sea::DriftingSignals(std::move(all), std::move(coefficients), scene.sea.ramp));
  }
  std::vector<PortData> ports(h.bodies.size());
  for (std::size_t i = 0; i < ports.size(); ++i) {
    ports[i].component = list->type;
    ports[i].body = h.bodies[i].body;
  }
  s.elements.push_back({std::move(list), std::move(ports), {}});
}

} // namespace hydrodae::system
