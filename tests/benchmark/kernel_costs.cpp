/// hydrodae-kernel-costs: what one call of each part of a run costs.
///
///   .venv/bin/python tests/benchmark/kernel_costs.py      builds and runs it
///   hydrodae-kernel-costs kernels|run CASE [KEY=VALUE ...]
///
/// kernels: seconds of each part, once the bodies move. run: those of the phases of a whole run,
/// without samples, file and estimate of the error. A JSON object; under callgrind a file of
/// counts for each name instead (costs.h).

#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>

#include "costs.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/linalg/newton_matrix.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/run/simulation.h"

namespace {

using namespace hydrodae;

void print(const char* name, double value) {
  static bool first = true;
  std::printf("%s\"%s\": %.9g", first ? "{" : ", ", name, std::isnan(value) ? 0.0 : value);
  first = false;
}

/// Parts of the start, then of a step in the first quarter of the run.
void kernels(const std::string& path, const io::Overrides& overrides) {
  const auto time = [](const char* name, auto&& piece) { print(name, costs::of(name, piece)); };
  const model::Scene scene = io::read_case(path, overrides);
  time("read", [&] { io::read_case(path, overrides); });
  time("start", [&] { run::Simulation started(scene); });

  run::Simulation simulation(scene);
  for (int k = 0; k < 20 && simulation.time() < 0.25 * scene.solver.end_time; ++k)
    simulation.advance();
  // Rows of the stabilised formulation, whatever the method of the case takes.
  const system::Regime regime(simulation.system());
  const system::Pattern whole = system::find_pattern(regime),
                        condensed = linalg::condensed(regime, whole);
  linalg::Equations equations(regime, condensed, scene.solver.rtol);
  VectorX y = simulation.y(), yp, r(regime.n);
  system::resize(regime, y);
  yp = VectorX::Zero(regime.n);
  const double t = simulation.time();
  linalg::SaddlePoint saddle(equations);
  time("accelerations", [&] {
    if (!saddle.accelerations(t, y, yp))
      throw std::runtime_error("there are no accelerations");
  });
  time("residual", [&] { equations.residual(t, y, yp, r); });
  time("jacobian", [&] { equations.jacobian(t, y, yp); });
  linalg::NewtonMatrix<double> newton(regime, condensed);
  double alpha = 20.0; // 1/s; another one at each call, as after a change of the step
  time("factorise", [&] {
    alpha = 45.0 - alpha;
    if (!newton.factorise(equations.parts, alpha))
      throw std::runtime_error("the matrix is singular");
  });
  time("solve", [&] {
    VectorX b = r;
    newton.solve(b.data());
  });

  // Samples inside one step, at other times each.
  std::vector<double> row(simulation.width());
  const double before = simulation.time();
  bool inside = false;
  simulation.advance(INFINITY, [&] {
    const double step = simulation.time() - before;
    double at = 0.0;
    time("sample", [&] {
      at = std::fmod(at + 0.618034, 1.0);
      simulation.sample(before + at * step, row);
    });
    inside = true;
  });
  if (!inside)
    throw std::runtime_error("the run has ended before its sample");
  print("unknowns", static_cast<double>(regime.n));
  print("nonzeros", static_cast<double>(condensed.nonzeros()));
}

/// Reading, the start, and the march to the end without samples.
void whole_run(const std::string& path, const io::Overrides& overrides) {
  double began = costs::seconds();
  CALLGRIND_ZERO_STATS;
  const auto stop = [&](const char* name) {
    CALLGRIND_DUMP_STATS_AT(name); // sets the counts to zero
    print(name, costs::seconds() - began);
    began = costs::seconds();
  };
  const model::Scene scene = io::read_case(path, overrides);
  stop("read");
  run::Simulation simulation(scene);
  stop("start");
  while (!simulation.finished())
    simulation.advance();
  simulation.finish();
  stop("march");
  print("steps", static_cast<double>(simulation.statistics().steps));
}

} // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 2 ? argv[1] : "";
  if (what != "kernels" && what != "run") {
    std::cerr << "usage: hydrodae-kernel-costs kernels|run CASE [KEY=VALUE ...]\n";
    return 2;
  }
  io::Overrides overrides;
  for (int i = 3; i < argc; ++i)
    if (const char* equals = std::strchr(argv[i], '='))
      overrides[std::string(argv[i], static_cast<std::size_t>(equals - argv[i]))] = equals + 1;
  try {
    (what == "run" ? whole_run : kernels)(argv[2], overrides);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  std::printf("}\n");
  return 0;
}
