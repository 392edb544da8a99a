#include "hydrodae/hydro/coverage.h"

#include <algorithm>

namespace hydrodae::hydro {
namespace {

std::vector<std::string> missing(const std::vector<std::string>& known,
                                 const std::vector<std::string>& labels) {
  std::vector<std::string> out;
  for (const std::string& label : labels)
    if (std::find(known.begin(), known.end(), label) == known.end())
      out.push_back(label);
  return out;
}

template <class T> const T* find_named(const std::vector<T>& items, std::string_view name) {
  for (const T& item : items)
    if (item.name == name)
      return &item;
  return nullptr;
}

} // namespace

const DatabaseBody* find_body(const Database& database, std::string_view name) {
  return find_named(database.bodies, name);
}

const MemoryFit* find_fit(const Database& database, std::string_view name) {
  return find_named(database.fits, name);
}

std::vector<std::string> missing_coordinates(const Database& database,
                                             const std::vector<std::string>& labels) {
  return missing(database.coordinates, labels);
}

std::vector<std::string> missing_inputs(const MemoryFit& fit,
                                        const std::vector<std::string>& labels) {
  return missing(fit.inputs, labels);
}

const MemoryFit* smallest_covering_fit(const Database& database,
                                       const std::vector<std::string>& labels) {
  const MemoryFit* best = nullptr;
  for (const MemoryFit& fit : database.fits) {
    if (!missing(fit.inputs, labels).empty())
      continue;
    const bool smaller =
        !best || fit.states < best->states || (fit.states == best->states && fit.name < best->name);
    if (smaller)
      best = &fit;
  }
  return best;
}

} // namespace hydrodae::hydro
