/// Wave excitation of all hydrodynamic bodies as functions of time, computed ahead of the run.

#include <algorithm>
#include <optional>

#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/waves.h"

namespace hydrodae::build {

namespace {

std::string degrees(double angle) { return number_text(angle * 180.0 / pi) + " deg"; }

std::vector<Meeting> meetings(const model::Scene& scene, const system::System& s) {
  std::vector<Meeting> out(s.hydro.bodies.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const system::HydroBody& hb = s.hydro.bodies[i];
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    out[i] = {hb.yaw, follows_yaw(s, hb), scene.sea.phase == "fixed" ? b.position : b.reference,
              b.reference};
  }
  return out;
}

/// Refuses components that the database does not cover.
void check_coverage(const hydro::Database& db, const sea::Wave& wave,
                    const std::vector<sea::Component>& components,
                    const std::vector<Meeting>& bodies) {
  const hydro::Headings headings(db.heading);
  const std::string head = "wave " + in_quotes(wave->name) + ": ", key = "wave." + wave->name;
  const bool regular = wave.as<sea::Regular>();
  const auto* irregular = wave.as<sea::Irregular>();
  for (const sea::Component& c : components) {
    if (!hydro::covers_frequency(db, c.omega))
      throw ModelError(key + (regular ? ".period" : ".frequency_range"),
                       head + "a component at " + number_text(c.omega) +
                           " rad/s is outside the database, " + number_text(db.omega[0]) + " to " +
                           number_text(db.omega[db.omega.size() - 1]) + " rad/s" +
                           (regular ? "" : "; set 'frequency_range'"));
    const auto covered = [&](const Meeting& m) {
      return headings.covered(c.heading - m.yaw).has_value();
    };
    if (std::all_of(bodies.begin(), bodies.end(), covered))
      continue;
    const double last = db.heading[db.heading.size() - 1];
    throw ModelError(key + (irregular && irregular->spreading ? ".spreading" : ".heading_deg"),
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

using Terms = water::Excitation::Terms;

/// Functions of time of all terms, their rows in the order of the list.
struct Functions {
  Eigen::MatrixXcd rows;
  VectorX whole; ///< root of sum |C|^2 of the coordinate that each row is a part of
  Index count = 0;

  /// Takes the rows of some terms of one body, `coefficients` those of all of its functions.
  void add(const Eigen::MatrixXcd& coefficients, Terms& terms) {
    terms.first = count;
    const Index functions = coefficients.rows() / 6;
    if (rows.rows() < count + terms.count() + 1) {
      rows.conservativeResize(2 * (count + terms.count()) + 1, coefficients.cols());
      whole.conservativeResize(rows.rows());
    }
    for (const water::Excitation::Term& term : terms.list) {
      rows.row(count) = coefficients.row(term.coordinate * functions + term.m);
      whole[count++] = coefficients.middleRows(term.coordinate * functions, functions).norm();
    }
  }
};

/// The load of the waves on one body.
struct BodyLoad {
  Eigen::MatrixXcd total, froude_krylov; ///< coefficients of the functions of yaw
};

std::vector<std::string> labels_of(const model::Scene& scene, const system::System& s) {
  std::vector<std::string> labels;
  for (const system::HydroBody& hb : s.hydro.bodies)
    for (std::string_view dof : model::coordinate_names)
      labels.push_back(*scene.bodies[static_cast<std::size_t>(hb.body)].hydro + "." +
                       std::string(dof));
  return labels;
}

/// The bodies with their terms, and the functions of time of these, the elevation last.
std::vector<water::Excitation::Body> wave_loads(const model::Scene& scene, const system::System& s,
                                                const hydro::Database& db,
                                                const std::vector<Meeting>& meetings,
                                                const std::vector<sea::Component>& all,
                                                Functions& functions) {
  const std::vector<std::string> labels = labels_of(scene, s);
  const hydro::Excitation excitation(db, db.excitation, labels);
  std::optional<hydro::Excitation> froude_krylov;
  if (!db.froude_krylov.empty())
    froude_krylov.emplace(db, db.froude_krylov, labels);
  std::vector<water::Excitation::Body> out;
  std::vector<BodyLoad> loads;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const system::HydroBody& hb = s.hydro.bodies[i];
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    const YawSamples samples = yaw_samples(excitation, 6 * i, meetings[i], all);
    water::Excitation::Body body{b.name, hb, b.reference, b.length_scale, samples.functions,
                                 {},     {}, {}};
    BodyLoad load;
    load.total = yaw_coefficients(excitation, 6 * i, meetings[i], samples, all);
    if (froude_krylov)
      load.froude_krylov = yaw_coefficients(*froude_krylov, 6 * i, meetings[i], samples, all);
    const model::Body& entry = scene.bodies[static_cast<std::size_t>(hb.body)];
    if (entry.froude_krylov == "mesh") { // that load is the mesh's: the diffraction is left
      load.total -= mesh_coefficients(scene, entry, meetings[i], samples, all);
      load.froude_krylov.setZero();
    }
    for (const water::Excitation::Term& term :
         terms_that_matter(load.total, samples.functions, b.length_scale))
      (hb.moving[static_cast<std::size_t>(term.coordinate)] >= 0 ? body.moving : body.still)
          .list.push_back(term);
    if (froude_krylov)
      body.froude_krylov.list =
          terms_that_matter(load.froude_krylov, samples.functions, b.length_scale);
    out.push_back(std::move(body));
    loads.push_back(std::move(load));
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    functions.add(loads[i].total, out[i].moving);
  for (std::size_t i = 0; i < out.size(); ++i) {
    functions.add(loads[i].total, out[i].still);
    if (froude_krylov)
      functions.add(loads[i].froude_krylov, out[i].froude_krylov);
  }
  functions.rows.conservativeResize(functions.count + 1, std::ssize(all));
  functions.whole.conservativeResize(functions.count + 1);
  functions.whole[functions.count] = 0.0; // the elevation is whole
  for (std::size_t i = 0; i < all.size(); ++i)
    functions.rows(functions.count, static_cast<Index>(i)) =
        std::polar(all[i].amplitude, all[i].phase);
  return out;
}

} // namespace

void add_sea(const model::Scene& scene, system::System& s) {
  if (scene.waves.empty() || !scene.database)
    return; // Morison elements feel the waves by themselves
  std::string symmetry;
  const hydro::Database db = wave_tables(scene, s, symmetry);
  const system::HydroData& h = s.hydro;
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
  if (!symmetry.empty())
    s.notes.push_back("axes = \"yaw\": headings that the database lacks follow from its symmetry "
                      "about " +
                      symmetry + "; with them there are " + degrees(db.heading[0]) + " to " +
                      degrees(db.heading[db.heading.size() - 1]));
  Functions functions;
  std::vector<water::Excitation::Body> loaded = wave_loads(scene, s, db, bodies, all, functions);
  auto list =
      std::make_shared<water::Excitation>(h.axes, std::move(loaded), !db.froude_krylov.empty());
  if (scene.sea.phase == "fixed") {
    VectorX omega(std::ssize(all));
    for (std::size_t i = 0; i < all.size(); ++i)
      omega[static_cast<Index>(i)] = all[i].omega;
    list->set(sea::Signals(std::move(omega), std::move(functions.rows), scene.solver.end_time,
                           scene.sea.ramp, functions.whole));
  } else {
    const auto moving = std::count_if(h.bodies.begin(), h.bodies.end(),
                                      [](const system::HydroBody& b) { return b.moves; });
    s.notes.push_back("the phase of the waves follows the bodies: every evaluation sums " +
                      std::to_string(all.size()) + " wave components for " +
                      std::to_string(moving) + (moving == 1 ? " body" : " bodies"));
    list->set(sea::DriftingSignals(std::move(all), std::move(functions.rows), scene.sea.ramp));
  }
  std::vector<system::PortData> ports(h.bodies.size());
  for (std::size_t i = 0; i < ports.size(); ++i) {
    ports[i].component = list->type;
    ports[i].body = h.bodies[i].body;
  }
  s.elements.push_back({std::move(list), std::move(ports), {}});
}

} // namespace hydrodae::build
