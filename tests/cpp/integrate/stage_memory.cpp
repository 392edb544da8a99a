/// The radiation memory at all stages, eliminated by hand, against the whole Jacobians.

#include "hydrodae/integrate/stage_memory.h"
#include "hydrodae/build/build.h"
#include "hydrodae/integrate/runge_kutta.h"
#include "hydrodae/system/history.h"

#include <doctest/doctest.h>

#include "../../property/scenes.h"

namespace {

using namespace hydrodae;

MatrixX dense(const system::Pattern& p, const std::vector<double>& values) {
  MatrixX out = MatrixX::Zero(p.n, p.n);
  for (Index c = 0; c < p.n; ++c)
    for (Index k = p.column_start[static_cast<std::size_t>(c)];
         k < p.column_start[static_cast<std::size_t>(c) + 1]; ++k)
      out(p.row[static_cast<std::size_t>(k)], c) = values[static_cast<std::size_t>(k)];
  return out;
}

/// Increments of the bodies at random: those of the states, and what these load the bodies with.
void compare(const system::Regime& s, const integrate::RungeKutta& rk, test::Random& random) {
  constexpr double h = 0.03;
  const system::Pattern whole = system::find_pattern(s), less = linalg::condensed(s, whole);
  const Index stages = rk.stages, first = s.hydro.z0, n_states = s.hydro.n_states();
  system::JacobianWorkspace ws(s);
  system::JacobianParts all(whole), some(less);
  integrate::StageMemory memory(s);
  std::vector<MatrixX> by_y, by_yp;
  for (Index i = 0; i < stages; ++i) {
    const VectorX y = test::random_state(s, random), yp = VectorX::Zero(s.n);
    system::jacobian(s, whole, ws, 0.7, y.data(), yp.data(), all);
    system::jacobian(s, less, ws, 0.7, y.data(), yp.data(), some);
    memory.take(static_cast<std::size_t>(i), some);
    by_y.push_back(dense(whole, all.by_y));
    by_yp.push_back(dense(whole, all.by_yp));
  }
  memory.prepare(rk.a_inverse, h);
  MatrixX right(s.n, stages), change(s.n, stages);
  for (Index k = 0; k < right.size(); ++k) {
    right.data()[k] = random();
    change.data()[k] = random();
  }
  MatrixX left = right;
  memory.forward(left);
  memory.backward(change);
  for (Index i = 0; i < stages; ++i) {
    VectorX rows = by_y[static_cast<std::size_t>(i)] * change.col(i);
    for (Index j = 0; j < stages; ++j)
      rows += rk.a_inverse(i, j) / h * (by_yp[static_cast<std::size_t>(i)] * change.col(j));
    const VectorX missing = rows.segment(first, n_states) - right.col(i).segment(first, n_states);
    CHECK(missing.cwiseAbs().maxCoeff() < 1e-9 * (1.0 + rows.cwiseAbs().maxCoeff()));
    VectorX load = right.col(i) - left.col(i);
    load.segment(first, n_states).setZero();
    for (Index j = 0; j < stages; ++j) {
      std::vector<std::pair<Index, Index>> places;
      linalg::for_each_memory_entry(s, [&](Index row, Index column, std::size_t, int, std::size_t,
                                           int) { places.emplace_back(row, column); });
      memory.for_each_load(i, j, stages, [&](std::size_t k, double value) {
        load[places[k].first] += value * change(places[k].second, j);
      });
    }
    const VectorX exact = by_y[static_cast<std::size_t>(i)].middleCols(first, n_states) *
                          change.col(i).segment(first, n_states);
    const VectorX off = (load - exact).segment(s.u0, s.n_u);
    CHECK(off.cwiseAbs().maxCoeff() < 1e-9 * (1.0 + exact.cwiseAbs().maxCoeff()));
  }
}

} // namespace

TEST_CASE("memory states at all stages follow from the bodies, and load them as they do") {
  const integrate::RungeKutta rk = integrate::make_runge_kutta(integrate::Family::radau_iia, 3);
  test::Random random;
  int compared = 0;
  for (const test::NamedScene& named : test::all_scenes()) {
    system::System built = build::build(named.scene);
    if (!built.has_memory() || system::has_past(built))
      continue;
    CAPTURE(named.name);
    test::turn_mean_axes(built);
    compare(system::Regime(built), rk, random);
    ++compared;
  }
  CHECK(compared > 20);
}
