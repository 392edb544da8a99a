/// Sparse rank and smallest solutions against dense ones, on all benchmark mechanisms.

#include "hydrodae/build/rank.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <random>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/regime.h"
#include "hydrodae/system/retract.h"

namespace {

using namespace hydrodae;
using namespace hydrodae::system;
using build::Component, build::SparseMatrix, build::components, build::independent_rows,
    build::smallest_solution;

constexpr Index dense = 1 << 20, sparse = 0; // limits that leave only one of the methods

/// Gradient of all rows of all joints, the redundant ones included [m or rad per m or rad].
SparseMatrix full_gradient(const Regime& s, const VectorX& y) {
  Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  unpack<double>(s, y.data(), rest.data(), ws.bodies);
  std::vector<Eigen::Triplet<double>> entries;
  Index rows = 0;
  for (const JointData& j : s.joints)
    for (const RowData& row : j.rows) {
      const joint::Vector12 gradient =
          joint::basic_row<double>(row.kind, j.A, j.B, j.parameters,
                                   joint_geometry<double>(j, ws.bodies))
              .gradient;
      for (int side = 0; side < 2; ++side) {
        const int body = side == 0 ? j.A.body : j.B.body;
        for (int k = 0; body >= 0 && k < s.bodies[body].n_active; ++k)
          entries.emplace_back(rows, s.bodies[body].u0 - s.u0 + k,
                               gradient[6 * side + s.bodies[body].active[k]]);
      }
      ++rows;
    }
  SparseMatrix G(rows, s.n_u);
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

/// Of all benchmark scenes, singular poses included: at the start and with all coordinates moved at
/// random.
std::vector<std::pair<std::string, SparseMatrix>> gradients() {
  std::vector<std::pair<std::string, SparseMatrix>> out;
  std::mt19937 random(3);
  const auto root = std::filesystem::path(__FILE__).parent_path() / "../../../cases/benchmarks";
  for (const auto& file : std::filesystem::directory_iterator(root)) {
    if (file.path().extension() != ".toml")
      continue;
    const System built = build::build(io::read_case(file.path().string()));
    const Regime s(built);
    if (s.n_lambda == 0 || s.n_u > 1000) // dense: cubic
      continue;
    VectorX y = initial_state(s);
    for (int sample = 0; sample < 2; ++sample) {
      out.emplace_back(file.path().stem().string(), full_gradient(s, y));
      VectorX step(s.n_u);
      for (double& x : step)
        x = 0.5 * (random() / 4294967296.0);
      system::retract(s, step, y);
    }
  }
  return out;
}

/// Chain of `n` rows, each of which couples two neighbours; the last repeats the sum of the first
/// two.
SparseMatrix chain(Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 1.0 + 0.1 * static_cast<double>(i % 7));
    entries.emplace_back(i, i + 1, -1.0);
  }
  for (Index c = 0; c < 3; ++c)
    entries.emplace_back(n, c, c == 0 ? 1.0 : c == 1 ? 0.1 : -1.0);
  SparseMatrix m(n + 1, n + 3);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

} // namespace

TEST_CASE("sparse and dense rank agree on every benchmark, and the rows found are independent") {
  int deficient = 0;
  for (const auto& [name, G] : gradients()) {
    CAPTURE(name);
    const std::vector<Index> rows = independent_rows(G, sparse);
    CHECK(rows.size() == independent_rows(G, dense).size());
    deficient += static_cast<Index>(rows.size()) < G.rows() ? 1 : 0;
    MatrixX kept(static_cast<Index>(rows.size()), G.cols());
    for (std::size_t k = 0; k < rows.size(); ++k)
      kept.row(static_cast<Index>(k)) = MatrixX(G).row(rows[k]);
    const VectorX squares = symmetric_eigenvalues(kept * kept.transpose()); // of singular values
    CHECK(squares[0] > 1e-12 * squares[squares.size() - 1]);
  }
  CHECK(deficient >= 2); // door, bricard
}

TEST_CASE("sparse and dense smallest solutions agree on every benchmark") {
  std::mt19937 random(5);
  for (const auto& [name, G] : gradients()) {
    CAPTURE(name);
    VectorX x(G.cols());
    for (double& value : x)
      value = random() / 4294967296.0;
    const VectorX b = G * x; // consistent whatever the rank
    const VectorX one = smallest_solution(G, b, dense), other = smallest_solution(G, b, sparse);
    CHECK((G * other - b).norm() < 1e-9 * b.norm());
    CHECK((one - other).norm() < 1e-8 * one.norm());
  }
}

TEST_CASE(
    "components are solved apart, and rows that follow from others are found in a long chain") {
  const SparseMatrix one = chain(400);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index c = 0; c < one.cols(); ++c)
    for (SparseMatrix::InnerIterator it(one, c); it; ++it)
      for (Index copy = 0; copy < 2; ++copy)
        entries.emplace_back(it.row() + copy * one.rows(), c + copy * one.cols(), it.value());
  SparseMatrix two(2 * one.rows(), 2 * one.cols());
  two.setFromTriplets(entries.begin(), entries.end());
  const std::vector<Component> parts = components(two);
  REQUIRE(parts.size() == 2);
  CHECK(static_cast<Index>(parts[1].rows.size()) == one.rows());
  CHECK(parts[1].columns.front() == one.cols());
  CHECK(static_cast<Index>(parts[0].columns.size()) == one.cols() - 2); // two columns are empty
  CHECK(independent_rows(two).size() == 800);
  CHECK(independent_rows(two, dense).size() == 800);
}
