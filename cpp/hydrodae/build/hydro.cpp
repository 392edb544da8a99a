/// Hydrostatics, added mass and radiation memory of a scene, for the moving coordinates.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "hydrodae/build/check_radiation.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/hydro/frequency.h"
#include "hydrodae/math/bspline.h"
#include "hydrodae/math/definite.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/mass.h"

namespace hydrodae::build {

namespace {

/// Numbers the entries of U by coordinates of bodies.
void number_coordinates(const model::Scene& scene, system::System& s) {
  system::HydroData& h = s.hydro;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].hydro)
      continue;
    system::HydroBody hb;
    hb.body = static_cast<int>(i);
    hb.carrier = static_cast<int>(h.bodies.size());
    if (const auto& part = scene.bodies[i].part)
      for (std::size_t k = 0; k < h.bodies.size(); ++k)
        if (s.bodies[static_cast<std::size_t>(h.bodies[k].body)].name == part->body)
          hb.carrier = static_cast<int>(k);
    hb.moving.fill(-1);
    const std::array<bool, 6> moving = model::moving_axes(scene.bodies[i]);
    for (int c = 0; c < 6; ++c) {
      if (!moving[c])
        continue;
      hb.moving[c] = h.n_moving++;
      hb.moves = true;
      h.coordinates.push_back({static_cast<int>(h.bodies.size()), c});
    }
    h.bodies.push_back(hb);
  }
}

/// Returns whether the database of `scene` loads this body; otherwise its columns and rows are
/// zero.
bool is_wet(const model::Scene& scene, const system::HydroBody& hb) {
  return scene.bodies[static_cast<std::size_t>(hb.body)].hydro.has_value();
}

/// Index in `labels` of each coordinate of the bodies (6 n_bodies,); -1: missing.
std::vector<int> all_places(const model::Scene& scene, const system::HydroData& h,
                            const std::vector<std::string>& labels) {
  std::unordered_map<std::string_view, int> place;
  for (std::size_t k = 0; k < labels.size(); ++k)
    place.emplace(labels[k], static_cast<int>(k));
  std::vector<int> out;
  for (const system::HydroBody& hb : h.bodies)
    for (int c = 0; c < 6; ++c) {
      const auto found = is_wet(scene, hb) ? place.find(hydro_label(scene, hb, c)) : place.end();
      out.push_back(found == place.end() ? -1 : found->second);
    }
  return out;
}

/// Index in `labels` of each coordinate of U; -1: missing.
std::vector<int> places(const model::Scene& scene, const system::HydroData& h,
                        const std::vector<std::string>& labels) {
  const std::vector<int> all = all_places(scene, h, labels);
  std::vector<int> out;
  for (const system::HydroData::Coordinate& k : h.coordinates)
    out.push_back(all[static_cast<std::size_t>(6 * k.hydro_body + k.component)]);
  return out;
}

/// Matrix with rows for all six coordinates of all bodies (zero if missing in the source), and
/// columns for U.
MatrixX cut(const model::Scene& scene, const system::HydroData& h,
            const std::vector<std::string>& rows, const std::vector<std::string>& columns,
            const MatrixX& source) {
  const std::vector<int> row = all_places(scene, h, rows), column = places(scene, h, columns);
  MatrixX out = MatrixX::Zero(std::ssize(row), h.n_moving);
  for (Index u = 0; u < out.cols(); ++u)
    for (Index i = 0; i < out.rows(); ++i)
      if (const int r = row[static_cast<std::size_t>(i)], c = column[static_cast<std::size_t>(u)];
          r >= 0 && c >= 0)
        out(i, u) = source(r, c);
  return out;
}

/// Rows of `all` (6 per body) that belong to U.
MatrixX moving_rows(const system::HydroData& h, const MatrixX& all) {
  MatrixX out(h.n_moving, all.cols());
  for (int u = 0; u < h.n_moving; ++u)
    out.row(u) = all.row(6 * h.coordinates[u].hydro_body + h.coordinates[u].component);
  return out;
}

