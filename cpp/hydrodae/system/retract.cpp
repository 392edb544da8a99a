#include "hydrodae/system/retract.h"

#include "hydrodae/math/rotation.h"

namespace hydrodae::system {

void retract(const System& s, const VectorX& step, VectorX& y) {
  for (const BodyData& b : s.bodies) {
    for (int k = 0; k < b.n_active; ++k)
      if (b.active[k] < 3 || b.rotation == BodyData::Rotation::about_axis)
        y[b.q0 + k] += step[b.u0 - s.u0 + k];
    if (b.rotation != BodyData::Rotation::free)
      continue;
    const Index q = b.q0 + b.n_translations;
    const Vector4 turn =
        quaternion_from_rotation_vector(step.segment<3>(b.u0 - s.u0 + b.n_translations));
    const Vector4 p = y.segment<4>(q);
    y.segment<4>(q) = p * turn[0] + quaternion_rate_matrix<double>(p) * turn.tail<3>();
  }
}

void normalise(const System& s, VectorX& y) {
  for (const BodyData& b : s.bodies)
    if (b.rotation == BodyData::Rotation::free)
      y.segment<4>(b.q0 + b.n_translations).normalize();
}

} // namespace hydrodae::system
