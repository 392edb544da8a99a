#include "hydrodae/hull/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>

#include "hydrodae/core/error.h"
#include "hydrodae/math/sets.h"

namespace hydrodae::hull {
namespace {

/// Below this part of the square of its longest edge, the area of a triangle is rounding.
constexpr double no_area = 1e-12;

struct Directed {
  int low, high, triangle;
  bool forward; ///< from low to high
};

std::string place(const Vertices& vertices, int i) {
  char text[100];
  std::snprintf(text, sizeof text, "vertex %d at (%.6g, %.6g, %.6g)", i, vertices(i, 0),
                vertices(i, 1), vertices(i, 2));
  return text;
}

void check_numbers(const Vertices& vertices, const Triangles& triangles) {
  if (triangles.rows() == 0)
    throw Error("the mesh has no triangles");
  for (int i = 0; i < vertices.rows(); ++i)
    if (!vertices.row(i).allFinite())
      throw Error("vertex " + std::to_string(i) + " of the mesh is not finite");
  for (int i = 0; i < triangles.rows(); ++i)
    if (triangles.row(i).minCoeff() < 0 || triangles.row(i).maxCoeff() >= vertices.rows())
      throw Error("triangle " + std::to_string(i) + " of the mesh names a vertex outside 0 .. " +
                  std::to_string(vertices.rows() - 1));
}

std::vector<Directed> directed_edges(const Triangles& triangles) {
  std::vector<Directed> out;
  out.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (int i = 0; i < triangles.rows(); ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = triangles(i, j), b = triangles(i, (j + 1) % 3);
      out.push_back({std::min(a, b), std::max(a, b), i, a < b});
    }
  std::sort(out.begin(), out.end(), [](const Directed& p, const Directed& q) {
    return std::tie(p.low, p.high, p.triangle) < std::tie(q.low, q.high, q.triangle);
  });
  return out;
}

std::vector<Edge> pair_edges(const Vertices& vertices, const Triangles& triangles) {
  const std::vector<Directed> all = directed_edges(triangles);
  std::vector<Edge> edges;
  edges.reserve(all.size() / 2);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high)
      ++end;
    const std::string ends =
        "between " + place(vertices, all[i].low) + " and " + place(vertices, all[i].high);
    if (end - i != 2)
      throw Error("the mesh is not closed: the edge " + ends + " belongs to " +
                  std::to_string(end - i) +
                  " triangles instead of 2; add the missing triangles (a lid, for example) or "
                  "merge doubled vertices");
    if (all[i].forward == all[i + 1].forward)
      throw Error("the normals of the mesh disagree: triangles " + std::to_string(all[i].triangle) +
                  " and " + std::to_string(all[i + 1].triangle) + " pass the edge " + ends +
                  " in the same direction; reverse the order of the vertices of one of them");
    const Directed &left = all[i].forward ? all[i] : all[i + 1],
                   &right = all[i].forward ? all[i + 1] : all[i];
    edges.push_back({left.low, left.high, left.triangle, right.triangle});
    i = end;
  }
  return edges;
}

/// For each triangle the first triangle of its shell.
std::vector<int> shells_of(const Triangles& triangles, const std::vector<Edge>& edges) {
  Sets sets(triangles.rows());
  for (const Edge& e : edges)
    sets.join(e.left, e.right);
  std::vector<int> out;
  for (Index i = 0; i < triangles.rows(); ++i)
    out.push_back(static_cast<int>(sets.root(i)));
  return out;
}

} // namespace

Mesh make_mesh(const Vertices& vertices, const Triangles& triangles, const Vector3& origin) {
  check_numbers(vertices, triangles);
  Mesh mesh;
  mesh.vertices = (vertices.rowwise() - origin.transpose()).array();
  mesh.triangles = triangles;
  mesh.edges = pair_edges(vertices, triangles);
  mesh.areas.resize(triangles.rows(), 3);
  mesh.radius = mesh.vertices.matrix().rowwise().norm().maxCoeff();
  const std::vector<int> shell = shells_of(triangles, mesh.edges);
  std::vector<double> volumes(shell.size(), 0.0);
  // Tetrahedra over a point near the surface, not over an origin that may be far away.
  const Vector3 middle = vertices.colwise().mean();
  Vector3 moment = Vector3::Zero();
  Matrix3 second =
      Matrix3::Zero(); // over a tetrahedron 0 a b c: V / 20 (aa + bb + cc + ss), s = a + b + c
  for (int i = 0; i < triangles.rows(); ++i) {
    const Vector3 a = vertices.row(triangles(i, 0)).transpose() - middle,
                  b = vertices.row(triangles(i, 1)).transpose() - middle,
                  c = vertices.row(triangles(i, 2)).transpose() - middle;
    const Vector3 area = 0.5 * (b - a).cross(c - a);
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    mesh.degenerate += area.norm() <= no_area * longest;
    mesh.areas.row(i) = area.transpose().array();
    mesh.area += area.norm();
    const double volume = a.dot(area) / 3.0;
    volumes[static_cast<std::size_t>(shell[static_cast<std::size_t>(i)])] += volume;
    const Vector3 sum = a + b + c;
    moment += volume * 0.25 * sum;
    second += volume / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  for (int i = 0; i < triangles.rows(); ++i) {
    if (shell[static_cast<std::size_t>(i)] != i)
      continue;
    ++mesh.shells;
    const double volume = volumes[static_cast<std::size_t>(i)];
    if (!(volume > 0.0))
      throw Error("the closed surface of the mesh that holds triangle " + std::to_string(i) +
                  " encloses a volume of " + std::to_string(volume) +
                  " m3: its normals point inwards; reverse the order of the vertices of its "
                  "triangles");
    mesh.volume += volume;
  }
  mesh.centroid = middle - origin + moment / mesh.volume;
  mesh.spread = second - moment * moment.transpose() / mesh.volume;
  return mesh;
}

bool encloses(const Mesh& mesh, const Vector3& point) {
  double halves = 0.0; // of the solid angle
  for (Index i = 0; i < mesh.triangles.rows(); ++i) {
    std::array<Vector3, 3> r;
    std::array<double, 3> d{};
    for (std::size_t j = 0; j < 3; ++j) {
      const int v = mesh.triangles(i, static_cast<Index>(j));
      r[j] = mesh.vertices.row(v).matrix().transpose() - point;
      d[j] = r[j].norm();
    }
    halves +=
        std::atan2(r[0].dot(r[1].cross(r[2])), d[0] * d[1] * d[2] + r[0].dot(r[1]) * d[2] +
                                                   r[1].dot(r[2]) * d[0] + r[2].dot(r[0]) * d[1]);
  }
  return halves > pi;
}

} // namespace hydrodae::hull
