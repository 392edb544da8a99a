#pragma once
/// The wetted part of a mesh as weighted points: a quadrature rule of degree 2 on every triangle.
///
///   integral of f n dS = sum_i f(x_i) w_i
///
/// The points are the middles of the edges of each wet triangle; each has a third of its area
/// vector. Triangles beneath the surface share the points of their edges, 1.5 for each triangle.
/// Exact for f of degree 2, so for the force and the moment of a pressure that is linear in x.
///
/// Triangles that cross the surface z = eta are clipped where z - eta, taken at the vertices and
/// linear between them, vanishes. With waves continued by `vertical` the pressure has a kink at
/// z = 0: there the wet part is divided as well.

#include <vector>

#include "hydrodae/hull/clip.h"
#include "hydrodae/hull/mesh.h"
#include "hydrodae/hull/wave_field.h"

namespace hydrodae::hull {

/// Position of the body's origin [m] and rotation from body to world axes.
struct Pose {
  Vector3 position = Vector3::Zero();
  Matrix3 rotation = Matrix3::Identity();
};

/// Weighted points. All vectors are in world axes, x relative to the body's origin.
struct WetPoints {
  int size = 0;
  Columns x;                ///< (capacity, 3) [m]
  Columns weight;           ///< (capacity, 3) [m2], along the outward normal
  Eigen::ArrayXd height;    ///< height above still water [m]
  Eigen::ArrayXd dynamic;   ///< dynamic pressure [Pa]
  Columns dynamic_gradient; ///< gradient by the place in the world [Pa/m]
};

/// A triangle of the clipped part whose corners slide; its three points follow each other.
struct Facet {
  Vector3 normal; ///< outward, length 1
  int point;      ///< the first of its points: middle of corners 0 and 1, of 1 and 2, of 2 and 0
  std::array<int, 3> corner;
};

/// Scratch of one body. It grows where a call needs more than those before; then no call allocates.
struct Workspace {
  Workspace(const Mesh& mesh, const WaveField& field);

  WaveView view;
  Columns place;                  ///< vertices relative to the body's origin, world axes [m]
  Eigen::ArrayXd height;          ///< heights of the vertices above still water [m]
  Columns surface;                ///< eta, d eta/dx, d eta/dy at the vertices
  Columns areas;                  ///< areas of the triangles, world axes [m2]
  std::vector<unsigned char> wet; ///< side of each triangle: dry, wet or crossing (wet_surface.cpp)
  std::vector<int> needed;        ///< vertices where the elevation is needed
  std::vector<char> is_needed;
  Columns needed_place, needed_surface;
  std::vector<int> crossing; ///< triangles that cross the surface
  WetPoints points;
  std::vector<Facet> facets;   ///< filled only if slides are requested
  std::vector<Corner> corners; ///< corners of `facets`
};

/// Fills the points of a workspace, and with `slides` its facets. Pressures are not set.
void find_wet_surface(const Mesh& mesh, const WaveField& field, const Pose& pose,
                      const Instant& instant, bool slides, Workspace& work);

} // namespace hydrodae::hull
