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

bool are_coupled(const Database& database, const std::string& body, const std::string& other) {
  const auto coupled = [&](const std::vector<std::string>& rows,
                           const std::vector<std::string>& columns, const auto& is_zero) {
    const auto of = [](const std::string& label, const std::string& name) {
      return label.substr(0, label.rfind('.')) == name;
    };
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const bool pair = (of(rows[i], body) && of(columns[j], other)) ||
                          (of(rows[i], other) && of(columns[j], body));
        if (pair && !is_zero(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)))
          return true;
      }
    return false;
  };
  const auto& labels = database.coordinates;
  if (coupled(labels, labels, [&](auto i, auto j) {
        return database.added_mass_inf(i, j) == 0.0 &&
               std::all_of(database.damping.begin(), database.damping.end(),
                           [&](const MatrixX& B) { return B(i, j) == 0.0; });
      }))
    return true;
  return std::any_of(database.fits.begin(), database.fits.end(), [&](const MemoryFit& fit) {
    return coupled(fit.outputs, fit.inputs, [&](auto i, auto j) {
      return (fit.output_matrix.row(i).transpose().array() * fit.input_matrix.col(j).array())
          .isZero(0.0);
    });
  });
}

} // namespace hydrodae::hydro
