/// The loops over the nodes of a line, on numbers and on dual numbers: all that a line can have,
/// and numbers of nodes that fill registers and do not.

#include "hydrodae/line/line_table.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

namespace {

using namespace hydrodae;

constexpr double depth = 50.0, length = 4.0;

line::LineModel random_line(int n, bool bends, bool free_end, int options) {
  line::LineModel m;
  m.wet = true;
  m.bends = bends;
  m.free_end = free_end;
  m.bed = -depth;
  m.damps_slack = (options & 1) != 0;
  m.bed_damps_up = (options & 2) != 0;
  for (int k = 0; k < n; ++k)
    m.segments.push_back({length + 0.01 * k, 5e5, 4e3, 1e-5 + 1e-7 * k});
  for (int i = 0; i <= n; ++i) {
    line::LineNode q;
    q.mass = 40.0 + i;
    q.bending = bends && i > 0 && i < n ? 1e3 : 0.0;
    q.line = {2.0, 0.02, 100.0 + i, 10.0, 9.0, 4.0, 1.0};
    q.lift = 50.0;
    q.displaced = 5.0;
    q.bed_stiffness = 1e5;
    q.bed_damping = 1e4;
    q.bed_width = 0.01;
    q.friction = 0.3;
    q.axis_height = 0.1;
    if ((options & 4) != 0 && i % 3 == 1) {
      q.body = {0.0, 0.5, 300.0, 0.0, 700.0, 250.0, 0.0};
      q.body_lift = 5e3;
    }
    m.nodes.push_back(q);
  }
  return m;
}

} // namespace

TEST_CASE("a line has the same forces on numbers and on dual numbers, as node by node") {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> random(-1.0, 1.0);
  for (int run = 0; run < 256; ++run) {
    CAPTURE(run);
    const int n = 2 + run % 17;
    const line::LineModel m = random_line(n, (run & 1) != 0, (run & 2) != 0, run >> 2);
    const int parted = (run & 32) != 0 ? run % n : -1;
    sea::WaveField sea;
    sea.depth = depth;
    sea.current = Vector3(0.3, 0.1, 0.0);
    if ((run & 64) != 0)
      sea.terms.push_back({0.6, 0.04, 0.3, 0.8, 0.6, 1.0, 0.01, 0.6});
    std::vector<double> x(6), v(6), z(static_cast<std::size_t>(6 * m.n_unknown())), load(6);
    // From the bed up to above the surface.
    const Vector3 a(random(generator), 0.0, -depth), b(10.0 + 2.0 * n, 5.0, 2.0);
    Eigen::Map<Vector3>(x.data()) = a;
    Eigen::Map<Vector3>(x.data() + 3) = b;
    for (double& component : v)
      component = random(generator);
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = random(generator);
    for (int i = 1; i <= m.n_unknown(); ++i)
      Eigen::Map<Vector3>(z.data() + 6 * (i - 1)) += a + i * (b - a) / n;
    std::vector<double> rates(z.size());
    std::vector<Dual> dual_x(x.begin(), x.end()), dual_v(v.begin(), v.end()),
        dual_z(z.begin(), z.end()), dual_load(6), dual_rates(z.size());
    const line::LineTable table(m);
    line::LineArrays<double> arrays;
    line::LineArrays<Dual> dual_arrays;
    const line::LineView<double> at{m, x.data(), v.data(), z.data(), parted};
    evaluate_line(table, at, sea, 1.0, arrays, load.data(), rates.data());
    evaluate_line(table,
                  line::LineView<Dual>{m, dual_x.data(), dual_v.data(), dual_z.data(), parted}, sea,
                  1.0, dual_arrays, dual_load.data(), dual_rates.data());
    const auto close = [](double found, const Dual& other) {
      return std::abs(found - other.a) <= 1e-11 * (1e3 + std::abs(other.a));
    };
    for (std::size_t k = 0; k < z.size(); ++k)
      REQUIRE(close(rates[k], dual_rates[k]));
    for (std::size_t k = 0; k < static_cast<std::size_t>(3 * m.n_points()); ++k)
      REQUIRE(close(load[k], dual_load[k]));
    // Node by node, where nothing bends.
    for (int i = 0; i <= n && !m.bends; ++i) {
      const line::LineNode& node = m.nodes[static_cast<std::size_t>(i)];
      const Vector3 still = Vector3::Zero();
      Vector3 force =
          bed_force<double>(m, node, at.place(i), at.velocity(i)) +
          water_force<double>(node, node_water<double>(at, sea, 1.0, i), at.velocity(i), still);
      force[2] -= node.mass * m.gravity;
      if (i < n && i != parted)
        force += segment_pull<double>(at, i).tension * segment_pull<double>(at, i).e;
      if (i > 0 && i - 1 != parted)
        force -= segment_pull<double>(at, i - 1).tension * segment_pull<double>(at, i - 1).e;
      REQUIRE((arrays.force(i) - force).norm() <= 1e-11 * (1e3 + force.norm()));
    }
  }
}
