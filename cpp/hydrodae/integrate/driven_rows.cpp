#include "hydrodae/integrate/driven_rows.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/system/mechanisms.h"

namespace hydrodae::integrate {

DrivenRows::DrivenRows(const system::Regime& system) : s_(system) {
  const auto group_of = [&](const system::JointData& j) {
    const system::BodyData* body = system::moving_body(s_, j);
    return body ? body->group : -1;
  };
  const bool stabilised = s_.formulation == system::Formulation::stabilised;
  std::vector<bool> driven(static_cast<std::size_t>(s_.n_groups));
  for (const system::CouplerData& c : s_.couplers) {
    if (const int g = group_of(system::joint_of(s_, c));
        s_.holds(c) && (c.velocity_level || c.drive.moves() || c.drive.rate != 0.0) && g >= 0) {
      driven[static_cast<std::size_t>(g)] = true;
      rows_.emplace_back(stabilised && !c.velocity_level ? s_.mu(c) : s_.lambda(c), g);
    }
  }
  for (const system::JointData& j : s_.joints)
    if (const int g = group_of(j); stabilised && g >= 0 && driven[static_cast<std::size_t>(g)])
      for (const system::RowData& row : j.rows)
        if (s_.holds(row) && s_.mu(row) >= 0)
          rows_.emplace_back(s_.mu(row), g);
}

double DrivenRows::largest(const VectorX& residual) const {
  double size = 0.0;
  for (const auto& [row, group] : rows_)
    size = std::max(size, std::abs(residual[row]) / (s_.motion_scale[group] * s_.row_scale[row]));
  return size;
}

} // namespace hydrodae::integrate
