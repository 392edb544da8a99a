/// The hand-written Jacobian against dual numbers, block by block, on every scene of the type
/// lists.

#include <doctest/doctest.h>

#include "hydrodae/build/build.h"
#include "hydrodae/math/dual.h"
#include "hydrodae/system/jacobian.h"
#include "hydrodae/system/residual.h"
#include "scenes.h"

namespace {

using namespace hydrodae;
using system::Regime;
using system::System;

constexpr double instant = 0.7; // of a wave that is neither at its crest nor at its trough [s]

/// Exact derivative of the residual along unknown `column` of y or of y'.
VectorX derivative(const Regime& s, const VectorX& y, const VectorX& yp, Index column, bool by_yp) {
  VecX<Dual> dy = y.cast<Dual>(), dyp = yp.cast<Dual>(), r(s.n);
  (by_yp ? dyp : dy)[column].b = 1.0;
  system::Workspace<Dual> ws(s);
  system::residual<Dual>(s, ws, instant, dy.data(), dyp.data(), r.data());
  VectorX d(s.n);
  for (Index i = 0; i < s.n; ++i)
    d[i] = r[i].b;
  return d;
}

/// Largest error of all columns by y and y'.
void require_exact(const Regime& s, const VectorX& y, const VectorX& yp, const MatrixX& by_y,
                   const MatrixX& by_yp) {
  for (Index c = 0; c < s.n; ++c) {
    CAPTURE(s.names[c]);
    for (bool rates : {false, true}) {
      const VectorX exact = derivative(s, y, yp, c, rates);
      const VectorX ours = (rates ? by_yp : by_y).col(c);
      Index worst = 0;
      const double error =
          ((ours - exact).array().abs() / (1.0 + exact.array().abs())).maxCoeff(&worst);
      CAPTURE(s.row_names[worst]);
      CAPTURE(ours[worst]);
      CAPTURE(exact[worst]);
      REQUIRE(error < 1e-9);
    }
  }
}

/// Winds all rotations that laws see up by a turn.
void wind_up(Regime& s, const VectorX& y, const VectorX& yp) {
  system::Workspace<double> ws(s);
  system::unpack<double>(s, y.data(), yp.data(), ws.bodies);
  for (std::size_t r = 0; r < s.system.rotations.size(); ++r) {
    const Vector3 vector = system::rotation_of<double>(s, ws, static_cast<int>(r));
    Eigen::Map<Vector3>(s.nearby.data() + s.motions.size() + 3 * r) =
        vector + 2.0 * pi * vector.normalized();
  }
}

} // namespace

TEST_CASE("the Jacobian is exact beyond half a turn") {
  test::Random random;
  int wound = 0;
  for (const test::NamedScene& named : test::all_scenes()) {
    CAPTURE(named.name);
    const System built = build::build(named.scene);
    Regime s(built);
    const auto history = test::random_history(s, random, instant);
    const VectorX y = test::random_state(s, random);
    const VectorX yp = VectorX::NullaryExpr(s.n, [&] { return random(); });
    wind_up(s, y, yp);
    system::Workspace<double> ws(s);
    system::unpack<double>(s, y.data(), yp.data(), ws.bodies);
    for (const system::ElementList& list : s.elements)
      for (const system::PortData& port : list.ports)
        if (port.followed >= 0) {
          REQUIRE(system::rotation_of<double>(s, ws, port.followed).norm() > pi);
          ++wound;
        }
    const system::Pattern pattern = system::find_pattern(s);
    system::JacobianWorkspace scratch(s);
    system::JacobianParts parts(pattern);
    system::jacobian(s, pattern, scratch, instant, y.data(), yp.data(), parts);
    require_exact(s, y, yp, test::dense(pattern, parts.by_y), test::dense(pattern, parts.by_yp));
  }
  CHECK(wound > 100);
}

