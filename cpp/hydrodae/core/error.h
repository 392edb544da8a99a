#pragma once
/// Errors that end a run on purpose, with their exit codes.

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hydrodae {

/// Base of every error that hydrodae raises on purpose. Failed `assert`s are bugs of hydrodae.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Place in a file that a person wrote.
struct FilePlace {
  std::string file;         ///< file, or other source of a key: "--set solver.rtol"
  int line = 0, column = 0; ///< line and column, from 1; 0: unknown
};

/// Text "case.toml:12:3", as far as known.
std::string text_of(const FilePlace& place);

/// Error in the case file or the database as written. The message is `fault` with the place in
/// front. Exit code 2.
struct CaseError : Error {
  explicit CaseError(const std::string& message) : Error(message), fault(message) {}
  CaseError(FilePlace at, std::string key_path, const std::string& what_is_wrong);

  FilePlace place;
  std::string key;   ///< path of the entry or key, such as "joint.hinge1.body_a"; "" without one
  std::string fault; ///< fault found, values expected, and the nearest valid name
};

/// Contradiction in the scene or to physics. `key` is the path of the faulty entry, such as
/// "joint.hinge1.body_a"; the case reader turns it into a CaseError with the place. Exit code 2.
struct ModelError : Error {
  ModelError(std::string key_path, const std::string& message)
      : Error(message), key(std::move(key_path)) {}
  std::string key;
};

/// Reason why an integration stopped. Python has their names (`name_of`) as `SolverError.reason`.
enum class Reason {
  start,      ///< no motion agrees with the equations at the start
  step,       ///< the step has become too short: Newton's iteration or the error test fail
  jacobian,   ///< the equations are singular
  not_finite, ///< accelerations, velocities or loads are not finite
  progress,   ///< the steps or events have become too dense to go on
  drift,      ///< the constraints are not kept
  branch,     ///< the motion has left its branch at a singular pose
  energy,     ///< the balance of energy is broken
  growth,     ///< the motion grows beyond all bounds
  impact,     ///< no impulses fit an impact, or no motion goes on from it
  friction,   ///< no friction fits (a jam, a rope that neither sticks nor slips)
  range,      ///< a body has left the range of its data or coordinates
  controller, ///< a controller, or the program behind it, failed
  output,     ///< results cannot be written
  state,      ///< the run has stopped before
  solver,     ///< a library failed
};
std::string_view name_of(Reason reason);

/// Parts of a SolverError; `message_of` composes its message from them.
struct Halt {
  Reason reason = Reason::solver;
  std::string what = {};    ///< event: "the Jacobian is singular"
  std::string subject = {}; ///< "bodies/float", or an unknown or a row; "" for the scene
  std::vector<std::pair<std::string, double>> numbers = {}; ///< measured values by name (SI units)
  std::string advice = {};                                  ///< advice that may help
  /// Further lines, each with "\n" in front.
  std::string details = {};
};

/// Message "stopped at t = 1.2 s: what; advice", then the details.
std::string message_of(double time, const Halt& halt);

/// Error that stops the integration before its end. Results up to `time` are kept. Exit code 3.
struct SolverError : Error {
  SolverError(double at_time, Halt why);
  double time; ///< [s]
  Halt halt;
};

enum class ExitCode {
  done = 0,
  bad_case = 2,
  solver_failure = 3,
  interrupted = 4,
  not_reproducible = 5
};

} // namespace hydrodae
