#include "hydrodae/io/case_reader.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <type_traits>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/case_overrides.h"
#include "hydrodae/io/component_table.h"
#include "hydrodae/io/hydro_file.h"
#include "hydrodae/io/mesh_file.h"
#include "hydrodae/io/record_file.h"
#include "hydrodae/io/sha256.h"
#include "hydrodae/io/toml_table.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/joint_keys.h"
#include "hydrodae/model/mass.h"
#include "hydrodae/model/scene_tables.h"
#include "hydrodae/model/tables.h"

namespace hydrodae::io {
namespace {

toml::table parse_toml(const std::string& text, const std::string& name) {
  if (text.starts_with("\x89HDF")) // the signature of HDF5
    throw CaseError({name}, "",
                    "is an HDF5 file, as results and databases are; a case is a TOML file");
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw CaseError(place_of(error.source()), "", std::string(error.description()));
  }
}

/// Place where a table begins, or of its key if it has no header (made by an override).
FilePlace table_place(const toml::table& root, const std::string& name) {
  const auto found = root.find(name);
  const toml::source_region& source = found->second.source();
  return place_of(source.path ? source : found->first.source());
}

/// Table [name], if the case has it.
template <class T>
bool read_single(const toml::table& root, const std::string& name, Places& places, T& out) {
  const toml::node* node = root.get(name);
  if (!node)
    return false;
  if (!node->is_table())
    throw CaseError(table_place(root, name), name,
                    in_quotes(name) + " must be one table: write [" + name + "]");
  places[name] = table_place(root, name);
  const Table table{*node->as_table(), "[" + name + "]", name, places[name], name, ""};
  out = read_table<T>(table, places);
  return true;
}

/// Calls `read(table)` for each entry [[name]].
void for_each_entry(const toml::table& root, const std::string& name, Places& places,
                    const std::function<void(const Table&)>& read) {
  const toml::node* node = root.get(name);
  if (!node)
    return;
  if (!node->is_array_of_tables())
    throw CaseError(table_place(root, name), name,
                    in_quotes(name) + " must be a list of tables: write [[" + name + "]]");
  int count = 0;
  for (const toml::node& item : *node->as_array()) {
    ++count;
    const toml::table& entry = *item.as_table();
    const std::string number = "#" + std::to_string(count);
    const auto given = entry["name"].value<std::string>();
    const std::string path = name + "." + given.value_or(number);
    places[path] = place_of(item.source());
    read(Table{entry, "[[" + name + "]] " + (given ? in_quotes(*given) : number), path,
               places[path], name, entry["type"].value<std::string>().value_or("")});
  }
}

/// Word of the key `type` of an entry, one of `types`. Throws CaseError.
std::string type_of_entry(const Table& table, Places& places,
                          const std::vector<std::string>& types) {
  Key key{"type", "-", any_value, {types.begin(), types.end()}};
  const toml::node* node = find_key(table, key, places);
  if (!node)
    missing_key(table, "type", "-", "Kind of " + table.kind + ": " + joined(types));
  std::string type;
  read_value(*node, key, type);
  return type;
}

/// Reads an entry of a list of typed structs: calls `read(table, std::type_identity<T>{})` with the
/// one of its `type`. `for_each_type` calls with each of them.
template <class ForEach, class Read>
void read_typed(Table table, Places& places, const ForEach& for_each, const Read& read) {
  std::vector<std::string> types;
  for_each([&]<class T>(std::type_identity<T>) { types.emplace_back(T::type); });
  const std::string type = type_of_entry(table, places, types);
  table.other_types = [&] {
    std::vector<std::string> found;
    for_each([&]<class T>(std::type_identity<T>) {
      T value{};
      if (takes_all(valid_keys(target_of(value)), table.node))
        found.emplace_back(T::type);
    });
    return found;
  };
  for_each([&]<class T>(std::type_identity<T> of) {
    if (type == T::type)
      read(table, of);
  });
}

/// Refuses keys that a joint of this type does not have. A wrong type is refused later.
void check_joint_keys(const Table& entry, Places& places) {
  const joint::JointType* type = joint::find_joint_type(entry.type);
  if (!type)
    return;
  const model::JointKeys keys = model::joint_keys(*type);
  check_keys(entry, keys.own);
  if (const toml::node* initial = entry.node.get("initial"))
    check_keys(nested_table(entry, *initial, "initial", places), keys.initial);
}

/// Reads each table into its member of the scene.
struct TableReader {
  const toml::table& root;
  model::Scene& scene;

