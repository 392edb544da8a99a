#pragma once
#include <string>
#include <string_view>

#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::water {

/// Linear hydrostatics of a body, from the database: buoyancy and its stiffness about the pose of
/// the database, turned with the mean yaw.
struct Hydrostatics {
  static constexpr std::string_view type = "hydrostatic";
  static constexpr bool buoyant = true;
  static constexpr element::Port port = element::Port::on_body;
  static constexpr element::Work work = element::Work::lent;
  std::string name;
  element::LinearWrench wrench;

  const element::LinearWrench& law() const { return wrench; }
};

} // namespace hydrodae::water
