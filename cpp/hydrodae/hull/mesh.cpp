#include "hydrodae/hull/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
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
  bool forward; ///< true: from low to high
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
    if (!(vertices.row(i).array().abs() < farthest).all())
      throw Error(place(vertices, i) + " of the mesh is no place; give finite numbers in metres");
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

/// Part of its volume that a shell may share with others: a layer of this over its whole surface is
/// `depth` thick. Tessellations of two surfaces that touch differ by less.
constexpr double shared = 0.01;

/// A closed surface that shares no edge with others.
struct Shell {
  std::vector<int> triangles;
  std::vector<const Edge*> edges;
  double volume = 0.0, area = 0.0; ///< volume < 0: its normals point inwards [m3, m2]
  Vector3 low = Vector3::Constant(INFINITY), high = -low; ///< corners of the box around it [m]
  double depth() const { return shared * volume / area; } ///< inwards [m]
  std::string text() const {
    return "the closed surface of the mesh that holds triangle " +
           std::to_string(triangles.front());
  }
};

Vector3 corner(const Mesh& mesh, int triangle, Index j) {
  return mesh.vertices.row(mesh.triangles(triangle, j)).matrix().transpose();
}

std::vector<Shell> shells_of(const Mesh& mesh) {
  Sets sets(mesh.triangles.rows());
  for (const Edge& e : mesh.edges)
    sets.join(e.left, e.right);
  std::vector<Shell> shells;
  std::vector<std::size_t> of(static_cast<std::size_t>(mesh.triangles.rows()));
  for (int i = 0; i < mesh.triangles.rows(); ++i) {
    const auto root = static_cast<std::size_t>(sets.root(i));
    if (root == static_cast<std::size_t>(i)) {
      of[root] = shells.size();
      shells.emplace_back();
    }
    Shell& shell = shells[of[root]];
    shell.triangles.push_back(i);
    shell.area += mesh.areas.row(i).matrix().norm();
    for (Index j = 0; j < 3; ++j) {
      shell.low = shell.low.cwiseMin(corner(mesh, i, j));
      shell.high = shell.high.cwiseMax(corner(mesh, i, j));
    }
    const Vector3 start = corner(mesh, shell.triangles.front(), 0); // near: no large differences
    shell.volume += (corner(mesh, i, 0) - start).dot(mesh.areas.row(i).matrix().transpose()) / 3.0;
  }
  for (const Edge& e : mesh.edges)
    shells[of[static_cast<std::size_t>(sets.root(e.left))]].edges.push_back(&e);
  return shells;
}

/// Half of the solid angle of triangles as seen from a point, over 2 pi: 1 inside, 0 outside.
double winding(const Mesh& mesh, const std::vector<int>& all, const Vector3& point) {
  double halves = 0.0;
  for (const int i : all) {
    std::array<Vector3, 3> r;
    std::array<double, 3> d{};
    for (std::size_t j = 0; j < 3; ++j) {
      r[j] = corner(mesh, i, static_cast<Index>(j)) - point;
      d[j] = r[j].norm();
    }
    halves +=
        std::atan2(r[0].dot(r[1].cross(r[2])), d[0] * d[1] * d[2] + r[0].dot(r[1]) * d[2] +
                                                   r[1].dot(r[2]) * d[0] + r[2].dot(r[0]) * d[1]);
  }
  return halves / (2.0 * pi);
}

/// Vertices of a shell, each moved inwards until it is `depth` below all triangles around it: along
/// the sum of their normals, each by its angle there. (n_vertices, 3); zero for other vertices.
Vertices sunk(const Mesh& mesh, const Shell& shell) {
  const auto normal = [&](int triangle) -> Vector3 {
    return mesh.areas.row(triangle).matrix().normalized().transpose(); // zero without an area
  };
  const auto for_corners = [&](auto&& visit) {
    for (const int i : shell.triangles)
      for (Index j = 0; j < 3; ++j)
        visit(i, j, mesh.triangles(i, j));
  };
  Vertices middle = Vertices::Zero(mesh.vertices.rows(), 3), out = middle;
  for_corners([&](int i, Index j, int v) {
    const Vector3 at = corner(mesh, i, j), p = corner(mesh, i, (j + 1) % 3) - at,
                  q = corner(mesh, i, (j + 2) % 3) - at;
    middle.row(v) += std::atan2(p.cross(q).norm(), p.dot(q)) * normal(i).transpose();
  });
  constexpr double sharpest = 0.1; // a vertex of a needle goes ten times as deep at most
  VectorX least = VectorX::Ones(mesh.vertices.rows());
  for_corners([&](int i, Index, int v) {
    if (const Vector3 n = normal(i); n != Vector3::Zero())
      least[v] = std::min(least[v], middle.row(v).normalized().dot(n));
  });
  for_corners([&](int, Index, int v) {
    out.row(v) = mesh.vertices.row(v).matrix() -
                 shell.depth() / std::max(least[v], sharpest) * middle.row(v).normalized();
  });
  return out;
}

