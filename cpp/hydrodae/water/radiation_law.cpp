#include "hydrodae/water/radiation_law.h"

#include <unordered_map>

namespace hydrodae::water {

std::vector<int> RadiationSource::all_places(const std::vector<std::string>& among) const {
  std::unordered_map<std::string_view, int> place;
  for (std::size_t k = 0; k < among.size(); ++k)
    place.emplace(among[k], static_cast<int>(k));
  std::vector<int> out;
  for (const std::string& label : labels) {
    const auto found = label.empty() ? place.end() : place.find(label);
    out.push_back(found == place.end() ? -1 : found->second);
  }
  return out;
}

std::vector<int> RadiationSource::places(const std::vector<std::string>& among) const {
  const std::vector<int> all = all_places(among);
  std::vector<int> out;
  for (const WetBodies::Coordinate& k : wet.coordinates)
    out.push_back(all[static_cast<std::size_t>(k.row())]);
  return out;
}

MatrixX RadiationSource::cut(const std::vector<std::string>& rows,
                             const std::vector<std::string>& columns, const MatrixX& source) const {
  const std::vector<int> row = all_places(rows), column = places(columns);
  MatrixX out = MatrixX::Zero(std::ssize(row), wet.n_moving);
  for (Index u = 0; u < out.cols(); ++u)
    for (Index i = 0; i < out.rows(); ++i)
      if (const int r = row[static_cast<std::size_t>(i)], c = column[static_cast<std::size_t>(u)];
          r >= 0 && c >= 0)
        out(i, u) = source(r, c);
  return out;
}

} // namespace hydrodae::water
