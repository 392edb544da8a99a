#include "hydrodae/model/mass.h"

#include "hydrodae/math/rotation.h"

namespace hydrodae::model {

Matrix3 inertia_tensor(const Body& body) {
  if (body.principal_axes) {
    const Matrix3 R =
        rotation_matrix<double>(quaternion_from_rotation_vector(*body.principal_axes));
    const Matrix3 tensor = R * body.inertia.asDiagonal() * R.transpose();
    return 0.5 * (tensor + tensor.transpose());
  }
  const Vector3 &d = body.inertia, &o = body.products_of_inertia; // Ixy, Iyz, Izx
  Matrix3 tensor;
  tensor << d[0], o[0], o[2], o[0], d[1], o[1], o[2], o[1], d[2];
  return tensor;
}

} // namespace hydrodae::model