/// Notes loads on fixed coordinates that the fit omits.
void note_uncovered(const model::Scene& scene, const std::vector<std::string>& outputs,
                    system::System& s) {
  const std::vector<int> place = all_places(scene, s.hydro, outputs);
  for (std::size_t k = 0; k < place.size(); ++k)
    if (const system::HydroBody& hb = s.hydro.bodies[k / 6]; place[k] < 0 && is_wet(scene, hb))
      if (const std::string label = hydro_label(scene, hb, static_cast<int>(k % 6)); !label.empty())
        s.hydro.uncovered.push_back(label);
}

/// Adds the real form of the fit: a pole p = a + i b with Im > 0 becomes two states (Re z, Im z);
/// blocks without a drive are omitted.
void add_memory(const model::Scene& scene, const hydro::MemoryFit& fit, system::System& s) {
  system::HydroData& h = s.hydro;
  const std::vector<int> input = places(scene, h, fit.inputs);
  std::vector<int> column; // columns of `output_all`: block of the fit, twice for a pair
  for (int k = 0; k < fit.poles.size(); ++k) {
    const bool pair = fit.poles[k].imag() != 0.0;
    const int state = h.n_states;
    bool driven = false;
    for (int u = 0; u < h.n_moving; ++u) {
      if (input[static_cast<std::size_t>(u)] < 0)
        continue;
      const std::complex<double> b = fit.input_matrix(k, input[static_cast<std::size_t>(u)]);
      if (b.real() != 0.0)
        h.inputs.push_back({state, u, b.real()});
      if (pair && b.imag() != 0.0)
        h.inputs.push_back({state + 1, u, b.imag()});
      driven = driven || b != 0.0;
    }
    if (!driven)
      continue;
    h.blocks.push_back({state, fit.poles[k].real(), fit.poles[k].imag(), pair});
    h.n_states += pair ? 2 : 1;
    for (int n = 0; n < (pair ? 2 : 1); ++n)
      column.push_back(k);
  }
  const std::vector<int> row = all_places(scene, h, fit.outputs);
  h.output_all = MatrixX::Zero(std::ssize(row), h.n_states);
  for (const system::HydroData::Block& b : h.blocks) // Re(C z) = Re C Re z - Im C Im z
    for (Index r = 0; r < std::ssize(row); ++r) {
      if (row[static_cast<std::size_t>(r)] < 0)
        continue;
      const std::complex<double> C =
          fit.output_matrix(row[static_cast<std::size_t>(r)], column[b.state]);
      h.output_all(r, b.state) = C.real();
      if (b.pair)
        h.output_all(r, b.state + 1) = -C.imag();
    }
  h.output = moving_rows(h, h.output_all);
}

/// Damping of each coordinate of U on itself, largest over the table; zero if it is not used.
VectorX largest_damping(const model::Scene& scene, const system::HydroData& h) {
  VectorX out = VectorX::Zero(h.n_moving);
  const hydro::Database& db = *scene.database;
  const std::vector<int> place = places(scene, h, db.coordinates);
  for (int u = 0; u < h.n_moving; ++u) {
    const int i = place[static_cast<std::size_t>(u)];
    for (const MatrixX& B : db.damping)
      out[u] = i < 0 ? 0.0 : std::max(out[u], std::abs(B(i, i)));
  }
  return out;
}

/// Table A(w) or B(w) at the frequency of constant radiation.
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

int label_index(const std::vector<std::string>& labels, const std::string& label) {
  const auto found = std::find(labels.begin(), labels.end(), label);
  return found == labels.end() ? -1 : static_cast<int>(found - labels.begin());
}

std::string hydro_label(const model::Scene& scene, const system::HydroBody& hb, int c) {
  return model::hydro_label(scene, scene.bodies[hb.body], static_cast<std::size_t>(c));
}

/// Places in the lower triangle, by columns: of the same body, or coupled by added mass.
static std::vector<Definite::Place> coupled_places(const system::HydroData& h) {
  std::vector<Definite::Place> out;
  for (Index v = 0; v < h.n_moving; ++v)
    for (Index u = v; u < h.n_moving; ++u)
      if (h.added_mass(u, v) != 0.0 || h.added_mass(v, u) != 0.0 ||
          h.coordinates[static_cast<std::size_t>(u)].hydro_body ==
              h.coordinates[static_cast<std::size_t>(v)].hydro_body)
        out.push_back({u, v});
  return out;
}

