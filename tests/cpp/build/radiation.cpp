/// Radiation that would feed the motion is refused on every rung; true databases pass.

#include <array>
#include <filesystem>
#include <memory>
#include <random>

#include "hydrodae/build/build.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/system/system.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {

model::Scene case_of(const std::string& name, const io::Overrides& changes) {
  const auto root = std::filesystem::path(__FILE__).parent_path() / "../../../cases";
  return io::read_case((root / name).string(), changes);
}

/// Changes of the case for each rung.
const std::vector<io::Overrides> rungs = {
    {{"hydro.radiation", "'constant'"}, {"hydro.frequency", "1.44"}},
    {{"hydro.radiation", "'exponential'"}},
    {{"hydro.radiation", "'convolution'"}}};

/// The scene with B, the fits and the kernel of its database times `factor`.
model::Scene with_radiation_times(const model::Scene& given, double factor) {
  model::Scene scene = given;
  auto database = std::make_shared<hydro::Database>(*given.database);
  for (MatrixX& B : database->damping)
    B *= factor;
  for (hydro::MemoryFit& fit : database->fits)
    fit.output_matrix *= factor;
  if (database->kernel)
    for (MatrixX& K : database->kernel->values)
      K *= factor;
  scene.database = database;
  return scene;
}

/// Floats that heave, of 1500 kg with their added mass and 10 m apart, with this memory of real
/// poles of -1 1/s: B (n_poles, n), C (n, n_poles).
model::Scene row_of_floats(const MatrixX& B, const MatrixX& C) {
  auto database = std::make_shared<hydro::Database>();
  database->rho = 1000.0;
  database->omega = Eigen::Vector2d(0.2, 2.0);
  hydro::MemoryFit fit;
  fit.name = "by hand";
  fit.passive = true;
  model::Scene scene;
  scene.hydro = model::HydroOptions{};
  scene.hydro->radiation = "exponential";
  const Index n = B.cols();
  for (Index i = 0; i < n; ++i) {
    hydro::Hydrostatics h;
    h.displaced_volume = 1.0;
    h.stiffness(2, 2) = 1e4;
    model::Body body;
    body.name = body.hydro.emplace("float" + std::to_string(i));
    body.motion = {"heave"};
    body.mass = 1000.0;
    body.inertia = Vector3::Constant(1000.0);
    body.center_of_gravity = Vector3(10.0 * static_cast<double>(i), 0.0, -0.5);
    database->bodies.push_back({body.name, body.center_of_gravity, h, false, {}, {}});
    database->coordinates.push_back(body.name + ".heave");
    scene.bodies.push_back(body);
  }
  fit.inputs = fit.outputs = database->coordinates;
  fit.added_mass_inf = MatrixX::Identity(n, n) * 500.0;
  fit.states = static_cast<int>(B.rows());
  fit.poles = Eigen::VectorXcd::Constant(B.rows(), -1.0);
  fit.input_matrix = B.cast<std::complex<double>>();
  fit.output_matrix = C.cast<std::complex<double>>();
  database->added_mass_inf = fit.added_mass_inf;
  database->fits = {fit};
  scene.database = database;
  return scene;
}

/// Floats with a pole each. By two more poles the first of `coupled` loads the second `there` times
/// as much as itself, and the second the first `back` times.
model::Scene coupled_pair(int n, std::array<int, 2> coupled, double there, double back) {
  MatrixX B = 30.0 * MatrixX::Identity(n + 2, n), C = B.transpose();
  B(n, coupled[0]) = B(n + 1, coupled[1]) = 30.0;
  C(coupled[1], n) = 30.0 * there;
  C(coupled[0], n + 1) = 30.0 * back;
  return row_of_floats(B, C);
}

/// Residues s b b^T of poles that two neighbours feel each, and of a pole of each float, t e e^T.
/// The eigenvalues of H are those of their sum over 1500 (1 + w^2).
struct Residues {
  MatrixX b; ///< (n_poles, n)
  VectorX s; ///< (n_poles,)
  double t = 0.0;

  MatrixX sum() const {
    return b.transpose() * s.asDiagonal() * b + t * MatrixX::Identity(b.cols(), b.cols());
  }
  double largest() const { return sum().diagonal().maxCoeff(); }
  double lowest() const { return symmetric_eigenvalues(sum())[0]; }
  std::string verdict() const {
    const Index n = b.cols(), m = b.rows();
    MatrixX B(m + n, n), C(n, m + n);
    B << b, std::sqrt(t) * MatrixX::Identity(n, n);
    C << b.transpose() * s.asDiagonal(), std::sqrt(t) * MatrixX::Identity(n, n);
    const model::Scene scene = row_of_floats(B, C);
    return message_of([&] { build::build(scene); });
  }
};

/// A part of `feeding` poles has s = -1, the others s = 1.
Residues random_residues(Index n, double feeding, std::mt19937& random) {
  std::uniform_real_distribution<double> part(10.0, 30.0), chance(0.0, 1.0);
  Residues out{MatrixX::Zero(3 * n, n), VectorX::Ones(3 * n)};
  for (Index k = 0; k < 3 * n; ++k) {
    out.b(k, k % n) = part(random);
    out.b(k, (k + 1 + k / n) % n) = -part(random);
    if (chance(random) < feeding)
      out.s[k] = -1.0;
  }
  return out;
}

} // namespace