TEST_CASE("the Jacobian is exact in all blocks") {
  test::Random random;
  int scenes = 0;
  for (const test::NamedScene& named : test::all_scenes()) {
    CAPTURE(named.name);
    System built = build::build(named.scene);
    test::turn_mean_axes(built);
    Regime s(built);
    const auto history = test::random_history(s, random, instant);
    const system::Pattern pattern = system::find_pattern(s);
    const VectorX y = test::random_state(s, random);
    VectorX yp(s.n);
    for (Index i = 0; i < s.n; ++i)
      yp[i] = random();
    system::JacobianWorkspace ws(s);
    system::JacobianParts parts(pattern);
    system::jacobian(s, pattern, ws, instant, y.data(), yp.data(), parts);
    const MatrixX by_y = test::dense(pattern, parts.by_y),
                  by_yp = test::dense(pattern, parts.by_yp);
    require_exact(s, y, yp, by_y, by_yp);
    // The part for accelerations: its blocks of the same values.
    const system::Pattern part = system::find_pattern(s, system::Part::accelerations);
    REQUIRE(part.nonzeros() <= pattern.nonzeros());
    system::JacobianParts small(part);
    system::jacobian(s, part, ws, instant, y.data(), yp.data(), small);
    // The mass matrix is kept where the poses are those of the calls before, and made again
    // elsewhere.
    const std::vector<double> first = small.by_yp;
    for (int again = 0; again < 2; ++again) {
      system::jacobian(s, part, ws, instant, y.data(), yp.data(), small);
      REQUIRE(small.by_yp == first);
    }
    const VectorX moved = test::random_state(s, random);
    system::JacobianParts fresh(part);
    system::jacobian(s, part, ws, instant, moved.data(), yp.data(), fresh);
    system::jacobian(s, part, ws, instant, moved.data(), yp.data(), small);
    REQUIRE(small.by_yp == fresh.by_yp);
    system::jacobian(s, part, ws, instant, y.data(), yp.data(), small);
    const MatrixX small_y = test::dense(part, small.by_y),
                  small_yp = test::dense(part, small.by_yp);
    const auto difference = [&](const MatrixX& ours, const MatrixX& all, Index row, Index column,
                                Index rows, Index columns) {
      const auto block = all.block(row, column, rows, columns).array();
      return ((ours.block(row, column, rows, columns).array() - block).abs() / (1.0 + block.abs()))
          .sum();
    };
    REQUIRE(difference(small_yp, by_yp, s.u0, s.u0, s.n_u, s.n_u) < 1e-12);
    REQUIRE(difference(small_y, by_y, s.lambda0, s.u0, s.n_lambda, s.n_u) < 1e-12);
    // (dG/dt) u by the derivatives of the velocity rows, with q' = E u.
    VectorX free = y, residual(s.n);
    free.tail(s.n - s.lambda0).setZero();
    system::Workspace<double> workspace(s);
    system::residual<double>(s, workspace, instant, free.data(), VectorX::Zero(s.n).eval().data(),
                             residual.data());
    const MatrixX by_q = by_y.block(s.lambda0, 0, s.n_lambda, s.n_q);
    const VectorX rates = by_q * -residual.head(s.n_q);
    REQUIRE((rates - small.row_rates).norm() <= 1e-12 * (1.0 + rates.norm() + by_q.norm()));
    VectorX rest = VectorX::Zero(s.n);
    system::free_residual<double>(s, workspace, instant, free.data(),
                                  VectorX::Zero(s.n).eval().data(), rest.data());
    REQUIRE((rest - residual).head(s.lambda0).norm() <= 1e-12 * residual.norm());
    // Friction that a reaction presses is beside the gradients there.
    const bool pressed = std::any_of(s.elements.begin(), s.elements.end(), [](const auto& list) {
      return list.laws->shape.n_reaction > 0;
    });
    REQUIRE((pressed || difference(small_y, by_y, s.u0, s.lambda0, s.n_u, s.n_lambda) < 1e-12));
    ++scenes;
  }
  CHECK(scenes >= 3 * static_cast<int>(joint::joint_types().size()));
}
