#pragma once
/// Closed surface of a body as plane triangles, in body axes.

#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::hull {

using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>; ///< (n, 3) [m]
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;   ///< (m, 3)
/// (n, 3) array with contiguous coordinates
using Columns = Eigen::Array<double, Eigen::Dynamic, 3>;

/// Vertices are nearer than that to their origin, so that all integrals over the surface are
/// finite: the second moments are sums of fifth powers [m].
inline constexpr double farthest = 1e60;

/// Edge from vertex a to b. Triangle `left` passes it from a to b, triangle `right` from b to a.
struct Edge {
  int a = 0, b = 0, left = 0, right = 0;
};

/// A checked mesh. Constant during a run; several bodies and threads may share it.
struct Mesh {
  Columns vertices;                   ///< (n, 3) [m]
  Triangles triangles;                ///< (m, 3) vertices, anticlockwise as seen from the water
  Columns areas;                      ///< (m, 3) area times outward unit normal [m2]
  std::vector<Edge> edges;            ///< 3 m / 2 of them
  int shells = 0;                     ///< closed surfaces that share no edge
  int degenerate = 0;                 ///< triangles without area; they carry no load
  double volume = 0.0;                ///< enclosed by the whole surface [m3]
  double area = 0.0;                  ///< area of the surface [m2]
  double radius = 0.0;                ///< largest distance of a vertex from the body's origin [m]
  Vector3 centroid = Vector3::Zero(); ///< centre of the enclosed volume [m]
  /// Integral of x x^T over the volume, x relative to the centroid [m5]
  Matrix3 spread = Matrix3::Zero();
};

/// Checks a surface and prepares it. Throws Error, naming the place, if
/// - there is no triangle, a vertex is beyond `farthest`, or a triangle names a missing one,
/// - an edge does not belong to two triangles (the surface has a hole, or vertices are doubled),
/// - two triangles pass their common edge in the same direction (the normals disagree),
/// - a shell encloses a negative volume (its normals point inwards) or none,
/// - shells cross, or one lies inside another. Shells that touch may share a hundredth of the
/// volume.
///
/// @param origin  origin of the body, in the axes of `vertices`; messages name places in these
Mesh make_mesh(const Vertices& vertices, const Triangles& triangles,
               const Vector3& origin = Vector3::Zero());

/// Is a point, in body axes, inside the surface? By the solid angles of all triangles, whose sum is
/// 4 pi inside and 0 outside (A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983)).
bool encloses(const Mesh& mesh, const Vector3& point);

} // namespace hydrodae::hull
