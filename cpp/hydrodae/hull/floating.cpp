#include "hydrodae/hull/floating.h"

#include "hydrodae/core/error.h"

namespace hydrodae::hull {

Floating floating(const Mesh& mesh, const WaveField& still, const Pose& pose, Workspace& work) {
  if (!still.still())
    throw Error("the water plane of a body is that of still water, not of waves");
  find_wet_surface(mesh, still, pose, {}, false, work);
  const WetPoints& points = work.points;
  Floating out;
  const auto n = points.size;
  const auto x = points.x.col(0).head(n), y = points.x.col(1).head(n);
  const auto z = points.height.head(n);
  const auto up = points.weight.col(2).head(n); // n_z dS
  out.wetted_area = points.weight.topRows(n).square().rowwise().sum().sqrt().sum();
  out.plane_area = -up.sum();
  out.plane_x = -(x * up).sum();
  out.plane_y = -(y * up).sum();
  out.plane_xx = -(x.square() * up).sum();
  out.plane_xy = -(x * y * up).sum();
  out.plane_yy = -(y.square() * up).sum();
  out.volume = (z * up).sum();
  if (out.volume > 0.0)
    out.buoyancy = Vector3((x * z * up).sum(), (y * z * up).sum(), 0.5 * (z.square() * up).sum()) /
                       out.volume -
                   Vector3(0.0, 0.0, pose.position[2]);
  return out;
}

Floating floating_in_reference_pose(const Mesh& mesh, const Vector3& origin) {
  const WaveField still(Water{});
  Workspace work(mesh, still);
  return floating(mesh, still, {origin, Matrix3::Identity()}, work);
}

Matrix3 Floating::stiffness(double weight) const {
  Matrix3 C;
  C << plane_area, plane_y, -plane_x,                      //
      plane_y, plane_yy + volume * buoyancy[2], -plane_xy, //
      -plane_x, -plane_xy, plane_xx + volume * buoyancy[2];
  return weight * C;
}

} // namespace hydrodae::hull