  template <class T> void operator()(const std::string& name, T model::Scene::* member) const {
    read_single(root, name, scene.places, scene.*member);
  }
  template <class T>
  void operator()(const std::string& name, std::optional<T> model::Scene::* member) const {
    T value;
    if (read_single(root, name, scene.places, value))
      scene.*member = value;
  }
  template <class T>
  void operator()(const std::string& name, std::vector<T> model::Scene::* member) const {
    for_each_entry(root, name, scene.places, [&](const Table& entry) {
      (scene.*member).push_back(read_table<T>(entry, scene.places));
    });
  }
  template <class S, class... T>
  void operator()(const std::string& name,
                  std::vector<OneOf<S, T...>> model::Scene::* member) const {
    const auto types = [](const auto& visit) { OneOf<S, T...>::for_each_type(visit); };
    for_each_entry(root, name, scene.places, [&](const Table& entry) {
      read_typed(entry, scene.places, types,
                 [&]<class Own>(const Table& own, std::type_identity<Own>) {
                   (scene.*member).emplace_back(read_table<Own>(own, scene.places));
                 });
    });
  }
  void operator()(const std::string& name, std::vector<model::Joint> model::Scene::* member) const {
    for_each_entry(root, name, scene.places, [&](const Table& entry) {
      check_joint_keys(entry, scene.places);
      (scene.*member).push_back(read_table<model::Joint>(entry, scene.places));
    });
  }
  void operator()(const std::string& name, Indirect<model::Forces> model::Scene::* member) const {
    const auto types = [](const auto& visit) { model::for_each_force_type(visit); };
    for_each_entry(root, name, scene.places, [&](const Table& entry) {
      read_typed(entry, scene.places, types,
                 [&]<class Force>(const Table& own, std::type_identity<Force>) {
                   std::get<std::vector<Force>>((scene.*member)->lists)
                       .push_back(read_table<Force>(own, scene.places));
                 });
    });
  }
};

/// Reads the existing tables.
model::Scene read_tables(const toml::table& root, const std::string& name) {
  model::Scene scene;
  const Table top{root, "the case", "", {name, 1, 1}, "", ""};
  std::vector<std::string> keys = model::table_names();
  keys.insert(keys.begin(), {"title", "missing"});
  check_keys(top, keys);
  const auto read_text = [&](const char* word, auto& out) {
    Key key{word, "-", any_value, {}};
    if (const toml::node* node = find_key(top, key, scene.places))
      read_value(*node, key, out);
  };
  read_text("title", scene.title);
  read_text("missing", scene.missing);
  model::for_each_table(TableReader{root, scene});
  return scene;
}

CaseError error_at(const model::Scene& scene, const std::string& key, const std::string& fault) {
  return {scene.places.at(key), key, fault};
}

/// Calls `read(path)` with the file that `key` names, relative to the case, and adds it to the
/// files of the scene. `what` says in messages where it is named. A `read` that knows the digest of
/// the file returns it.
template <class Read>
void read_file(model::Scene& scene, const std::string& directory, const std::string& key,
               const std::string& name, const std::string& what, const Read& read) {
  const std::string path = (std::filesystem::path(directory) / name).lexically_normal().string();
  try {
    if constexpr (std::is_void_v<decltype(read(path))>) {
      read(path);
      scene.files.push_back({key, name, path, sha256_of_file(path)});
    } else {
      scene.files.push_back({key, name, path, read(path)});
    }
  } catch (const Error& error) {
    throw error_at(scene, key, what + ": " + error.what());
  }
}

/// `path` is relative to the case; `key` is the one that has it.
std::shared_ptr<const hydro::Database>
read_database(model::Scene& scene, const std::string& directory, const std::string& path,
              const std::string& key, const std::string& what) {
  std::shared_ptr<const hydro::Database> out;
  // Waves need the tables, to check a fit; symmetry checks also use the damping.
  const bool waves = !scene.waves.empty();
  const model::RungReads radiation = scene.hydro->reads();
  const bool judged = waves && (scene.hydro->axes == "yaw" || radiation.fit);
  const HydroTables tables{waves, judged || radiation.tables, radiation.kernel,
                           waves && scene.second_order.has_value()};
  read_file(scene, directory, key, path, what, [&](const std::string& whole) {
    SharedHydroFile found = shared_hydro_file(whole, tables);
    out = std::move(found.database);
    return found.sha256;
  });
  return out;
}

void read_databases(model::Scene& scene, const std::string& directory) {
  if (!scene.hydro)
    return;
  scene.database = read_database(scene, directory, scene.hydro->database, "hydro.database",
                                 "key 'database' in [hydro]");
  for (model::PoseTable& table : scene.pose_tables)
    for (const std::string& path : table.databases)
      table.loaded.push_back(
          read_database(scene, directory, path, "pose_table." + table.name + ".databases",
                        "key 'databases' in [[pose_table]] " + in_quotes(table.name)));
}

/// Components of a wave that stand in a file of their own.
void read_components(model::Scene& scene, const std::string& directory, sea::ComponentFile& wave) {
  const std::string key = "wave." + wave.name + ".file";
  if (!wave.omega.empty() || !wave.amplitude.empty() || !wave.phase.empty() ||
      !wave.headings.empty())
    throw error_at(scene, key,
                   "wave " + in_quotes(wave.name) +
                       ": give either 'file', or 'omega', 'amplitude', 'phase', 'headings_deg'");
  read_file(scene, directory, key, *wave.file, "key 'file' in [[wave]] " + in_quotes(wave.name),
            [&](const std::string& path) { read_component_table(path, wave); });
}

/// Measured elevations and components that stand in files of their own.
void read_records(model::Scene& scene, const std::string& directory) {
  for (sea::Wave& any : scene.waves) {
    if (auto* listed = any.as<sea::ComponentFile>(); listed && listed->file)
      read_components(scene, directory, *listed);
    auto* wave = any.as<sea::Measured>();
    if (!wave || !wave->file)
      continue;
    const std::string key = "wave." + wave->name + ".file";
    if (!wave->time.empty() || !wave->elevation.empty())
      throw error_at(scene, key,
                     "wave " + in_quotes(wave->name) +
                         ": give either 'file', or 'time' and 'elevation'");
    read_file(scene, directory, key, *wave->file, "key 'file' in [[wave]] " + in_quotes(wave->name),
              [&](const std::string& path) { read_record(path, wave->time, wave->elevation); });
  }
}

/// Surfaces of bodies, about their centres of gravity.
void read_meshes(model::Scene& scene, const std::string& directory) {
  for (model::Body& body : scene.bodies) {
    if (!body.mesh)
      continue;
    read_file(scene, directory, "body." + body.name + ".mesh", *body.mesh,
              "key 'mesh' in [[body]] " + in_quotes(body.name), [&](const std::string& path) {
                const Surface surface = read_surface(path);
                body.hull = std::make_shared<hull::Mesh>(
                    hull::make_mesh(surface.vertices, surface.triangles,
                                    body.center_of_gravity - body.mesh_origin));
              });
  }
}

/// Resolves the paths of FMUs of controllers.
void find_fmus(model::Scene& scene, const std::string& directory) {
  for (model::Controller& any : scene.controllers) {
    auto* c = any.as<control::Fmu>();
    if (!c || c->file.empty())
      continue;
    read_file(scene, directory, "controller." + c->name + ".file", c->file,
              "key 'file' in [[controller]] " + in_quotes(c->name),
              [&](const std::string& path) { c->path = path; });
  }
}

model::Scene parse(const std::string& text, const std::string& directory,
                   const Overrides& overrides, const std::string& name, const std::string& path) {
  toml::table root = parse_toml(text, name);
  apply_overrides(root, overrides);
  model::Scene scene = read_tables(root, name);
  if (!root.contains("solver"))
    throw CaseError({name, 1, 1}, "solver", "missing table [solver]");
  scene.path = path;
  scene.text = text;
  for (const auto& [key, value] : overrides)
    scene.overrides.push_back(key + " = " + value);
  if (!overrides.empty())
    scene.text += "\n# values given on the command line:\n";
  for (const std::string& line : scene.overrides)
    scene.text += "# " + line + "\n";
  read_databases(scene, directory);
  read_records(scene, directory);
  read_meshes(scene, directory);
  find_fmus(scene, directory);
  try {
    model::fill_in_masses(scene);
    model::add_parts(scene);
    model::check(scene);
  } catch (const ModelError& error) {
    throw model::located(scene, error);
  }
  for (model::Constraint& constraint : scene.constraints) // after the check: a spline needs a table
    if (auto* driven = constraint.as<model::DrivenCoordinate>())
      driven->drive.prepare();
  return scene;
}

} // namespace

model::Scene read_case(const std::string& path, const Overrides& overrides) {
  std::error_code ignored; // the following call reports files that do not exist
  if (std::filesystem::is_directory(path, ignored))
    throw CaseError({path}, "", "is a folder; give the case file in it");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw CaseError({path}, "", std::string("cannot read the case file: ") + std::strerror(errno));
  std::ostringstream text;
  text << file.rdbuf();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return parse(text.str(), folder.string(), overrides, path, path);
}

model::Scene parse_case(const std::string& text, const std::string& directory,
                        const Overrides& overrides, const std::string& name) {
  return parse(text, directory, overrides, name, "");
}

void check_tables(const std::string& text) {
  const std::string name = "<case>";
  read_tables(parse_toml(text, name), name);
}

} // namespace hydrodae::io
