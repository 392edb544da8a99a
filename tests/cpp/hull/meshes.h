#pragma once
/// Closed meshes of simple bodies, in axes through their middle unless said otherwise.

#include <map>
#include <vector>

#include "hydrodae/hull/mesh.h"

namespace hydrodae::tests {

struct MeshArrays {
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> triangles;

  hull::Vertices vertex_array() const {
    hull::Vertices out(static_cast<int>(vertices.size()), 3);
    for (int i = 0; i < out.rows(); ++i)
      out.row(i) = vertices[static_cast<std::size_t>(i)].transpose();
    return out;
  }
  hull::Triangles triangle_array() const {
    hull::Triangles out(static_cast<int>(triangles.size()), 3);
    for (int i = 0; i < out.rows(); ++i)
      for (int j = 0; j < 3; ++j)
        out(i, j) = triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return out;
  }
  hull::Mesh mesh() const { return hull::make_mesh(vertex_array(), triangle_array()); }
};

/// An octahedron whose faces are divided `level` times in four and blown up: 8 4^level triangles,
/// all vertices on the sphere.
inline MeshArrays sphere(double radius, int level) {
  MeshArrays out;
  for (int j = 0; j < 3; ++j)
    for (double sign : {1.0, -1.0})
      out.vertices.push_back(sign * radius * Vector3::Unit(j));
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1, y = 2 + ((i >> 1) & 1), z = 4 + (i >> 2);
    const bool mirrored = ((i & 1) + ((i >> 1) & 1) + (i >> 2)) % 2 == 1;
    out.triangles.push_back(mirrored ? std::array{x, z, y} : std::array{x, y, z});
  }
  for (int k = 0; k < level; ++k) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(out.vertices.size()));
      if (is_new)
        out.vertices.push_back(radius * (out.vertices[static_cast<std::size_t>(a)] +
                                         out.vertices[static_cast<std::size_t>(b)])
                                            .normalized());
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : out.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    out.triangles = finer;
  }
  return out;
}

/// 12 triangles.
inline MeshArrays box(double length, double width, double height) {
  MeshArrays out;
  for (int i = 0; i < 8; ++i)
    out.vertices.push_back(
        0.5 * Vector3(i & 1 ? length : -length, i & 2 ? width : -width, i & 4 ? height : -height));
  const auto face = [&](int a, int b, int c, int d) {
    out.triangles.push_back({a, b, c});
    out.triangles.push_back({a, c, d});
  };
  face(0, 2, 3, 1);
  face(4, 5, 7, 6);
  face(0, 1, 5, 4);
  face(2, 6, 7, 3);
  face(0, 4, 6, 2);
  face(1, 3, 7, 5);
  return out;
}

/// The surface that a line of (radius, z) from the axis at the bottom to the axis at the top makes
/// as it turns about z, with `around` vertices on each ring.
inline MeshArrays turned(const std::vector<std::array<double, 2>>& line, int around) {
  MeshArrays out;
  const int rings = static_cast<int>(line.size()) - 2;
  out.vertices.push_back({0.0, 0.0, line.front()[1]});
  for (int i = 1; i <= rings; ++i)
    for (int j = 0; j < around; ++j) {
      const auto [r, z] = line[static_cast<std::size_t>(i)];
      out.vertices.push_back(
          {r * std::cos(2 * pi * j / around), r * std::sin(2 * pi * j / around), z});
    }
  out.vertices.push_back({0.0, 0.0, line.back()[1]});
  const auto at = [&](int ring, int j) { return 1 + ring * around + j % around; };
  const int top = 1 + rings * around;
  for (int j = 0; j < around; ++j) {
    out.triangles.push_back({0, at(0, j + 1), at(0, j)});
    for (int i = 0; i + 1 < rings; ++i) {
      out.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
    out.triangles.push_back({top, at(rings - 1, j), at(rings - 1, j + 1)});
  }
  return out;
}

/// A vertical cylinder from z = bottom to z = top, `rows` rows on its side, `rings` on its ends.
inline MeshArrays cylinder(double radius, double bottom, double top, int around, int rows,
                           int rings) {
  std::vector<std::array<double, 2>> line;
  for (int i = 0; i < rings; ++i)
    line.push_back({radius * i / rings, bottom});
  for (int i = 0; i <= rows; ++i)
    line.push_back({radius, bottom + (top - bottom) * i / rows});
  for (int i = rings - 1; i >= 0; --i)
    line.push_back({radius * i / rings, top});
  return turned(line, around);
}

} // namespace hydrodae::tests
