/// Every row of the joint table: gradient, curvature, rank, no work by reactions, and no dependence
/// on where the scene lies.

#include <doctest/doctest.h>

#include "hydrodae/joint/basic.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/math/dual.h"
#include "scenes.h"

namespace {

using namespace hydrodae;
using namespace hydrodae::joint;

const Parameters parameters{0.8, 0.3};

struct Poses {
  Vector3 r_A, r_B;
  Matrix3 R_A, R_B;
};

Matrix3 random_rotation(test::Random& random) {
  return rotation_matrix<double>(Vector4(random(), random(), random(), random()));
}

Poses random_poses(test::Random& random) {
  return {random.vector(), random.vector(), random_rotation(random), random_rotation(random)};
}

/// Markers with random places and axes on both bodies.
std::pair<Marker, Marker> random_markers(test::Random& random) {
  // A curve of gentle bends: random points lie within its radius of curvature.
  Vector3 point = random.vector();
  const Matrix3 turn = random_rotation(random);
  std::vector<Vector3> points;
  for (int k = 0; k < 9; ++k)
    points.push_back(point + turn * Vector3(k - 4.0, 0.1 * random(), 0.1 * random()));
  const auto path = std::make_shared<const Path>(points);
  return {Marker{0, point, random_rotation(random), path},
          Marker{1, random.vector(), random_rotation(random), nullptr}};
}

Geometry<double> seen(const Marker& B, const Poses& p) {
  return geometry<double>(B, p.r_A, p.R_A, p.r_B, p.R_B);
}

/// Geometry moved along xi_n by a dual unit.
Geometry<Dual> dual_geometry(const Marker& B, const Poses& p, int n) {
  Vec3<Dual> r_A = p.r_A.cast<Dual>(), r_B = p.r_B.cast<Dual>(), phi[2];
  phi[0].setZero();
  phi[1].setZero();
  (n < 3 ? r_A[n] : n < 6 ? phi[0][n - 3] : n < 9 ? r_B[n - 6] : phi[1][n - 9]).b = 1.0;
  const Mat3<Dual> one = Mat3<Dual>::Identity();
  const Mat3<Dual> R_A = p.R_A.cast<Dual>() * (one + skew<Dual>(phi[0]));
  const Mat3<Dual> R_B = p.R_B.cast<Dual>() * (one + skew<Dual>(phi[1]));
  return geometry<Dual>(B, r_A, R_A, r_B, R_B);
}

/// A pose of B that closes the joint at a random pose of A and random values of the free motions.
Poses closed_poses(const JointType& type, const Marker& A, const Marker& B, test::Random& random) {
  Poses p = random_poses(random);
  // Newton's method with minimum-norm corrections from a nearly closed guess.
  p.R_B = p.R_A * A.axes * B.axes.transpose();
  p.r_B = p.r_A + p.R_A * A.point - p.R_B * B.point + 0.2 * random.vector();
  p.R_B = p.R_B * rotation_matrix<double>(quaternion_from_rotation_vector(0.3 * random.vector()));
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Geometry<double> g = seen(B, p);
    MatrixX G(type.rows.size(), 12);
    VectorX value(type.rows.size());
    for (std::size_t k = 0; k < type.rows.size(); ++k) {
      const Row<double> row = basic_row<double>(type.rows[k], A, B, parameters, g);
      G.row(static_cast<Eigen::Index>(k)) = row.gradient.transpose();
      value[static_cast<Eigen::Index>(k)] = row.value;
    }
    const VectorX step = -minimum_norm(G, value);
    p.r_A += step.segment<3>(0);
    p.r_B += step.segment<3>(6);
    p.R_A = p.R_A * rotation_matrix<double>(quaternion_from_rotation_vector(step.segment<3>(3)));
    p.R_B = p.R_B * rotation_matrix<double>(quaternion_from_rotation_vector(step.segment<3>(9)));
    if (value.norm() < 1e-14)
      break;
  }
  return p;
}

} // namespace

