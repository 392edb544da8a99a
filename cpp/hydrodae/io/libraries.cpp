#include "hydrodae/io/libraries.h"

#include <dlfcn.h>

#include <cmath>
#include <filesystem>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/sha256.h"
#include "hydrodae/model/forces.h"

namespace hydrodae::io {

namespace {

constexpr int most_states = 64;

struct Offer {
  std::string library;
  const hydrodae_law* law;
};

/// Fault in a law as its library describes it; empty: none.
std::string fault(const hydrodae_law& law) {
  if (!law.name || !*law.name)
    return "has no name";
  if (!law.evaluate)
    return "has no function";
  if (law.n_parameters < 0 || (law.n_parameters > 0 && !law.parameters))
    return "does not name its parameters";
  if (law.n_states < 0 || law.n_states > most_states || (law.n_states > 0 && !law.states))
    return "does not describe its states (" + number_text(most_states) + " at most)";
  for (int k = 0; k < law.n_states; ++k) {
    const hydrodae_state& z = law.states[k];
    if (!z.name || !z.unit || !(z.scale > 0.0) || !std::isfinite(z.scale) ||
        !std::isfinite(z.start))
      return "has a state without name, unit, scale above 0 or start";
  }
  return "";
}

std::vector<Offer> open(const std::string& path) {
  const auto refuse = [&](const std::string& why) -> void {
    throw CaseError("library " + path + ": " + why);
  };
  if (!std::filesystem::exists(path))
    refuse("there is no such file");
  // A bare name would be looked up in the folders of the system.
  void* handle = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    refuse("cannot be loaded: " + std::string(dlerror()));
  using Get = const hydrodae_plugin* (*)();
  const auto get = reinterpret_cast<Get>(dlsym(handle, "hydrodae_get_plugin"));
  if (!get)
    refuse("has no hydrodae_get_plugin(): the macro HYDRODAE_PLUGIN of plugin.h makes it");
  const hydrodae_plugin* plugin = get();
  if (!plugin || plugin->version != HYDRODAE_PLUGIN_VERSION)
    refuse("is made for version " + number_text(plugin ? plugin->version : 0) +
           " of plugin.h; this is version " + number_text(HYDRODAE_PLUGIN_VERSION));
  std::vector<Offer> out;
  for (int k = 0; k < plugin->n_laws; ++k) {
    if (const std::string wrong = fault(plugin->laws[k]); !wrong.empty())
      refuse("its law number " + number_text(k + 1) + " " + wrong);
    out.push_back({path, &plugin->laws[k]});
  }
  return out;
}

void give(element::LibraryLaw& force, bool on_body, const std::vector<Offer>& offers,
          const model::Scene& scene) {
  const std::string key = "force." + force.name;
  const auto place = scene.places.find(key + ".law");
  const auto refuse = [&](const std::string& why) {
    throw CaseError(place == scene.places.end() ? FilePlace{} : place->second, key + ".law",
                    "force " + in_quotes(force.name) + ": " + why);
  };
  std::vector<std::string> names;
  force.found = nullptr;
  for (const Offer& offer : offers) {
    names.emplace_back(offer.law->name);
    if (offer.law->name != force.law)
      continue;
    if (force.found)
      refuse("two libraries have a law " + in_quotes(force.law));
    force.found = offer.law;
  }
  if (!force.found)
    refuse("no library has a law " + in_quotes(force.law) + suggestion(force.law, names));
  if ((force.found->on_body != 0) != on_body)
    refuse("the law " + in_quotes(force.law) +
           (on_body ? " acts along a joint: use type 'library_load'"
                    : " acts on a body: use type 'library_wrench'"));
  const auto n = static_cast<std::size_t>(force.found->n_parameters);
  if (force.parameters.size() == n)
    return;
  std::vector<std::string> wanted;
  for (std::size_t k = 0; k < n; ++k)
    wanted.emplace_back(force.found->parameters[k] ? force.found->parameters[k] : "?");
  refuse("the law " + in_quotes(force.law) + " takes " + number_text(n) + " parameters" +
         (n > 0 ? " (" + joined(wanted) + ")" : "") + ", the case gives " +
         number_text(force.parameters.size()));
}

} // namespace

void join_libraries(const std::vector<std::string>& paths, model::Scene& scene) {
  std::vector<Offer> offers;
  for (const std::string& path : paths) {
    for (const Offer& offer : open(path))
      offers.push_back(offer);
    scene.files.push_back(
        {"library", std::filesystem::path(path).filename().string(), path, sha256_of_file(path)});
  }
  if (offers.empty())
    return;
  model::for_each_force(scene, [&]<class Force>(Force& force) {
    if constexpr (std::is_base_of_v<element::LibraryLaw, Force>)
      give(force, Force::port == element::Port::on_body, offers, scene);
  });
}

} // namespace hydrodae::io
