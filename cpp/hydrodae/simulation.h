#pragma once
/// The one public entry point: a scene in, a results file out.

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

/// Called after every output sample, and every thousand steps, with the time reached and the end
/// time [s]; returns false to stop the run (what was computed is kept).
using Progress = std::function<bool(double time, double end_time)>;

struct RunStatistics {
  std::string status; ///< "completed" or "interrupted"
  std::string method; ///< that was named, or which "auto" took when and why
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
  accuracy::Estimate accuracy; ///< of the error of the motion
  bool at_rest = false;        ///< nothing has moved by more than rounding
  /// What each power take-off absorbed on average after the ramp of the sea [W], which ends then
  /// [s].
  std::vector<std::pair<std::string, double>> mean_power;
  double mean_power_from = 0.0;
  double sea_period = 0.0; ///< energy period of an irregular sea [s]; 0 without one
  /// 95 % intervals of these means and of their sum [W], see `mean_interval`. Empty without an
  /// irregular sea, and where `interval_missing` says why.
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
  std::vector<std::string> notes; ///< what the assembly found worth a note
};

/// What a person wants to know before a run: the scene as a tree, unknowns and multipliers, what
/// each element costs, mobility and redundant rows. Then how far the bodies were moved to close the
/// joints, coordinates that nothing moves, and what could be modelled with less. Throws ModelError.
std::string examine(const model::Scene& scene);

/// The sizes of its equations that `examine` shows, by name. Throws ModelError.
std::vector<std::pair<std::string, long>> count(const model::Scene& scene);

/// How a run is made, apart from its scene.
struct RunOptions {
  /// Method of the second run, at the tolerance of the first; empty: the method of the first at
  /// 10 rtol, or at twice the fixed step. Another method sees errors that no tolerance changes.
  std::string verify;
  /// Wall time between checkpoints [s], 0: one after each step, negative: none. A checkpoint
  /// X.checkpoint.h5 stands beside X.h5 until the run is completed. Each makes the method start
  /// again, see run::Simulation.
  double checkpoint = -1.0;
  /// Goes on from the checkpoint; the results then hold the whole run.
  bool resume = false;
  /// Whoever asks needs an estimate of the error: a scene without one is refused.
  bool strict = false;
};

/// Integrates the scene from 0 to its end time and writes `output_path` (no file if empty), which
/// has its name when the run has ended; see ResultsFile.
/// Throws ModelError when the scene cannot start, CaseError when `output_path` cannot be written,
/// SolverError when the integration fails or the disk is full (the file then has status "failed"
/// and keeps what was computed); CaseError when there is nothing to resume, or it is of another
/// case. The error of the motion is an estimate, reported and never a reason to stop.
RunStatistics simulate(const model::Scene& scene, const std::string& output_path,
                       const Progress& progress = {}, const RunOptions& options = {});

} // namespace hydrodae