/// Returns whether the line from p to q passes through a triangle.
bool pierces(const Mesh& mesh, const std::array<Vector3, 2>& line, int triangle) {
  const Vector3 a = corner(mesh, triangle, 0), b = corner(mesh, triangle, 1),
                c = corner(mesh, triangle, 2), normal = (b - a).cross(c - a),
                along = line[1] - line[0];
  if (normal.dot(line[0] - a) * normal.dot(line[1] - a) >= 0.0)
    return false;
  const Vector3 p = a - line[0], q = b - line[0], r = c - line[0];
  const double u = along.dot(p.cross(q)), v = along.dot(q.cross(r)), w = along.dot(r.cross(p));
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

/// Triangle of `other` that an edge of the shell, between its sunk vertices, passes through; -1:
/// none.
int pierced(const Mesh& mesh, const Shell& shell, const Vertices& sunk, const Shell& other) {
  const auto apart = [](const Vector3& low, const Vector3& high, const Vector3& low2,
                        const Vector3& high2) {
    return (low.array() > high2.array()).any() || (high.array() < low2.array()).any();
  };
  if (apart(shell.low, shell.high, other.low, other.high))
    return -1;
  for (const Edge* e : shell.edges) {
    const std::array<Vector3, 2> line{sunk.row(e->a).transpose(), sunk.row(e->b).transpose()};
    const Vector3 low = line[0].cwiseMin(line[1]), high = line[0].cwiseMax(line[1]);
    if (apart(low, high, other.low, other.high))
      continue;
    for (const int i : other.triangles) {
      const Vector3 a = corner(mesh, i, 0), b = corner(mesh, i, 1), c = corner(mesh, i, 2);
      if (!apart(low, high, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)) &&
          pierces(mesh, line, i))
        return i;
    }
  }
  return -1;
}

/// Checks that water reaches each shell from outside, and that no volume counts twice.
void check_shells(const Mesh& mesh, const std::vector<Shell>& shells) {
  for (const Shell& shell : shells)
    if (shell.volume == 0.0)
      throw Error(shell.text() + " encloses no volume; leave it out");
  const auto inside = [&](const Vector3& point, const Shell& shell) {
    return (point.array() >= shell.low.array()).all() &&
           (point.array() <= shell.high.array()).all() &&
           std::abs(winding(mesh, shell.triangles, point)) > 0.5;
  };
  std::string crossing; // reported after what lies inside: an inner shell may touch the outer one
  for (const Shell& shell : shells) {
    if (shells.size() == 1)
      break;
    const Vertices deep = sunk(mesh, shell);
    for (const Shell& other : shells) {
      if (&shell == &other)
        continue;
      if (const int i = pierced(mesh, shell, deep, other); i >= 0)
        crossing = shell.text() + " crosses triangle " + std::to_string(i) +
                   " of another one: the volume inside both would count twice; make one surface "
                   "of them, their union";
      else if (inside(deep.row(shell.edges.front()->a).transpose(), other))
        throw Error(shell.text() + " lies inside another one, where no water reaches it; leave it "
                                   "out: tanks and rooms of a hull count by their mass alone");
    }
  }
  if (!crossing.empty())
    throw Error(crossing);
  for (const Shell& shell : shells)
    if (!(shell.volume > 0.0))
      throw Error(shell.text() + " encloses a volume of " + std::to_string(shell.volume) +
                  " m3: its normals point inwards; reverse the order of the vertices of its "
                  "triangles");
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
    mesh.volume += volume;
    const Vector3 sum = a + b + c;
    moment += volume * 0.25 * sum;
    second += volume / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const std::vector<Shell> shells = shells_of(mesh);
  check_shells(mesh, shells);
  mesh.shells = static_cast<int>(shells.size());
  mesh.centroid = middle - origin + moment / mesh.volume;
  mesh.spread = second - moment * moment.transpose() / mesh.volume;
  return mesh;
}

bool encloses(const Mesh& mesh, const Vector3& point) {
  std::vector<int> all(static_cast<std::size_t>(mesh.triangles.rows()));
  std::iota(all.begin(), all.end(), 0);
  return winding(mesh, all, point) > 0.5;
}

} // namespace hydrodae::hull
