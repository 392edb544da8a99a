#pragma once
/// What forward and backward kinematics of the tree have in common.

#include "hydrodae/tree/joint_tree.h"

namespace hydrodae::tree {

/// p o q of quaternions.
inline Vector4 product(const Vector4& p, const Vector4& q) {
  return p * q[0] + quaternion_rate_matrix<double>(p) * q.tail<3>();
}

/// Markers of a link, world axes.
struct LinkEnds {
  Matrix3 A, B;      ///< axes of the joint's markers
  Vector3 a, b;      ///< their origins
  double sign = 1.0; ///< of the link's motion against the joint's
};
LinkEnds link_ends(const TreeLink& link, const TreeMotion::Body& parent,
                   const TreeMotion::Body& child);

/// The body that a link hangs on, or the ground.
const TreeMotion::Body& parent_of(const TreeLink& link,
                                  const std::vector<TreeMotion::Body>& bodies);

/// Columns of a link; its body and the parent stand where they belong.
void fill_columns(const TreeLink& link, const TreeMotion::Body& parent,
                  const TreeMotion::Body& child, TreeColumn* column);

} // namespace hydrodae::tree
