#include "hydrodae/system/hydro_data.h"

#include <algorithm>
#include <tuple>

namespace hydrodae::system {

void HydroData::link() {
  std::vector<BlockMatrix::Entry> entries;
  for (const Input& in : inputs)
    entries.push_back({in.state, in.coordinate, in.value});
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return std::tie(a.column, a.row) < std::tie(b.column, b.row);
  });
  products = {BlockMatrix(added_mass), BlockMatrix(added_mass_all), BlockMatrix(output),
              BlockMatrix(output_all), BlockMatrix(damping),        BlockMatrix(damping_all),
              BlockMatrix(entries)};

  const std::size_t n = bodies.size();
  links.assign(n, {});
  const auto body_of = [&](Index u) {
    return static_cast<std::size_t>(coordinates[static_cast<std::size_t>(u)].hydro_body);
  };
  std::vector<bool> coupled(n * n);
  const auto couple = [&](Index row, Index column, double = 0.0) {
    coupled[body_of(row) * n + body_of(column)] = true;
  };
  products.added_mass.for_each(couple);
  products.damping.for_each(couple);
  for (int k = 0; k < convolution.n_moving_pairs; ++k)
    couple(convolution.pairs[static_cast<std::size_t>(k)].row,
           convolution.pairs[static_cast<std::size_t>(k)].column);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (bodies[j].moves && (i == j || coupled[i * n + j]))
        links[i].partners.push_back(static_cast<int>(j));
  for (Index z = 0; z < output.cols(); ++z)
    for (Index u = 0; u < output.rows(); ++u)
      if (output(u, z) != 0.0)
        if (std::vector<int>& states = links[body_of(u)].states;
            states.empty() || states.back() != z)
          states.push_back(static_cast<int>(z));
  for (std::size_t k = 0; k < inputs.size(); ++k)
    links[body_of(inputs[k].coordinate)].inputs.push_back(static_cast<int>(k));
}

double HydroData::own_added_mass(int u) const {
  double out = added_mass(u, u);
  const Coordinate& k = coordinates[static_cast<std::size_t>(u)];
  if (const int t = bodies[static_cast<std::size_t>(k.hydro_body)].table; t >= 0)
    for (const Matrix6& table : tables[static_cast<std::size_t>(t)].added_mass)
      out = std::max(out, table(k.component, k.component));
  return out;
}

} // namespace hydrodae::system
