#include "hydrodae/model/check.h"

#include <algorithm>
#include <string_view>

#include "hydrodae/core/text.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

constexpr std::string_view ground = "ground";

/// Names become parts of key paths, of channel paths and of coordinate labels.
void check_name(const std::string& name, const std::string& kind) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    throw ModelError(kind + "." + name + ".name",
                     kind + " name " + in_quotes(name) + " may hold letters, digits, _ and - only");
}

void check_names(const std::vector<std::string>& names, const std::string& kind) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    check_name(names[i], kind);
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(names.begin(), here, names[i]) != here)
      throw ModelError(kind + "." + names[i] + ".name",
                       "two " + kind + " entries have the name " + in_quotes(names[i]));
  }
}

template <class T> void append_names(const std::vector<T>& items, std::vector<std::string>& names) {
  for (const T& item : items)
    names.push_back(item.name);
}

template <class T> std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  append_names(items, names);
  return names;
}

void check_reference(const std::string& name, const std::vector<std::string>& names,
                     const std::string& owner_kind, const std::string& owner,
                     const std::string& key, const std::string& kind) {
  if (std::find(names.begin(), names.end(), name) != names.end())
    return;
  throw ModelError(owner_kind + "." + owner + "." + key,
                   owner_kind + " " + in_quotes(owner) + ": " + key + " = " + in_quotes(name) +
                       " is no " + kind + suggestion(name, names));
}

/// What a force refers to is read off its members: `body` names a body, `joint` a joint.
template <class Force> void check_force(const Scene& scene, const Force& force) {
  if constexpr (requires { force.body; })
    check_reference(force.body, names_of(scene.bodies), "force", force.name, "body", "body");
  if constexpr (requires { force.joint; }) {
    check_reference(force.joint, names_of(scene.joints), "force", force.name, "joint", "joint");
    for (const Joint& joint : scene.joints) {
      if (joint.name != force.joint)
        continue;
      const std::size_t n = joint::find_joint_type(joint.type)->motions.size();
      if (n != 1)
        throw ModelError("force." + force.name + ".joint",
                         "force " + in_quotes(force.name) + ": a " + joint.type + " joint has " +
                             (n == 0 ? "no motion" : "more than one motion") +
                             " of its own to act along; use a joint that turns or slides");
    }
  }
}

} // namespace

void check(const Scene& scene) {
  if (scene.bodies.empty())
    throw ModelError("body", "the case has no [[body]]");
  check_names(names_of(scene.bodies), "body");
  check_names(names_of(scene.joints), "joint");
  std::vector<std::string> forces;
  std::apply([&](const auto&... list) { (append_names(list, forces), ...); }, scene.forces);
  check_names(forces, "force");

  for (const Body& body : scene.bodies) {
    if (body.name == ground)
      throw ModelError("body.ground.name", "'ground' is the name of the fixed world");
    check_body(scene, body);
  }
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), moves))
    throw ModelError("body", "every body is fixed: nothing can move");
  for (const Joint& joint : scene.joints)
    check_joint(scene, joint);
  const auto check_all = [&](const auto& list) {
    for (const auto& force : list)
      check_force(scene, force);
  };
  std::apply([&](const auto&... list) { (check_all(list), ...); }, scene.forces);
  if (scene.hydro && scene.database)
    check_database(scene);
}

} // namespace hydrodae::model
