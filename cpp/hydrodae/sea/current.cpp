/// Current over the depth.

#include "hydrodae/sea/kinematics.h"

namespace hydrodae::sea {

std::vector<Layer> layers(const std::vector<Vector3>& rows) {
  std::vector<Layer> out;
  for (const Vector3& row : rows) {
    const double heading = row[2] * pi / 180.0;
    out.push_back({row[0], {row[1] * std::cos(heading), row[1] * std::sin(heading), 0.0}});
  }
  return out;
}

} // namespace hydrodae::sea
