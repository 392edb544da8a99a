/// Radiation that would feed the motion is refused on every rung; true databases pass.

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

TEST_CASE("a memory with a growing pole is refused") {
  model::Scene scene = case_of("sphere/decay.toml", {});
  auto database = std::make_shared<hydro::Database>(*scene.database);
  for (hydro::MemoryFit& fit : database->fits)
    fit.poles = -fit.poles.conjugate();
  scene.database = database;
  CHECK(contains(message_of([&] { build::build(scene); }), "has a pole of real part"));
}
