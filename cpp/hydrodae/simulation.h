#pragma once
/// Public entry point: a scene in, a results file out.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hydrodae/accuracy/comparison.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/math/sampling.h"
#include "hydrodae/model/scene.h"

namespace hydrodae {

inline constexpr const char* version = HYDRODAE_VERSION;

/// Function called after every output sample, and every thousand steps, with the time reached and
/// the end time [s]; returning false stops the run and keeps its results.
using Progress = std::function<bool(double time, double end_time)>;

struct RunStatistics {
  std::string status; ///< "completed" or "interrupted"
  std::string method; ///< named method, or those of "auto" with times and reasons
  long steps = 0;
  long residual_calls = 0;
  long jacobian_calls = 0;
  long newton_iterations = 0;
  long error_test_failures = 0;
  long convergence_failures = 0;
  long events = 0;             ///< changes of stops, one-sided joints and dry friction
  double end_time = 0.0;       ///< time reached [s]
  double setup_time = 0.0;     ///< wall time before the first step [s]
  double solver_time = 0.0;    ///< wall time inside the integrator and the residual [s]
  double wall_time = 0.0;      ///< wall time of the whole run with output [s]
  accuracy::Estimate accuracy; ///< estimate of the error of the motion
  bool at_rest = false;        ///< true: nothing has moved by more than rounding
  /// Mean absorbed power of each power take-off after the ramp of the sea [W], and the end of the
  /// ramp [s].
  std::vector<std::pair<std::string, double>> mean_power;
  double mean_power_from = 0.0;
  double sea_period = 0.0; ///< energy period of an irregular sea [s]; 0 without one
  /// 95 % intervals of these means and of their sum [W], see `mean_interval`. Empty without an
  /// irregular sea, and if `interval_missing` has a reason.
  std::vector<std::optional<Interval>> mean_power_interval;
  std::optional<Interval> total_power_interval;
  std::string interval_missing;
  /// Calls of each controller that is a Python function or another program, and their mean wall
  /// time without the first, which waits for the program [s].
  struct ControllerCost {
    std::string name;
    long calls = 0;
    double mean_time = 0.0;
  };
  std::vector<ControllerCost> controllers;
  long unknowns = 0;
  long nonzeros = 0;
  std::vector<std::string> notes; ///< notes of the assembly
};

/// Report on a scene before a run: the scene as a tree, unknowns and multipliers, cost of each
/// element, mobility and redundant rows. It lists displacements to close the joints, coordinates
/// that nothing moves, and possible simplifications. Throws ModelError.
std::string examine(const model::Scene& scene);

/// Sizes of the equations in `examine`, by name. Throws ModelError.
std::vector<std::pair<std::string, long>> count(const model::Scene& scene);

/// Options of a run besides its scene.
struct RunOptions {
  /// Method of the second run, at the tolerance of the first; empty: the same method at 10 rtol, or
  /// at twice the fixed step. Another method shows errors that no tolerance changes.
  std::string verify;
  /// Wall time between checkpoints [s]; 0: one after each step, negative: none. A checkpoint
  /// X.checkpoint.h5 exists beside X.h5 until the run is completed. Each one restarts the method,
  /// see run::Simulation.
  double checkpoint = -1.0;
  /// Continues from the checkpoint; the results then hold the whole run.
  bool resume = false;
  /// Requires an estimate of the error: a scene without one is refused.
  bool strict = false;
};

/// Integrates the scene from 0 to its end time and writes `output_path` (no file if empty), which
/// gets its name at the end of the run; see ResultsFile. Throws ModelError if the scene cannot
/// start. Throws CaseError if `output_path` cannot be written, or no matching checkpoint exists to
/// resume from. Throws SolverError if the integration fails or the disk is full: the file then has
/// status "failed" and keeps its results. The error of the motion is an estimate: it is reported
/// and never stops a run.
RunStatistics simulate(const model::Scene& scene, const std::string& output_path,
                       const Progress& progress = {}, const RunOptions& options = {});

} // namespace hydrodae