TEST_CASE("radiation with its sign flipped is refused on every rung, unless forced") {
  for (const io::Overrides& rung : rungs) {
    CAPTURE(rung.at("hydro.radiation"));
    const model::Scene good = case_of("sphere/decay.toml", rung);
    CHECK_NOTHROW(build::build(good));
    CHECK_NOTHROW(build::build(with_radiation_times(good, 1e-3)));
    model::Scene bad = with_radiation_times(good, -1.0);
    const std::string message = message_of([&] { build::build(bad); });
    CHECK(contains(message, "the radiation would feed the motion of sphere in heave"));
    CHECK(contains(message, "rad/s"));
    bad.solver.force = true;
    CHECK_NOTHROW(build::build(bad));
  }
}

TEST_CASE("one coordinate that feeds the motion is found among many that do not") {
  model::Scene scene = case_of("f3of/surge_decay.toml", {});
  CHECK_NOTHROW(build::build(scene));
  auto database = std::make_shared<hydro::Database>(*scene.database);
  for (hydro::MemoryFit& fit : database->fits)
    for (std::size_t i = 0; i < fit.outputs.size(); ++i)
      if (fit.outputs[i] == "flap1.pitch")
        fit.output_matrix.row(static_cast<Eigen::Index>(i)) *= -1.0;
  scene.database = database;
  CHECK(contains(message_of([&] { build::build(scene); }), "would feed the motion of"));
}

TEST_CASE("a coupled pair that feeds the motion is found among uncoupled bodies") {
  for (const int n : {4, 70}) {
    CAPTURE(n);
    const auto message = [&](double there, double back) {
      return message_of([&] { build::build(coupled_pair(n, {1, 3}, there, back)); });
    };
    // H = (1, back; there, 1) / (1 + i w): Re H has the eigenvalues (1 +- k) / (1 + w^2) for both k
    CHECK(message(0.99, 0.99) == "no error");
    CHECK(contains(message(1.2, 1.2), "would feed the motion of float"));
    CHECK(contains(message(-1.2, -1.2), "falls to -20 % of its largest"));
    // Hermitian part (1, i k w; -i k w, 1) / (1 + w^2) for -k and k: 1 - k w is negative beyond 1 /
    // k and least, -0.5 (sqrt(1 + k^2) - 1), at k w = 1 + sqrt(1 + k^2)
    const std::string lag = message(1.2, -1.2);
    CHECK(contains(lag, "falls to -28 % of its largest"));
    CHECK((contains(lag, "float1 in heave") || contains(lag, "float3 in heave")));
  }
}

TEST_CASE("coupled floats are judged by the eigenvalues of the sum of their residues") {
  std::mt19937 random(5);
  for (const Index n : {6, 25, 90}) {
    CAPTURE(n);
    CHECK(random_residues(n, 0.0, random).verdict() == "no error"); // positive by construction
    Residues r = random_residues(n, 0.3, random);
    const double lowest = r.lowest(), largest = r.largest();
    for (const double limits : {0.98, 1.02, 20.0}) { // lowest + t = -limits 0.1 % (largest + t)
      CAPTURE(limits);
      r.t = (-lowest - 1e-3 * limits * largest) / (1.0 + 1e-3 * limits);
      REQUIRE(r.lowest() == doctest::Approx(-1e-3 * limits * r.largest()).epsilon(1e-6));
      if (limits < 1.0)
        CHECK(r.verdict() == "no error");
      else
        CHECK(contains(r.verdict(), "falls to -" + std::string(limits < 2.0 ? "0.1" : "2") +
                                        " % of its largest at 0.01 rad/s"));
    }
  }
}

TEST_CASE("mass and added mass of coupled floats must be positive definite together") {
  const Index n = 30; // 1500 kg each, m of each to the next: 1500 + 2 m cos(k pi / (n + 1))
  const MatrixX B = 30.0 * MatrixX::Identity(n, n);
  const double limit = 750.0 / std::cos(pi / static_cast<double>(n + 1));
  for (const double part : {0.999, 1.001}) {
    CAPTURE(part);
    model::Scene scene = row_of_floats(B, B);
    auto database = std::make_shared<hydro::Database>(*scene.database);
    MatrixX& added = database->fits[0].added_mass_inf;
    added.diagonal(1).setConstant(part * limit);
    added.diagonal(-1).setConstant(part * limit);
    scene.database = database;
    const std::string message = message_of([&] { build::build(scene); });
    CHECK(contains(message, "positive definite together") == (part > 1.0));
    CHECK((message == "no error") == (part < 1.0));
  }
}

TEST_CASE("a memory with a growing pole is refused") {
  model::Scene scene = case_of("sphere/decay.toml", {});
  auto database = std::make_shared<hydro::Database>(*scene.database);
  for (hydro::MemoryFit& fit : database->fits)
    fit.poles = -fit.poles.conjugate();
  scene.database = database;
  CHECK(contains(message_of([&] { build::build(scene); }), "has a pole of real part"));
}
