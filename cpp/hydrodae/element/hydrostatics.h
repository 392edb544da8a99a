#pragma once
#include <string>
#include <string_view>

#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::element {

/// Linear hydrostatics of a body, from the database: buoyancy and its stiffness about the pose of
/// the database, turned with the mean yaw.
struct Hydrostatics {
  static constexpr std::string_view type = "hydrostatic";
  static constexpr Port port = Port::on_body;
  static constexpr Work work = Work::lent;
  std::string name;
  LinearWrench wrench;

  const LinearWrench& law() const { return wrench; }
};

} // namespace hydrodae::element
