#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {

namespace {

[[noreturn]] void refuse(const PoseTable& table, const std::string& key, const std::string& what) {
  refuse(Entry{"pose_table", table.name}, key, what);
}

void check_values(const PoseTable& table) {
  const std::string key = table.turns() ? "values_deg" : "values";
  if (!(table.turns() ? table.values : table.values_deg).empty())
    refuse(table, table.turns() ? "values" : "values_deg",
           "the poses of a table over " + table.coordinate + " stand in '" + key + "'");
  const std::vector<double>& x = table.poses();
  if (x.size() < 2 || !std::is_sorted(x.begin(), x.end(), std::less_equal<>()))
    refuse(table, key, "'" + key + "' must be two or more ascending numbers");
  if (x.size() > PoseTable::most)
    refuse(table, key, "a table has at most " + std::to_string(PoseTable::most) + " poses");
  if (x.size() != table.databases.size())
    refuse(table, "databases",
           std::to_string(table.databases.size()) + " databases for " + std::to_string(x.size()) +
               " values; give one for each");
}

/// Refuses data of the main database that couple this body with others.
void check_alone(const Scene& scene, const PoseTable& table, const Body& body) {
  for (const Body& other : scene.bodies)
    if (&other != &body && other.hydro &&
        hydro::are_coupled(*scene.database, *body.hydro, *other.hydro))
      refuse(table, "body",
             "the database " + scene.database->path + " couples body " + in_quotes(body.name) +
                 " with body " + in_quotes(other.name) +
                 "; a pose table is for a body without such coupling: import the two into "
                 "separate databases, or leave the table out");
}

void check_database_at(const Scene& scene, const PoseTable& table, std::size_t k) {
  const hydro::Database &main = *scene.database, &own = *table.loaded[k];
  const auto same = [&](const char* what, double a, double b) {
    if (a != b && !(std::abs(a - b) <= 1e-6 * std::abs(b)))
      refuse(table, "databases",
             std::string(what) + " of " + own.path + " is " + number_text(a) + ", that of " +
                 main.path + " is " + number_text(b));
  };
  same("the density", own.rho, main.rho);
  same("the gravity", own.gravity, main.gravity);
  same("the water depth", own.water_depth, main.water_depth);
  try {
    Scene there = scene_at_pose(scene, table, k);
    for (Body& body : there.bodies)
      body.hydrostatics = "mesh"; // hydrostatics of the main database are used
    check_database(there);
  } catch (const ModelError& error) {
    refuse(table, "databases", error.what());
  }
}

} // namespace

int PoseTable::component() const {
  return static_cast<int>(std::find(coordinate_names.begin(), coordinate_names.end(), coordinate) -
                          coordinate_names.begin());
}

const PoseTable* pose_table(const Scene& scene, const std::string& body) {
  for (const PoseTable& table : scene.pose_tables)
    if (table.body == body)
      return &table;
  return nullptr;
}

Scene scene_at_rest(const Scene& scene, const PoseTable& table) {
  Scene out = scene;
  out.pose_tables.clear();
  for (Body& body : out.bodies)
    if (body.name != table.body)
      body.hydro.reset();
  return out;
}

Scene scene_at_pose(const Scene& scene, const PoseTable& table, std::size_t k) {
  Scene out = scene_at_rest(scene, table);
  out.database = table.loaded[k];
  if (!table.turns())
    for (Body& body : out.bodies)
      if (body.name == table.body)
        body.center_of_gravity[table.component()] += table.poses()[k];
  return out;
}

Scene scene_without_tables(const Scene& scene) {
  Scene out = scene;
  for (Body& body : out.bodies)
    if (pose_table(scene, body.name))
      body.hydro.reset();
  out.pose_tables.clear();
  return out;
}

void check_pose_table(const Scene& scene, const PoseTable& table) {
  check_values(table);
  const Body* body = find_named(scene.bodies, table.body);
  if (!scene.hydro || !body->hydro)
    refuse(table, "body",
           "body " + in_quotes(table.body) + " has no 'hydro', so that no database loads it");
  if (scene.hydro->reads().kernel)
    refuse(table, "databases",
           "radiation = \"convolution\" has no tables over poses; use \"exponential\", "
           "\"constant\" or \"none\"");
  if (table.blends_memory() && !scene.hydro->reads().fit)
    refuse(table, "memory",
           "memory = \"blended\" needs radiation = \"exponential\" in [hydro]; leave it out");
  if (!scene.database || table.loaded.empty())
    return;
  check_alone(scene, table, *body);
  for (std::size_t k = 0; k < table.loaded.size(); ++k)
    check_database_at(scene, table, k);
}

} // namespace hydrodae::model
