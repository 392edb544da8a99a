#include "hydrodae/hull/wet_surface.h"

#include <algorithm>

#include "hydrodae/core/error.h"

namespace hydrodae::hull {
namespace {

/// Bits, so that three of a kind are seen by `or`.
enum Side : unsigned char { none = 0, wet = 1, dry = 2, crossing = 3 };

void turn(const Columns& in, const Matrix3& R, Columns& out) {
  for (int i = 0; i < 3; ++i)
    out.col(i) = R(i, 0) * in.col(0) + R(i, 1) * in.col(1) + R(i, 2) * in.col(2);
}

/// Elevation at the vertices of all triangles that may cross the surface.
void find_elevations(const Mesh& mesh, const WaveField& field, bool slides, Workspace& work) {
  const double highest = field.highest(work.view, mesh.radius);
  work.needed.clear();
  std::fill(work.is_needed.begin(), work.is_needed.end(), 0);
  for (int i = 0; i < mesh.triangles.rows(); ++i) {
    const auto at = [&](int j) { return work.height[mesh.triangles(i, j)]; };
    const double low = std::min({at(0), at(1), at(2)}), high = std::max({at(0), at(1), at(2)});
    // Between the two bounds, or a triangle that spans both.
    if (high < -highest || low > highest)
      continue;
    for (int j = 0; j < 3; ++j) {
      const int v = mesh.triangles(i, j);
      if (!work.is_needed[static_cast<std::size_t>(v)]) {
        work.is_needed[static_cast<std::size_t>(v)] = 1;
        work.needed.push_back(v);
      }
    }
  }
  const int n = static_cast<int>(work.needed.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2; ++j)
      work.needed_place(i, j) = work.place(work.needed[static_cast<std::size_t>(i)], j);
  Columns &in = work.needed_place, &out = work.needed_surface;
  field.elevation(work.view, {n, in.col(0).data(), in.col(1).data(), nullptr},
                  {out.col(0).data(), slides ? out.col(1).data() : nullptr,
                   slides ? out.col(2).data() : nullptr, nullptr});
  // Elsewhere the side of a vertex does not depend on the elevation.
  work.surface.setZero();
  for (int i = 0; i < n; ++i)
    work.surface.row(work.needed[static_cast<std::size_t>(i)]) = out.row(i);
}

/// The side of each triangle; lists those that cross.
void find_sides(const Mesh& mesh, bool kink, Workspace& work) {
  work.crossing.clear();
  for (int i = 0; i < mesh.triangles.rows(); ++i) {
    int side = none;
    bool below = false, above = false;
    for (int j = 0; j < 3; ++j) {
      const int v = mesh.triangles(i, j);
      const double z = work.height[v];
      side |= z < work.surface(v, 0) ? wet : dry;
      below |= z < 0.0;
      above |= !(z < 0.0);
    }
    if (side == wet && kink && below && above)
      side = crossing;
    if (side == crossing)
      work.crossing.push_back(i);
    work.wet[static_cast<std::size_t>(i)] = static_cast<unsigned char>(side);
  }
}

/// Middles of the edges of triangles that are wet as a whole.
void add_edges(const Mesh& mesh, Workspace& work) {
  WetPoints& points = work.points;
  constexpr double third = 1.0 / 3.0;
  int n = 0;
  for (const Edge& edge : mesh.edges) {
    const bool left = work.wet[static_cast<std::size_t>(edge.left)] == wet;
    const bool right = work.wet[static_cast<std::size_t>(edge.right)] == wet;
    if (!left && !right)
      continue;
    const double a = left ? third : 0.0, b = right ? third : 0.0;
    for (int j = 0; j < 3; ++j) {
      points.x(n, j) = 0.5 * (work.place(edge.a, j) + work.place(edge.b, j));
      points.weight(n, j) = a * work.areas(edge.left, j) + b * work.areas(edge.right, j);
    }
    ++n;
  }
  points.size = n;
}

void reserve(WetPoints& points, int size) {
  if (size <= points.x.rows())
    return;
  const int capacity = size + size / 2;
  points.x.conservativeResize(capacity, 3);
  points.weight.conservativeResize(capacity, 3);
  points.height.resize(capacity);
  points.dynamic.resize(capacity);
  points.dynamic_gradient.resize(capacity, 3);
}

/// Points of a convex polygon: a fan of triangles about its first corner.
template <bool gradient>
void add_polygon(const Polygon& polygon, const Vector3& normal, Workspace& work) {
  if (polygon.size < 3)
    return;
  WetPoints& points = work.points;
  reserve(points, points.size + 3 * (polygon.size - 2));
  const int base = static_cast<int>(work.corners.size());
  if constexpr (gradient)
    work.corners.insert(work.corners.end(), polygon.corner.begin(),
                        polygon.corner.begin() + polygon.size);
  const auto corner = [&](int i) -> const Vector3& {
    return polygon.corner[static_cast<std::size_t>(i)].x;
  };
  for (int i = 1; i + 1 < polygon.size; ++i) {
    const Vector3 &a = corner(0), &b = corner(i), &c = corner(i + 1);
    const double area = 0.5 * dot<double>(normal, cross<double>(b - a, c - a));
    const Vector3 weight = (area / 3.0) * normal;
    const int n = points.size;
    for (int j = 0; j < 3; ++j) {
      points.x(n, j) = 0.5 * (a[j] + b[j]);
      points.x(n + 1, j) = 0.5 * (b[j] + c[j]);
      points.x(n + 2, j) = 0.5 * (c[j] + a[j]);
      points.weight(n, j) = points.weight(n + 1, j) = points.weight(n + 2, j) = weight[j];
    }
    if constexpr (gradient)
      work.facets.push_back({normal, n, {base, base + i, base + i + 1}});
    points.size += 3;
  }
}

/// The height above still water, with the sign of `side`, as the level of all corners.
template <bool gradient> void level_by_height(double position_z, double side, Polygon& polygon) {
  for (int i = 0; i < polygon.size; ++i) {
    Corner& c = polygon.corner[static_cast<std::size_t>(i)];
    c.level = side * (position_z + c.x[2]);
    if constexpr (gradient) {
      c.level_by_pose = carried({0.0, 0.0, side}, c.x);
      if (c.slides)
        c.level_by_pose += side * c.slide.row(2);
    }
  }
}

template <bool gradient>
void add_crossing(const Mesh& mesh, const Pose& pose, bool kink, Workspace& work) {
  Polygon whole, part, half;
  for (int i : work.crossing) {
    const Vector3 area = work.areas.row(i).transpose();
    const double size = area.norm();
    if (size == 0.0)
      continue;
    whole.size = 3;
    bool below = false, above = false;
    for (int j = 0; j < 3; ++j) {
      const int v = mesh.triangles(i, j);
      Corner& c = whole.corner[static_cast<std::size_t>(j)];
      c.x = work.place.row(v).transpose();
      c.level = work.height[v] - work.surface(v, 0);
      c.slides = false;
      below |= work.height[v] < 0.0;
      above |= !(work.height[v] < 0.0);
      if constexpr (gradient)
        c.level_by_pose = carried({-work.surface(v, 1), -work.surface(v, 2), 1.0}, c.x);
    }
    const Vector3 normal = area / size;
    clip<gradient>(whole, part);
    if (!(kink && below && above)) {
      add_polygon<gradient>(part, normal, work);
      continue;
    }
    for (double side : {1.0, -1.0}) {
      level_by_height<gradient>(pose.position[2], side, part);
      clip<gradient>(part, half);
      add_polygon<gradient>(half, normal, work);
    }
  }
}

} // namespace

Workspace::Workspace(const Mesh& mesh, const WaveField& field)
    : view(field.make_view()), place(mesh.vertices.rows(), 3), height(mesh.vertices.rows()),
      surface(Columns::Zero(mesh.vertices.rows(), 3)), areas(mesh.areas.rows(), 3),
      wet(static_cast<std::size_t>(mesh.triangles.rows())),
      is_needed(static_cast<std::size_t>(mesh.vertices.rows())),
      needed_place(mesh.vertices.rows(), 3), needed_surface(mesh.vertices.rows(), 3) {
  if (!field.still() && mesh.radius > field.reach())
    throw Error("the mesh reaches " + std::to_string(mesh.radius) +
                " m from the origin of its body, farther than its waves are prepared for (" +
                std::to_string(field.reach()) + " m)");
  needed.reserve(is_needed.size());
  crossing.reserve(wet.size());
  reserve(points, static_cast<int>(mesh.edges.size()));
}

void find_wet_surface(const Mesh& mesh, const WaveField& field, const Pose& pose,
                      const Instant& instant, bool slides, Workspace& work) {
  turn(mesh.vertices, pose.rotation, work.place);
  turn(mesh.areas, pose.rotation, work.areas);
  work.height = work.place.col(2) + pose.position[2];
  // Without waves the pressure is linear on both sides of z = 0.
  const bool kink = !field.still() && field.water().stretching == Stretching::vertical;
  if (!field.still()) {
    field.look(instant, pose.position, work.view, slides);
    find_elevations(mesh, field, slides, work);
  }
  find_sides(mesh, kink, work);
  add_edges(mesh, work);
  work.facets.clear();
  work.corners.clear();
  if (slides)
    add_crossing<true>(mesh, pose, kink, work);
  else
    add_crossing<false>(mesh, pose, kink, work);
  work.points.height = work.points.x.col(2) + pose.position[2];
}

} // namespace hydrodae::hull
