/// Newton's matrix with the radiation memory and velocities of points eliminated, against the whole
/// one.

#include "hydrodae/linalg/newton_matrix.h"
#include "hydrodae/build/build.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <complex>

#include "../../property/scenes.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/jacobian.h"

namespace {

using namespace hydrodae;
using Complex = std::complex<double>;

template <class Scalar>
void compare(const system::Regime& s, Scalar alpha, const VectorX& y, const VectorX& yp) {
  const system::Pattern whole = system::find_pattern(s), less = linalg::condensed(s, whole);
  system::JacobianWorkspace ws(s);
  system::JacobianParts all(whole), some(less);
  system::jacobian(s, whole, ws, 0.7, y.data(), yp.data(), all);
  system::jacobian(s, less, ws, 0.7, y.data(), yp.data(), some);
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> dense(s.n, s.n);
  dense.setZero();
  for (Index c = 0; c < s.n; ++c)
    for (Index k = whole.column_start[c]; k < whole.column_start[c + 1]; ++k)
      dense(whole.row[static_cast<std::size_t>(k)], c) +=
          all.by_y[static_cast<std::size_t>(k)] + alpha * all.by_yp[static_cast<std::size_t>(k)];
  linalg::NewtonMatrix<Scalar> newton(s, less);
  REQUIRE(newton.factorise(some, alpha));
  VecX<Scalar> b(s.n);
  for (Index i = 0; i < s.n; ++i)
    b[i] = Scalar(std::sin(1.0 + 3.0 * static_cast<double>(i)));
  VecX<Scalar> x = b;
  newton.solve(x.data());
  const VecX<Scalar> missing = dense * x - b;
  const double size = (dense.cwiseAbs() * x.cwiseAbs()).maxCoeff();
  CHECK(missing.cwiseAbs().maxCoeff() < 1e-11 * size);
}

} // namespace

TEST_CASE(
    "Newton's matrix without memory states and velocities of points solves the whole system") {
  test::Random random;
  int with_memory = 0, with_points = 0;
  for (const test::NamedScene& named : test::all_scenes()) {
    system::System built = build::build(named.scene);
    const bool points = std::any_of(built.blocks.begin(), built.blocks.end(),
                                    [](const system::Block& b) { return b.moves && b.body < 0; });
    if ((!built.has_memory() && !points) || system::has_past(built))
      continue;
    CAPTURE(named.name);
    test::turn_mean_axes(built);
    const system::Regime s(built);
    const VectorX y = test::random_state(s, random);
    VectorX yp(s.n);
    for (Index i = 0; i < s.n; ++i)
      yp[i] = random();
    compare<double>(s, 37.0, y, yp);
    compare<Complex>(s, {21.0, 14.0}, y, yp);
    with_memory += built.has_memory() ? 1 : 0;
    with_points += points ? 1 : 0;
  }
  CHECK(with_memory > 20);
  CHECK(with_points > 2);
}
