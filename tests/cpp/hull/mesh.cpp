/// Checks of a mesh, and the volume of bodies.

#include "hydrodae/hull/mesh.h"

#include <doctest/doctest.h>

#include "hull/meshes.h"
#include "hydrodae/core/error.h"

namespace hydrodae::test_hull_mesh {

namespace {

std::string complaint(const tests::MeshArrays& arrays) {
  try {
    arrays.mesh();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Two boxes; the second with its middle and half of its edges given, and its normals reversed
/// where `inwards`.
tests::MeshArrays boxes(const Vector3& middle, const Vector3& half, bool inwards = false) {
  tests::MeshArrays out = tests::box(2.0, 2.0, 2.0), other = tests::box(2.0, 2.0, 2.0);
  for (const Vector3& v : other.vertices)
    out.vertices.push_back(middle + half.cwiseProduct(v));
  for (auto [a, b, c] : other.triangles)
    out.triangles.push_back(inwards ? std::array{b + 8, a + 8, c + 8}
                                    : std::array{a + 8, b + 8, c + 8});
  return out;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a box: volume, centroid, area, edges, wherever its axes are") {
  tests::MeshArrays arrays = tests::box(2.0, 3.0, 4.0);
  const Vector3 shift(1e3, -2e3, 7.0);
  for (Vector3& v : arrays.vertices)
    v += shift;
  const hull::Mesh mesh = arrays.mesh();
  CHECK(mesh.volume == doctest::Approx(24.0).epsilon(1e-12));
  CHECK((mesh.centroid - shift).norm() < 1e-11);
  CHECK(mesh.area == doctest::Approx(52.0));
  CHECK(mesh.edges.size() == 18);
  CHECK(mesh.shells == 1);
  CHECK(mesh.degenerate == 0);
  CHECK(mesh.areas.colwise().sum().matrix().norm() < 1e-12);
}

TEST_CASE("a mesh encloses the points inside it, and no others") {
  tests::MeshArrays arrays = tests::box(2.0, 3.0, 4.0);
  const Vector3 shift(1e3, -2e3, 7.0);
  for (Vector3& v : arrays.vertices)
    v += shift;
  const hull::Mesh mesh = arrays.mesh();
  const Vector3 middle = mesh.centroid;
  for (const double part : {0.0, 0.5, 0.999, 1.001, 2.0, 100.0})
    for (int c = 0; c < 3; ++c)
      for (const double sign : {-1.0, 1.0}) {
        Vector3 point = middle;
        point[c] += sign * part * 0.5 * (2.0 + c);
        CHECK(hull::encloses(mesh, point) == (part < 1.0));
      }
  // in one of two shells, and between them
  tests::MeshArrays two = tests::box(1.0, 1.0, 1.0), other = tests::box(1.0, 1.0, 1.0);
  for (const Vector3& v : other.vertices)
    two.vertices.push_back(v + Vector3(5.0, 0.0, 0.0));
  for (auto [a, b, c] : other.triangles)
    two.triangles.push_back({a + 8, b + 8, c + 8});
  const hull::Mesh pair = two.mesh();
  CHECK(hull::encloses(pair, Vector3(5.0, 0.0, 0.0)));
  CHECK_FALSE(hull::encloses(pair, Vector3(2.5, 0.0, 0.0)));
}

TEST_CASE("two bodies in one mesh are two shells, and a triangle without area is counted") {
  tests::MeshArrays arrays = tests::box(1.0, 1.0, 1.0), other = tests::sphere(1.0, 1);
  for (const Vector3& v : other.vertices)
    arrays.vertices.push_back(v + Vector3(5.0, 0.0, 0.0));
  for (auto [a, b, c] : other.triangles)
    arrays.triangles.push_back({a + 8, b + 8, c + 8});
  CHECK(arrays.mesh().shells == 2);
  // A vertex on the edge of two triangles, joined to one of them by a triangle without area.
  tests::MeshArrays flat = tests::box(1.0, 1.0, 1.0);
  const auto [a, b, c] = flat.triangles[0];
  flat.vertices.push_back(0.5 * (flat.vertices[std::size_t(a)] + flat.vertices[std::size_t(c)]));
  flat.triangles[0] = {a, b, 8};
  flat.triangles.push_back({b, c, 8});
  flat.triangles.push_back({a, 8, c});
  const hull::Mesh mesh = flat.mesh();
  CHECK(mesh.degenerate == 1);
  CHECK(mesh.volume == doctest::Approx(1.0));
}

TEST_CASE("a bad mesh is refused by the name of its fault") {
  tests::MeshArrays open = tests::box(1.0, 1.0, 1.0);
  open.triangles.pop_back();
  CHECK(contains(complaint(open), "not closed"));
  tests::MeshArrays crossed = tests::box(1.0, 1.0, 1.0);
  std::swap(crossed.triangles[3][0], crossed.triangles[3][1]);
  CHECK(contains(complaint(crossed), "same direction"));
  tests::MeshArrays inward = tests::box(1.0, 1.0, 1.0);
  for (auto& triangle : inward.triangles)
    std::swap(triangle[0], triangle[1]);
  CHECK(contains(complaint(inward), "point inwards"));
  tests::MeshArrays missing = tests::box(1.0, 1.0, 1.0);
  missing.triangles[2][1] = 8;
  CHECK(contains(complaint(missing), "triangle 2 "));
  tests::MeshArrays endless = tests::box(1.0, 1.0, 1.0);
  for (const double far : {double(NAN), 1e308, -1e61, double(INFINITY)}) {
    endless.vertices[4][2] = far;
    CHECK(contains(complaint(endless), "vertex 4 "));
  }
  CHECK(contains(complaint({}), "no triangles"));
}

TEST_CASE("no volume counts twice: shells cross, or one is inside another") {
  const Vector3 one = Vector3::Ones();
  for (const double size : {1e-3, 1.0, 1e3}) {
    const auto said = [&](const Vector3& middle, const Vector3& half, bool inwards = false) {
      tests::MeshArrays arrays = boxes(middle, half, inwards);
      for (Vector3& v : arrays.vertices)
        v = size * v + Vector3(3.0, 0.0, -7.0);
      return complaint(arrays);
    };
    // Corner in corner, a rod through, a cross, faces in one plane, and their tessellations alike.
    for (const auto& [middle, half] : {std::pair{Vector3(1.0, 1.0, 1.0), one},
                                       {Vector3(0.0, 0.0, 0.0), Vector3(0.1, 0.1, 5.0)},
                                       {Vector3(0.3, 0.2, 0.0), Vector3(3.0, 0.3, 0.3)},
                                       {Vector3(1.0, 0.0, 0.0), one},
                                       {Vector3(0.0, 0.0, 1.9), one}})
      CHECK(contains(said(middle, half), "count twice"));
    for (const bool inwards : {false, true}) {
      CHECK(contains(said(Vector3(0.2, 0.1, 0.0), 0.5 * one, inwards), "lies inside"));
      CHECK(contains(said(Vector3(0.0, 0.0, 0.5), 0.5 * one, inwards), "lies inside"));
    }
    CHECK(contains(said(Vector3(4.0, 0.0, 0.0), one, true), "point inwards"));
    // Apart, face to face, edge to edge, and with a gap or an overlap that a tessellation leaves.
    for (const double x : {4.0, 2.0, 2.001, 1.999})
      for (const double y : {0.0, 0.5, 2.0})
        CHECK(said(Vector3(x, y, 0.0), one) == "");
    CHECK(said(Vector3(0.0, 0.0, 1.5), Vector3(0.2, 0.2, 0.5)) == ""); // a column on the deck
  }
  tests::MeshArrays same = boxes(Vector3::Zero(), one);
  CHECK(contains(complaint(same), "lies inside"));
}

} // namespace hydrodae::test_hull_mesh
