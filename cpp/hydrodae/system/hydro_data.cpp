#include "hydrodae/system/hydro_data.h"

namespace hydrodae::system {

namespace {

Product few_nonzeros(const MatrixX& m) {
  Product out(m);
  return out.by_nonzeros() ? out : Product();
}

} // namespace

void HydroData::link() {
  links.assign(bodies.size(), {});
  const auto body_of = [&](Index u) {
    return static_cast<std::size_t>(coordinates[static_cast<std::size_t>(u)].hydro_body);
  };
  // Bodies and states that load a body, by the columns of the matrices: each once, in their order.
  const auto note = [](std::vector<int>& list, int number) {
    if (list.empty() || list.back() != number)
      list.push_back(number);
  };
  const bool all = !convolution.empty();
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    if (!bodies[j].moves)
      continue;
    std::vector<bool> loaded(bodies.size(), all);
    loaded[j] = true;
    for (const int column : bodies[j].moving)
      for (Index row = 0; column >= 0 && row < n_moving; ++row)
        if (added_mass(row, column) != 0.0 || (damped && damping(row, column) != 0.0))
          loaded[body_of(row)] = true;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (loaded[i])
        links[i].partners.push_back(static_cast<int>(j));
  }
  for (int z = 0; z < n_states; ++z)
    for (Index row = 0; row < n_moving; ++row)
      if (output(row, z) != 0.0)
        note(links[body_of(row)].states, z);
  for (std::size_t k = 0; k < inputs.size(); ++k)
    links[body_of(inputs[k].coordinate)].inputs.push_back(static_cast<int>(k));
  few_added_mass = few_nonzeros(added_mass);
  few_output = few_nonzeros(output);
  few_damping = few_nonzeros(damping);
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
