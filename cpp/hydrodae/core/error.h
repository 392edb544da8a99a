#pragma once
/// The three ways in which a run ends on purpose, and the exit code of each.

#include <stdexcept>
#include <string>

namespace hydrodae {

/// Base of every error that hydrodae raises on purpose. Failed `assert`s are bugs of ours.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The case file or the database cannot be used as it is written. The message says where
/// (file:line:column), what was found, what was expected, and the nearest valid name. Exit code 2.
struct CaseError : Error {
  using Error::Error;
};

/// The scene contradicts itself or the physics. `key` is the path of the offending entry, such as
/// "joint.hinge1.body_a"; the case reader turns it into file:line:column. Exit code 2.
struct ModelError : Error {
  ModelError(std::string key_path, const std::string& message)
      : Error(message), key(std::move(key_path)) {}
  std::string key;
};

/// The integration stopped before its end. Results up to `time` are kept. Exit code 3.
struct SolverError : Error {
  SolverError(double at_time, const std::string& message) : Error(message), time(at_time) {}
  double time; ///< [s]
};

enum class ExitCode {
  done = 0,
  bad_case = 2,
  solver_failure = 3,
  interrupted = 4,
  not_reproducible = 5
};

} // namespace hydrodae
