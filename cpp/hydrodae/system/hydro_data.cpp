#include "hydrodae/system/hydro_data.h"

namespace hydrodae::system {

void HydroData::link() {
  links.assign(bodies.size(), {});
  const auto numbers = [&](const HydroBody& body) {
    std::vector<int> out;
    for (const int u : body.moving)
      if (u >= 0)
        out.push_back(u);
    return out;
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::vector<int> rows = numbers(bodies[i]);
    for (std::size_t j = 0; j < bodies.size(); ++j) {
      bool coupled = i == j || !convolution.empty();
      for (const int row : rows)
        for (const int column : numbers(bodies[j]))
          coupled =
              coupled || added_mass(row, column) != 0.0 || (damped && damping(row, column) != 0.0);
      if (bodies[j].moves && coupled)
        links[i].partners.push_back(static_cast<int>(j));
    }
    for (int z = 0; z < n_states; ++z)
      for (const int row : rows)
        if (output(row, z) != 0.0) {
          links[i].states.push_back(z);
          break;
        }
  }
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const Coordinate& u = coordinates[static_cast<std::size_t>(inputs[k].coordinate)];
    links[static_cast<std::size_t>(u.hydro_body)].inputs.push_back(static_cast<int>(k));
  }
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