TEST_CASE("gradients and curvatures of all rows and motions are exact") {
  test::Random random;
  for (const JointType& type : joint_types()) {
    CAPTURE(type.name);
    const auto [A, B] = random_markers(random);
    const Poses p = random_poses(random);
    const Geometry<double> g = seen(B, p);
    auto check = [&](auto row_of, const Matrix12& curvature) {
      const Row<double> row = row_of(g);
      for (int n = 0; n < 12; ++n) {
        const Row<Dual> moved = row_of(dual_geometry(B, p, n));
        CHECK(moved.value.b == doctest::Approx(row.gradient[n]).epsilon(1e-12));
        for (int m = 0; m < 12; ++m)
          CHECK(std::abs(moved.gradient[m].b - curvature(m, n)) < 1e-12 * (1 + curvature.norm()));
      }
    };
    for (const BasicRow& kind : type.rows)
      check([&](const auto& at) { return basic_row(kind, A, B, parameters, at); },
            basic_curvature(kind, A, B, parameters, g));
    for (const FreeMotion& motion : type.motions)
      check([&](const auto& at) { return motion_row(motion, A, B, at); },
            motion_curvature(motion, A, B, g));
  }
}

TEST_CASE("on closed poses the rows are independent and leave exactly the named motions free") {
  test::Random random;
  for (const JointType& type : joint_types()) {
    CAPTURE(type.name);
    for (int sample = 0; sample < 100; ++sample) {
      const auto [A, B] = random_markers(random);
      const Poses p = closed_poses(type, A, B, random);
      const Geometry<double> g = seen(B, p);
      const auto rows = static_cast<Eigen::Index>(type.rows.size());
      if (rows == 0)
        continue;
      MatrixX G(rows, 12);
      for (Eigen::Index k = 0; k < rows; ++k) {
        const Row<double> row = basic_row<double>(type.rows[k], A, B, parameters, g);
        REQUIRE(std::abs(row.value) < 1e-10);
        G.row(k) = row.gradient.transpose();
      }
      const VectorX squares = symmetric_eigenvalues(G * G.transpose()); // of singular values
      CHECK(squares[0] > 0.05 * 0.05 * squares[rows - 1]);
      // A named motion is free: the joint's rows and the motion together have full rank, and moving
      // along it alone (B against A, in the null space of G) keeps the joint closed.
      for (const FreeMotion& motion : type.motions) {
        MatrixX all(rows + 1, 12);
        all << G, motion_row<double>(motion, A, B, g).gradient.transpose();
        CHECK(symmetric_eigenvalues(all * all.transpose())[0] > 0.02 * 0.02);
      }
    }
  }
}

TEST_CASE("reactions do no work on velocities that keep the joint, and add up to nothing") {
  test::Random random;
  for (const JointType& type : joint_types()) {
    CAPTURE(type.name);
    const auto [A, B] = random_markers(random);
    const Poses p = random_poses(random);
    const Geometry<double> g = seen(B, p);
    for (const BasicRow& kind : type.rows) {
      const Vector12 G = basic_row<double>(kind, A, B, parameters, g).gradient;
      // A rigid motion of both bodies together (translation V, rotation W about the origin).
      const Vector3 V = random.vector(), W = random.vector();
      Vector12 u;
      u << V + W.cross(p.r_A), p.R_A.transpose() * W, V + W.cross(p.r_B), p.R_B.transpose() * W;
      CHECK(std::abs(G.dot(u)) < 1e-13 * (1.0 + G.norm() * u.norm()));
      CHECK((G.segment<3>(0) + G.segment<3>(6)).norm() < 1e-14);
    }
  }
}

TEST_CASE("rows do not depend on where the scene lies and how it is turned") {
  test::Random random;
  for (const JointType& type : joint_types()) {
    CAPTURE(type.name);
    const auto [A, B] = random_markers(random);
    const Poses p = random_poses(random);
    const Matrix3 Q = random_rotation(random);
    const Vector3 shift = 100.0 * random.vector();
    const Poses moved{Q * p.r_A + shift, Q * p.r_B + shift, Q * p.R_A, Q * p.R_B};
    for (const BasicRow& kind : type.rows) {
      const double here = basic_row<double>(kind, A, B, parameters, seen(B, p)).value;
      const double there = basic_row<double>(kind, A, B, parameters, seen(B, moved)).value;
      CHECK(here == doctest::Approx(there).epsilon(1e-11));
    }
  }
}
