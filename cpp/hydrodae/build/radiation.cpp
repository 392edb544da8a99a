/// Radiation of a scene, by the rung that it names.

#include "hydrodae/build/radiation.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "hydrodae/build/check_radiation.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/model/deformation.h"

namespace hydrodae::build {

namespace {

/// Does the database of `scene` load this body? Else its columns and rows are zero.
bool is_wet(const model::Scene& scene, const system::HydroBody& hb) {
  return scene.bodies[static_cast<std::size_t>(hb.body)].hydro.has_value();
}

/// Damping of each coordinate of U on itself, the largest over the table; zero where it is not
/// read.
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

/// The function that fills in each rung, in the order of `radiation_rungs`.
constexpr std::array fills{fill_no_radiation, fill_constant, fill_exponential, fill_convolution};
static_assert(fills.size() == model::radiation_rungs.size());

} // namespace

int label_index(const std::vector<std::string>& labels, const std::string& label) {
  const auto found = std::find(labels.begin(), labels.end(), label);
  return found == labels.end() ? -1 : static_cast<int>(found - labels.begin());
}

std::string hydro_label(const model::Scene& scene, const system::HydroBody& hb, int c) {
  return model::hydro_label(scene, scene.bodies[hb.body], static_cast<std::size_t>(c));
}

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

std::vector<int> places(const model::Scene& scene, const system::HydroData& h,
                        const std::vector<std::string>& labels) {
  const std::vector<int> all = all_places(scene, h, labels);
  std::vector<int> out;
  for (const system::HydroData::Coordinate& k : h.coordinates)
    out.push_back(all[static_cast<std::size_t>(6 * k.hydro_body + k.component)]);
  return out;
}

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

MatrixX moving_rows(const system::HydroData& h, const MatrixX& all) {
  MatrixX out(h.n_moving, all.cols());
  for (int u = 0; u < h.n_moving; ++u)
    out.row(u) = all.row(6 * h.coordinates[u].hydro_body + h.coordinates[u].component);
  return out;
}

/// Labels of loads on coordinates that stay, where `outputs` do not have them.
static void note_uncovered(const model::Scene& scene, const std::vector<std::string>& outputs,
                           system::System& s) {
  const std::vector<int> place = all_places(scene, s.hydro, outputs);
  for (std::size_t k = 0; k < place.size(); ++k)
    if (const system::HydroBody& hb = s.hydro.bodies[k / 6]; place[k] < 0 && is_wet(scene, hb))
      if (const std::string label = hydro_label(scene, hb, static_cast<int>(k % 6)); !label.empty())
        s.hydro.uncovered.push_back(label);
}

void add_radiation(const model::Scene& scene, system::System& s) {
  system::HydroData& h = s.hydro;
  const auto rung = static_cast<std::size_t>(&scene.hydro->rung() - model::radiation_rungs.data());
  h.output_all = MatrixX::Zero(6 * std::ssize(h.bodies), 0);
  note_uncovered(scene, fills[rung](scene, s), s);
  h.added_mass = moving_rows(h, h.added_mass_all);
  h.output = moving_rows(h, h.output_all);
  h.link();
  check_radiation(scene, s, largest_damping(scene, h));
}

} // namespace hydrodae::build
