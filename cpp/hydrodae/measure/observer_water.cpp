/// Of the observer: added mass and radiation.

#include "hydrodae/measure/observer.h"
#include "hydrodae/system/hydrodynamics.h"

namespace hydrodae::measure {

using namespace system;

/// What the radiation takes on all coordinates, locked ones too; needs U and U'.
void Observer::observe_memory(const HydroData& h, const double* y) {
  memory_.noalias() = h.output_all * Eigen::Map<const VectorX>(y + h.z0, h.n_states);
  if (h.damped)
    memory_.noalias() += h.damping_all * ws_.U;
  if (h.convolution.empty() || !ws_.past)
    return;
  const Past& past = *ws_.past;
  for (int u = 0; u < h.n_moving; ++u)
    memory_[6 * h.coordinates[u].hydro_body + h.coordinates[u].component] +=
        past.memory[u] + past.by_U.row(u).dot(ws_.U) + past.by_U_dot.row(u).dot(ws_.U_dot);
  for (std::size_t k = 0; k < h.convolution.locked.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    memory_[h.convolution.locked[k]] += past.memory_locked[row] +
                                        past.locked_by_U.row(row).dot(ws_.U) +
                                        past.locked_by_U_dot.row(row).dot(ws_.U_dot);
  }
}

void Observer::observe(const HydroData& h, const double* y) {
  hydro_motion(s_, ws_);
  momentum_.noalias() = h.added_mass_all * ws_.U;
  rate_.noalias() = h.added_mass_all * ws_.U_dot;
  observe_memory(h, y);
  for (int u = 0; u < h.n_moving; ++u) {
    const HydroData::Coordinate& k = h.coordinates[u];
    out_.kinetic_added_mass += 0.5 * ws_.U[u] * momentum_[6 * k.hydro_body + k.component];
  }
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const BodyState<double>& state = ws_.bodies[hb.body];
    const auto row = 6 * static_cast<Eigen::Index>(i);
    const Vector6 added =
        hydro_load<double>(h.axes, hb, state, rate_.segment<6>(row), momentum_.segment<6>(row));
    add_load(-to_world(state, added));
    if (!h.radiates())
      continue;
    const Vector6 radiation =
        hydro_load<double>(h.axes, hb, state, memory_.segment<6>(row), Vector6::Zero());
    add_load(-to_world(state, radiation));
  }
}

} // namespace hydrodae::measure
