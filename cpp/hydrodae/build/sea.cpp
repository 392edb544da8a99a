/// Wave excitation of all hydrodynamic bodies as functions of time, computed ahead of the run.

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "hydrodae/build/bound_waves.h"
#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/waves.h"

namespace hydrodae::build {

namespace {

std::string degrees(double angle) { return number_text(angle * 180.0 / pi) + " deg"; }

/// Refuses components that the database does not cover.
void check_coverage(const hydro::Database& db, const sea::Wave& wave,
                    const std::vector<sea::Component>& components,
                    const std::vector<Meeting>& bodies) {
  const hydro::Headings headings(db.heading);
  const std::string head = "wave " + in_quotes(wave->name) + ": ", key = "wave." + wave->name;
  const bool regular = wave.as<sea::Regular>(), listed = wave.as<sea::ComponentFile>();
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
    throw ModelError(key + (irregular && irregular->spreading ? ".spreading"
                            : listed                          ? ""
                                                              : ".heading_deg"),
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

/// Wave load on one body, from one database.
struct BodyLoad {
  Eigen::MatrixXcd total, froude_krylov; ///< coefficients of the functions of yaw
};

/// Functions of time of all terms, their rows in the order of the list.
struct Functions {
  Eigen::MatrixXcd rows;
  VectorX whole; ///< root of sum |C|^2 of the coordinate that each row belongs to
  Index count = 0;

  /// Appends the rows of some terms of one body, from its loads by pose.
  void add(const std::vector<BodyLoad>& loads, Eigen::MatrixXcd BodyLoad::* part, Terms& terms) {
    terms.first = count;
    if (terms.list.empty())
      return;
    const Index functions = (loads[0].*part).rows() / 6;
    if (rows.rows() < count + terms.count() + 1) {
      rows.conservativeResize(2 * (count + terms.count()) + 1, (loads[0].*part).cols());
      whole.conservativeResize(rows.rows());
    }
    for (const water::Excitation::Term& term : terms.list) {
      const Eigen::MatrixXcd& coefficients = loads[static_cast<std::size_t>(term.pose)].*part;
      rows.row(count) = coefficients.row(term.coordinate * functions + term.m);
      whole[count++] = coefficients.middleRows(term.coordinate * functions, functions).norm();
    }
  }
};

/// Tables of one database as functions of frequency and heading.
struct Source {
  hydro::Database db;
  hydro::Excitation total;
  std::optional<hydro::Excitation> froude_krylov;

  Source(hydro::Database tables, const std::vector<std::string>& labels)
      : db(std::move(tables)), total(db, db.excitation, labels) {
    if (!db.froude_krylov.empty())
      froude_krylov.emplace(db, db.froude_krylov, labels);
  }
  Source(const Source&) = delete; // the tables are referred to
  Source& operator=(const Source&) = delete;
};

std::vector<std::string> labels_of(const model::Scene& scene, const system::System& s) {
  std::vector<std::string> labels;
  for (const system::HydroBody& hb : s.hydro.bodies)
    for (int c = 0; c < 6; ++c)
      labels.push_back(hydro_label(scene, hb, c));
  return labels;
}

/// Databases of the excitation: that of the scene, and those of each pose table.
struct Sources {
  std::unique_ptr<Source> main;
  /// Sources by pose; empty: the main one
  std::vector<std::vector<std::unique_ptr<Source>>> of_body;
  bool split = true; ///< true: all contain their Froude-Krylov part
  std::string symmetry;

  Sources(const model::Scene& scene, const system::System& s) : of_body(s.hydro.bodies.size()) {
    const std::vector<std::string> labels = labels_of(scene, s);
    const auto make = [&](const model::Scene& of) {
      auto source = std::make_unique<Source>(wave_tables(of, s, symmetry), labels);
      split = split && source->froude_krylov;
      return source;
    };
    main = make(scene);
    for (std::size_t i = 0; i < of_body.size(); ++i) {
      const std::string& name = s.bodies[static_cast<std::size_t>(s.hydro.bodies[i].body)].name;
      const model::PoseTable* table = model::pose_table(scene, name);
      for (std::size_t k = 0; table && k < table->loaded.size(); ++k) {
        of_body[i].push_back(make(model::scene_at_pose(scene, *table, k)));
        const VectorX &own = of_body[i].back()->db.heading, &first = of_body[i][0]->db.heading;
        if (own.size() != first.size() || !own.isApprox(first, 1e-9))
          throw ModelError("pose_table." + table->name + ".databases",
                           "the headings of " + table->loaded[k]->path + " are not those of " +
                               table->loaded[0]->path +
                               "; compute all poses for the same headings");
      }
    }
  }

  /// Sources of body i, one for each pose of its table.
  std::vector<const Source*> of(std::size_t i) const {
    std::vector<const Source*> out;
    for (const std::unique_ptr<Source>& source : of_body[i])
      out.push_back(source.get());
    return out.empty() ? std::vector<const Source*>{main.get()} : out;
  }
};

/// Pose of a body for the tables of pose k.
hull::Pose pose_of_table(const model::Scene& scene, const model::Body& body, int k) {
  hull::Pose out{body.center_of_gravity, Matrix3::Identity()};
  if (const model::PoseTable* table = model::pose_table(scene, body.name)) {
    const double value = table->poses()[static_cast<std::size_t>(k)];
    if (table->turns())
      out.rotation = rotation_about_axis<double>(table->component() - 3, value);
    else
      out.position[table->component()] += value;
  }
  return out;
}

/// Adds the load of one source on a body; its terms go to those of the body.
BodyLoad add_load(const model::Scene& scene, const Source& source, std::size_t i, int pose,
                  const Meeting& meeting, const YawSamples& samples,
                  const std::vector<sea::Component>& all, bool split,
                  water::Excitation::Body& body) {
  const model::Body& entry = scene.bodies[static_cast<std::size_t>(body.wet.body)];
  BodyLoad load{yaw_coefficients(source.total, 6 * i, meeting, samples, all), {}};
  if (split)
    load.froude_krylov = yaw_coefficients(*source.froude_krylov, 6 * i, meeting, samples, all);
  if (entry.waves_by_mesh()) { // the mesh has that load: the diffraction remains
    load.total -= mesh_coefficients(scene, *entry.hull, pose_of_table(scene, entry, pose), meeting,
                                    samples, all);
    load.froude_krylov.setZero();
  }
  const auto take = [&](const Eigen::MatrixXcd& coefficients, auto&& list_of) {
    for (water::Excitation::Term term :
         terms_that_matter(coefficients, samples.functions, body.length)) {
      term.pose = pose;
      list_of(term).push_back(term);
    }
  };
  take(load.total, [&](const water::Excitation::Term& term) -> auto& {
    return (body.wet.moving[static_cast<std::size_t>(term.coordinate)] >= 0 ? body.moving
                                                                            : body.still)
        .list;
  });
  if (split)
    take(load.froude_krylov, [&](const auto&) -> auto& { return body.froude_krylov.list; });
  return load;
}

/// Bodies with their terms, and the functions of time, the elevation last.
std::vector<water::Excitation::Body> wave_loads(const model::Scene& scene, const system::System& s,
                                                const Sources& sources,
                                                const std::vector<Meeting>& meetings,
                                                const std::vector<sea::Component>& all,
                                                Functions& functions) {
  std::vector<water::Excitation::Body> out;
  std::vector<std::vector<BodyLoad>> loads(meetings.size());
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const system::HydroBody& hb = s.hydro.bodies[i];
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    const std::vector<const Source*> own = sources.of(i);
    const YawSamples samples = yaw_samples(own[0]->total, 6 * i, meetings[i], all);
    const bool mode = static_cast<std::size_t>(hb.carrier) != i;
    out.push_back(
        {b.name, hb, b.reference, b.length_scale, mode, samples.functions, {}, {}, {}, {}});
    if (hb.table >= 0)
      out[i].poses = s.hydro.added_mass.tables[static_cast<std::size_t>(hb.table)].axis;
    for (std::size_t pose = 0; pose < own.size(); ++pose)
      loads[i].push_back(add_load(scene, *own[pose], i, static_cast<int>(pose), meetings[i],
                                  samples, all, sources.split, out[i]));
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    functions.add(loads[i], &BodyLoad::total, out[i].moving);
  for (std::size_t i = 0; i < out.size(); ++i) {
    functions.add(loads[i], &BodyLoad::total, out[i].still);
    functions.add(loads[i], &BodyLoad::froude_krylov, out[i].froude_krylov);
  }
  functions.rows.conservativeResize(functions.count + 1, std::ssize(all));
  functions.whole.conservativeResize(functions.count + 1);
  functions.whole[functions.count] = 0.0; // the elevation has no parts
  for (std::size_t i = 0; i < all.size(); ++i)
    functions.rows(functions.count, static_cast<Index>(i)) =
        std::polar(all[i].amplitude, all[i].phase);
  return out;
}

} // namespace

std::vector<Meeting> meetings(const model::Scene& scene, const system::System& s) {
  std::vector<Meeting> out(s.hydro.bodies.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const system::HydroBody& hb =
        s.hydro.bodies[static_cast<std::size_t>(s.hydro.bodies[i].carrier)];
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    out[i] = {hb.yaw, follows_yaw(s, hb), scene.sea.phase == "fixed" ? b.position : b.reference,
              b.reference};
  }
  return out;
}

Sea draw_sea(const model::Scene& scene) {
  Sea out;
  for (const sea::Wave& wave : scene.waves) {
    Sea::System& drawn = out.systems.emplace_back();
    drawn.components = model::wave_components(scene, wave, &drawn.note);
    out.all.insert(out.all.end(), drawn.components.begin(), drawn.components.end());
  }
  out.field = sea::WaveField(out.all, model::water(scene).depth, scene.sea.ramp, scene.sea.current);
  out.field.profile = sea::layers(scene.sea.current_profile);
  if (scene.sea.order == 2)
    add_bound_waves(scene, out);
  return out;
}

void add_sea(const model::Scene& scene, const Sea& sea, system::System& s) {
  if (scene.waves.empty() || !scene.database)
    return; // Morison elements read the waves themselves
  const Sources sources(scene, s);
  const hydro::Database& db = sources.main->db;
  const system::HydroData& h = s.hydro;
  const std::vector<Meeting> bodies = meetings(scene, s);
  const std::vector<sea::Component>& all = sea.all;
  for (std::size_t k = 0; k < sea.systems.size(); ++k) {
    const Sea::System& drawn = sea.systems[k];
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (const Source* source : sources.of(i))
        check_coverage(source->db, scene.waves[k], drawn.components, {bodies[i]});
    if (!drawn.note.empty())
      s.notes.push_back(drawn.note);
  }
  if (!sources.symmetry.empty())
    s.notes.push_back("axes = \"yaw\": headings that the database lacks follow from its symmetry "
                      "about " +
                      sources.symmetry + "; with them there are " + degrees(db.heading[0]) +
                      " to " + degrees(db.heading[db.heading.size() - 1]));
  Functions functions;
  std::vector<water::Excitation::Body> loaded =
      wave_loads(scene, s, sources, bodies, all, functions);
  auto list = std::make_shared<water::Excitation>(h.axes, std::move(loaded), sources.split);
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
    list->set(sea::DriftingSignals(all, std::move(functions.rows), scene.sea.ramp));
  }
  std::vector<system::PortData> ports(h.bodies.size());
  for (std::size_t i = 0; i < ports.size(); ++i) {
    ports[i].component = list->type;
    ports[i].body = h.bodies[i].body;
    if (static_cast<std::size_t>(h.bodies[i].carrier) != i)
      ports[i].carrier = h.bodies[static_cast<std::size_t>(h.bodies[i].carrier)].body;
  }
  s.elements.push_back({std::move(list), std::move(ports), {}});
}

} // namespace hydrodae::build
