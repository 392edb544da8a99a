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
  if ((options & 32) != 0) {
    const std::vector<double> x = {-5.0, 4.0, 11.0, 30.0}, y = {-2.0, 1.0, 6.0};
    MatrixX z(4, 3);
    z << -51.0, -50.0, -52.0, -50.5, -51.5, -49.0, -50.0, -50.5, -48.0, -40.0, -45.0, -46.0;
    m.surface = std::make_shared<const SmoothTable>(x, y, z);
    m.bed = m.surface->top();
  }
  m.damps_slack = (options & 1) != 0;
  m.bed_damps_up = (options & 2) != 0;
  for (int k = 0; k < n; ++k)
    m.segments.push_back({length + 0.01 * k, 5e5, 4e3, 1e-5 + 1e-7 * k});
  const std::vector<double> strain = {0.0, 0.01, 0.2, 0.4}, tension = {0.0, 0.005, 0.08, 0.4};
  if ((options & 16) != 0)
    for (std::size_t k = 1; k < m.segments.size(); k += 2)
      m.segments[k].curve = std::make_shared<const Curve>(strain, tension);
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
          bed_force<double>(m, node, bed_contact<double>(m, node, at.place(i)), at.velocity(i)) +
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

TEST_CASE("the derivatives of a line on a bed with slopes are those of dual numbers") {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> random(-1.0, 1.0);
  sea::WaveField sea;
  sea.depth = depth;
  for (int run = 0; run < 64; ++run) {
    CAPTURE(run);
    const int n = 5;
    line::LineModel m = random_line(n, (run & 4) != 0, (run & 8) != 0, 32 + (run & 3));
    m.wet = false; // the bed alone, without the inverse mass of the water
    const auto w = static_cast<std::size_t>(3 * m.n_points()),
               n_z = static_cast<std::size_t>(6 * m.n_unknown());
    std::vector<double> in(2 * w + n_z), load(w), rates(n_z);
    const auto place = [&](int i) {
      const double x = -6.0 + 3.0 * i + random(generator), y = 2.0 + 4.0 * random(generator);
      return Vector3(x, y, m.surface->at(x, y).value + 0.1 + 0.02 * random(generator));
    };
    for (double& value : in)
      value = random(generator);
    for (int end = 0; end < m.n_points(); ++end)
      Eigen::Map<Vector3>(in.data() + 3 * end) = place(end == 0 ? 0 : n);
    for (int i = 1; i <= m.n_unknown(); ++i)
      Eigen::Map<Vector3>(in.data() + 2 * w + 6 * static_cast<std::size_t>(i - 1)) = place(i);
    const line::LineTable table(m);
    line::LineArrays<double> arrays;
    const line::LineView<double> at{m, in.data(), in.data() + w, in.data() + 2 * w};
    evaluate_line(table, at, sea, 0.0, arrays, load.data(), rates.data());
    const auto pattern = line::line_sparsity(m);
    std::vector<double> values(pattern.size());
    line::LineBlocks blocks;
    line_jacobian(at, sea, 0.0, rates.data(), blocks, values.data());
    MatrixX found = MatrixX::Zero(static_cast<Index>(w + n_z), static_cast<Index>(in.size()));
    for (std::size_t k = 0; k < pattern.size(); ++k)
      found(pattern[k][0], pattern[k][1]) = values[k];
    line::LineArrays<Dual> dual_arrays;
    for (std::size_t column = 0; column < in.size(); ++column) {
      std::vector<Dual> x(in.begin(), in.end()), dual_load(w), dual_rates(n_z);
      x[column].b = 1.0;
      evaluate_line(table, line::LineView<Dual>{m, x.data(), x.data() + w, x.data() + 2 * w}, sea,
                    0.0, dual_arrays, dual_load.data(), dual_rates.data());
      for (std::size_t row = 0; row < w + n_z; ++row) {
        const double exact = row < w ? dual_load[row].b : dual_rates[row - w].b;
        REQUIRE(std::abs(found(static_cast<Index>(row), static_cast<Index>(column)) - exact) <=
                1e-11 * (1e5 + std::abs(exact)));
      }
    }
  }
}
