/// The load of every kind of joint row on body B, against closed forms and the power of the row.

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <random>

#include "hydrodae/joint/basic.h"

using namespace hydrodae;
using namespace hydrodae::joint;

namespace {

const Parameters parameters{0.8, 0.3};

/// Random markers and poses. The axes z of both markers can be drawn parallel, as the other rows of
/// a screw joint hold them.
struct Draw {
  std::mt19937 engine{7};
  Marker A, B;
  Vector3 r_A, r_B;
  Matrix3 R_A, R_B;
  Geometry<double> g;

  Draw() {
    A.body = 0;
    B.body = 1;
  }
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine); }
  Vector3 vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  Matrix3 rotation() {
    return rotation_matrix<double>(quaternion_from_rotation_vector(2.0 * vector()));
  }

  void next(bool parallel) {
    A.point = vector();
    B.point = vector();
    A.axes = rotation();
    B.axes = rotation();
    r_A = vector();
    r_B = r_A + 0.5 * vector();
    R_A = rotation();
    R_B = rotation();
    if (parallel) {
      const Vector3 turn(0.0, 0.0, 3.0 * number());
      R_B = R_A * A.axes * rotation_matrix<double>(quaternion_from_rotation_vector(turn)) *
            B.axes.transpose();
    }
    std::vector<Vector3> points;
    for (int k = 0; k < 9; ++k)
      points.push_back(A.point + A.axes * Vector3(k - 4.0, 0.1 * number(), 0.1 * number()));
    A.path = std::make_shared<const Path>(points);
    g = geometry<double>(B, r_A, R_A, r_B, R_B);
  }
  Vector3 a(int i) const { return R_A * A.axes.col(i); }
  Vector3 b(int i) const { return R_B * B.axes.col(i); }
  Vector3 parting() const { return r_B + R_B * B.point - r_A - R_A * A.point; }
};

/// Force and moment about the origin of marker B in world axes; empty for a kind without a closed
/// form here.
struct ClosedForm {
  const Draw& at;
  using Load = std::optional<std::pair<Vector3, Vector3>>;

  static Load force(const Vector3& f) { return std::pair{f, Vector3(Vector3::Zero())}; }
  Load operator()(const SpanRow& row) const { return force(at.a(row.i)); }
  Load operator()(const PerpRow& row) const {
    return std::pair{Vector3(Vector3::Zero()), Vector3(at.b(row.j).cross(at.a(row.i)))};
  }
  Load operator()(const DistanceRow&) const { return force(at.parting() / parameters.length); }
  Load operator()(const AcrossRow& row) const {
    return force(at.R_A * at.A.path->across<double>(row.i, at.g.e).gradient);
  }
  Load operator()(const ScrewRow&) const {
    return std::pair{at.a(Z), Vector3(-parameters.pitch / (2.0 * pi) * at.a(Z))};
  }
  template <class Other> Load operator()(const Other&) const { return std::nullopt; }
};

std::vector<BasicRow> all_rows() {
  std::vector<BasicRow> rows;
  for (const JointType& type : joint_types())
    rows.insert(rows.end(), type.rows.begin(), type.rows.end());
  return rows;
}

} // namespace

TEST_CASE("the reaction of a row from its gradient is its closed form") {
  Draw at;
  for (const BasicRow& row : all_rows())
    for (int sample = 0; sample < 20; ++sample) {
      CAPTURE(row_name(row));
      at.next(std::holds_alternative<ScrewRow>(row));
      const Vector12 G = basic_row<double>(row, at.A, at.B, parameters, at.g).gradient;
      const double lambda = 100.0 * at.number();
      const Vector6 load = reaction(lambda * G, at.A, at.B, at.g);
      const auto closed = std::visit(ClosedForm{at}, row);
      if (!closed)
        continue;
      const Matrix3 to_marker = (at.R_A * at.A.axes).transpose();
      CHECK((load.head<3>() - lambda * (to_marker * closed->first)).norm() < 1e-12);
      CHECK((load.tail<3>() - lambda * (to_marker * closed->second)).norm() < 1e-12);
    }
}

TEST_CASE("the reaction of a row on body B works as the row changes with the motion of body B") {
  Draw at;
  for (const BasicRow& row : all_rows())
    for (int sample = 0; sample < 20; ++sample) {
      CAPTURE(row_name(row));
      at.next(false);
      const Vector3 v = at.vector(), w = at.vector(); // of the centre; w in body axes
      Vector12 u = Vector12::Zero();
      u << Vector3::Zero(), Vector3::Zero(), v, w;
      const Vector12 G = basic_row<double>(row, at.A, at.B, parameters, at.g).gradient;
      const Vector6 load = reaction(G, at.A, at.B, at.g);
      const Matrix3 to_world = at.R_A * at.A.axes;
      const Vector3 of_marker = v + at.R_B * w.cross(at.B.point);
      const double power =
          (to_world * load.head<3>()).dot(of_marker) + (to_world * load.tail<3>()).dot(at.R_B * w);
      CHECK(power == doctest::Approx(G.dot(u)).epsilon(1e-12));
    }
}