// Refuses a mass matrix that is not positive definite. Units differ, so it is scaled to a unit
// diagonal.
void check_mass(const system::System& s) {
  const system::HydroData& h = s.hydro;
  const auto own = [&](Index u, Index v) { // mass of the bodies without the water
    const system::HydroData::Coordinate &a = h.coordinates[static_cast<std::size_t>(u)],
                                        &b = h.coordinates[static_cast<std::size_t>(v)];
    if (a.hydro_body != b.hydro_body)
      return 0.0;
    return system::rigid_mass(s.bodies[h.bodies[a.hydro_body].body])(a.component, b.component);
  };
  const auto mass = [&](Index u, Index v) {
    return own(u, v) + 0.5 * (h.added_mass(u, v) + h.added_mass(v, u));
  };
  VectorX size(h.n_moving); // mass^-1/2
  for (Index u = 0; u < h.n_moving; ++u) {
    const system::HydroData::Coordinate& c = h.coordinates[static_cast<std::size_t>(u)];
    const double both = mass(u, u);
    if (!(both > 0.0))
      throw ModelError(
          "hydro.database",
          "mass and added mass of body '" + s.bodies[h.bodies[c.hydro_body].body].name + "' in " +
              std::string(model::coordinate_names[static_cast<std::size_t>(c.component)]) +
              " are " + number_text(both) + " together, and must be positive");
    size[u] = 1.0 / std::sqrt(both);
  }
  const std::vector<Definite::Place> places = coupled_places(h);
  std::vector<double> scaled;
  for (const Definite::Place& at : places)
    scaled.push_back(size[at.row] * mass(at.row, at.column) * size[at.column]);
  if (!Definite(h.n_moving, places).test(scaled.data(), nullptr))
    throw ModelError("hydro.database", "mass and added mass of the moving coordinates are not "
                                       "positive definite together: a push somewhere moves the "
                                       "bodies towards the hand");
}

void add_radiation(const model::Scene& scene, system::System& s) {
  const hydro::Database& db = *scene.database;
  system::HydroData& h = s.hydro;
  if (const hydro::MemoryFit* fit = model::memory_fit(scene)) {
    h.added_mass_all = cut(scene, h, fit->outputs, fit->inputs, fit->added_mass_inf);
    add_memory(scene, *fit, s);
    note_uncovered(scene, fit->outputs, s);
  } else if (scene.hydro->radiation == "convolution") {
    const hydro::RadiationKernel& kernel = *db.kernel;
    h.added_mass_all = cut(scene, h, kernel.outputs, kernel.inputs, kernel.added_mass_inf);
    h.added_mass = moving_rows(h, h.added_mass_all);
    h.output = MatrixX::Zero(h.n_moving, 0);
    h.output_all = MatrixX::Zero(h.added_mass_all.rows(), 0);
    add_convolution(scene, kernel, s);
    note_uncovered(scene, kernel.outputs, s);
  } else {
    const bool constant = scene.hydro->radiation == "constant";
    h.added_mass_all = cut(scene, h, db.coordinates, db.coordinates,
                           constant ? table_at(scene, db.added_mass) : db.added_mass_inf);
    if (constant) {
      h.damped = true;
      h.damping_all = cut(scene, h, db.coordinates, db.coordinates, table_at(scene, db.damping));
      h.damping = moving_rows(h, h.damping_all);
    }
    h.output = MatrixX::Zero(h.n_moving, 0);
    h.output_all = MatrixX::Zero(h.added_mass_all.rows(), 0);
    note_uncovered(scene, db.coordinates, s);
  }
  h.added_mass = moving_rows(h, h.added_mass_all);
  h.link();
  check_radiation(scene, s, largest_damping(scene, h));
}

void add_hydro(const model::Scene& scene, system::System& s) {
  if (!scene.hydro || !scene.database)
    return;
  system::HydroData& h = s.hydro;
  h.axes = scene.hydro->axes == "body"   ? system::HydroAxes::body
           : scene.hydro->axes == "mean" ? system::HydroAxes::mean
                                         : system::HydroAxes::yaw;
  number_coordinates(scene, s);
  set_hydrostatics(scene, s);
  if (h.n_moving == 0) {
    h.link();
    return;
  }
  if (!scene.pose_tables.empty())
    return add_pose_tables(scene, s);
  add_radiation(scene, s);
  check_mass(s);
}

} // namespace hydrodae::build
