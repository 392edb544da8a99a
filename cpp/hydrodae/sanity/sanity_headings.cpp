/// Directions of the waves against the headings of the database.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/excitation_terms.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/frequency.h"
#include "hydrodae/model/waves.h"
#include "hydrodae/sanity/sanity.h"

namespace hydrodae::sanity {

namespace {

/// Doubtful part of the largest force over the headings: reported, and serious.
constexpr double doubt_worth_saying = 0.02, doubt_too_large = 0.2;
constexpr double force_unseen = 0.02; ///< noise, as part of the largest force of its unit
/// Heading steps above which tables without a check are reported [deg]
constexpr double headings_apart = 36.0;
/// Largest number of judged components of a sea, evenly chosen
constexpr std::size_t components_judged = 64;
/// Weight of other headings at a heading of the table
constexpr double off_the_table = 1e-6;

/// Mean squares over the components of a sea, by coordinate, with the doubtful part.
struct HeadingDoubt {
  VectorX size; ///< largest value over the headings
  MatrixX miss; ///< (n_left_out, n_labels)
};

/// Labels of the moving coordinates that are in the database.
std::vector<std::string> moving_labels(const model::Scene& scene, const system::System& s) {
  std::vector<std::string> out;
  for (const system::HydroData::Coordinate& c : s.hydro.coordinates)
    out.push_back(build::hydro_label(scene, s.hydro.bodies[static_cast<std::size_t>(c.hydro_body)],
                                     c.component));
  return out;
}

HeadingDoubt doubt_of(const hydro::Excitation& excitation,
                      const std::vector<sea::Component>& components) {
  const MatrixX& misses = excitation.headings().misses();
  HeadingDoubt out;
  const std::size_t stride = 1 + (components.size() - 1) / components_judged;
  for (std::size_t i = 0; i < components.size(); i += stride) {
    const sea::Component& c = components[i];
    const Eigen::MatrixXcd force = c.amplitude * excitation.smooth(c.omega);
    const VectorX size = force.cwiseAbs2().colwise().maxCoeff();
    MatrixX miss(misses.rows(), force.cols());
    if (misses.size() > 0)
      miss = (misses * force).cwiseAbs2();
    out.size = i == 0 ? size : VectorX(out.size + size);
    out.miss = i == 0 ? miss : MatrixX(out.miss + miss);
  }
  return out;
}

/// Coordinate with the most doubtful forces, and the doubtful part [-].
std::pair<int, double> most_doubtful(const hydro::Headings& headings, const HeadingDoubt& found,
                                     const std::vector<std::string>& labels) {
  const auto turns = [&](std::size_t k) {
    const std::string dof = labels[k].substr(labels[k].rfind('.') + 1);
    return dof == "roll" || dof == "pitch" || dof == "yaw";
  };
  double largest[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < labels.size(); ++k)
    largest[turns(k)] = std::max(largest[turns(k)], found.size[static_cast<Eigen::Index>(k)]);
  std::pair<int, double> out{-1, 0.0};
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const double size = found.size[column];
    if (!(size > force_unseen * force_unseen * largest[turns(k)]))
      continue;
    const double miss =
        found.miss.rows() ? std::sqrt(found.miss.col(column).maxCoeff() / size) : 0.0;
    const double share = headings.doubt(miss);
    if (share > out.second)
      out = {static_cast<int>(k), share};
  }
  return out;
}

} // namespace

std::vector<Finding> look_at_headings(const model::Scene& scene, const system::System& s) {
  std::vector<Finding> out;
  if (scene.waves.empty() || !scene.database || s.hydro.coordinates.empty() ||
      scene.database->heading.size() < 2)
    return out;
  std::string symmetry;
  const hydro::Database db = build::wave_tables(scene, s, symmetry);
  const std::vector<std::string> labels = moving_labels(scene, s);
  const hydro::Excitation excitation(db, db.excitation, labels);
  const hydro::Headings& headings = excitation.headings();
  const VectorX& table = headings.table();
  const double step =
      (table.tail(table.size() - 1) - table.head(table.size() - 1)).maxCoeff() * 180.0 / pi;
  for (const sea::Wave& wave : scene.waves) {
    const std::vector<sea::Component> components = model::wave_components(scene, wave, nullptr);
    const auto between = [&](const sea::Component& c) {
      return std::any_of(
          s.hydro.bodies.begin(), s.hydro.bodies.end(), [&](const system::HydroBody& hb) {
            const std::optional<double> heading = headings.covered(c.heading - hb.yaw);
            return build::follows_yaw(s, hb) ||
                   (hb.moves && heading &&
                    headings.weights(*heading).maxCoeff() < 1.0 - off_the_table);
          });
    };
    if (!std::any_of(components.begin(), components.end(), between))
      continue;
    const auto [label, share] = most_doubtful(headings, doubt_of(excitation, components), labels);
    const std::string text = "wave " + in_quotes(wave->name) +
                             " travels between the headings of the database, which are up to " +
                             rounded_text(step, 3) + " deg apart";
    if (share > doubt_worth_saying)
      out.push_back({share > doubt_too_large,
                     text + ": there forces may be off by " + rounded_text(100.0 * share, 2) +
                         " % of their largest (" + labels[static_cast<std::size_t>(label)] + ")"});
    else if (headings.misses().size() == 0 && step > headings_apart)
      out.push_back({false, text + ": too few to estimate how far off the forces there are"});
  }
  return out;
}

} // namespace hydrodae::sanity
