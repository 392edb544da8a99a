/// Radiation that would feed the motion is refused on every rung; true databases pass.

#include <array>
#include <filesystem>
#include <memory>

#include "hydrodae/build/build.h"
#include "hydrodae/io/case_reader.h"
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

/// Floats that heave, each with a real pole of its own. By two more poles the first of `coupled`
/// loads the second `there` times as much as itself, and the second the first `back` times.
model::Scene row_of_floats(int n, std::array<int, 2> coupled, double there, double back) {
  auto database = std::make_shared<hydro::Database>();
  database->rho = 1000.0;
  database->omega = Eigen::Vector2d(0.2, 2.0);
  hydro::MemoryFit fit;
  fit.name = "by hand";
  fit.passive = true;
  model::Scene scene;
  scene.hydro = model::HydroOptions{};
  scene.hydro->radiation = "exponential";
  for (int i = 0; i < n; ++i) {
    hydro::Hydrostatics h;
    h.displaced_volume = 1.0;
    h.stiffness(2, 2) = 1e4;
    model::Body body;
    body.name = body.hydro.emplace("float" + std::to_string(i));
    body.motion = {"heave"};
    body.mass = 1000.0;
    body.inertia = Vector3::Constant(1000.0);
    body.center_of_gravity = Vector3(10.0 * i, 0.0, -0.5);
    database->bodies.push_back({body.name, body.center_of_gravity, h, {}, {}});
    database->coordinates.push_back(body.name + ".heave");
    scene.bodies.push_back(body);
  }
  fit.inputs = fit.outputs = database->coordinates;
  fit.added_mass_inf = MatrixX::Identity(n, n) * 500.0;
  fit.states = n + 2;
  fit.poles = Eigen::VectorXcd::Constant(n + 2, -1.0);
  fit.input_matrix = 30.0 * Eigen::MatrixXcd::Identity(n + 2, n);
  fit.output_matrix = 30.0 * Eigen::MatrixXcd::Identity(n, n + 2);
  fit.input_matrix(n, coupled[0]) = fit.input_matrix(n + 1, coupled[1]) = 30.0;
  fit.output_matrix(coupled[1], n) = 30.0 * there;
  fit.output_matrix(coupled[0], n + 1) = 30.0 * back;
  database->added_mass_inf = fit.added_mass_inf;
  database->fits = {fit};
  scene.database = database;
  return scene;
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
      return message_of([&] { build::build(row_of_floats(n, {1, 3}, there, back)); });
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

TEST_CASE("a memory with a growing pole is refused") {
  model::Scene scene = case_of("sphere/decay.toml", {});
  auto database = std::make_shared<hydro::Database>(*scene.database);
  for (hydro::MemoryFit& fit : database->fits)
    fit.poles = -fit.poles.conjugate();
  scene.database = database;
  CHECK(contains(message_of([&] { build::build(scene); }), "has a pole of real part"));
}
