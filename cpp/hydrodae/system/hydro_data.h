#pragma once
/// Added mass and radiation of all bodies in the water.
///
///   loads along the coordinates of U: -(A U)' - F(U, U', z),   z' = h(U, z)
///
/// F and h are those of the rung of radiation (water/radiation_law.h).

#include <string>
#include <vector>

#include "hydrodae/water/radiation.h"

namespace hydrodae::system {

using water::AddedMass;
using water::HydroAxes;
using water::HydroBody;

struct HydroData : water::WetBodies {
  AddedMass added_mass;
  water::Radiation radiation;
  std::vector<std::string> uncovered; ///< labels of rows whose load the fit omits
  Index z0 = 0;                       ///< offset of the states of the radiation in y
  /// Bodies whose motion loads a body by added mass or radiation, apart from states; includes
  /// itself. One list for each of `bodies`.
  std::vector<std::vector<int>> partners;

  /// Calls `f` with the rung of radiation.
  template <class F> decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), radiation);
  }
  /// Radiation as this rung; without loads if it is another.
  template <class Rung> const Rung& as() const {
    static const Rung none;
    const Rung* own = std::get_if<Rung>(&radiation);
    return own ? *own : none;
  }
  int n_states() const {
    return visit([](const auto& rung) { return rung.n_states(); });
  }
  bool radiates() const {
    return visit([](const auto& rung) { return rung.acts(); });
  }

  /// Finds `partners`, and the products of added mass and radiation; call it last.
  void link() {
    added_mass.link();
    std::visit([this](auto& rung) { rung.link(*this); }, radiation);
    const std::size_t n = bodies.size();
    std::vector<bool> coupled(n * n);
    const auto body_of = [this](Index u) {
      return static_cast<std::size_t>(coordinates[static_cast<std::size_t>(u)].hydro_body);
    };
    const auto couple = [&](Index row, Index column, double = 0.0) {
      coupled[body_of(row) * n + body_of(column)] = true;
    };
    added_mass.product.for_each(couple);
    visit([&](const auto& rung) { rung.for_each_coupling(couple); });
    partners.assign(n, {});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (bodies[j].moves && (i == j || coupled[i * n + j]))
          partners[i].push_back(static_cast<int>(j));
  }
};

} // namespace hydrodae::system
