#pragma once
/// The command line of hydrodae-solve.

#include <charconv>
#include <string>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/simulation.h"

namespace hydrodae::app {

inline constexpr const char* usage =
    R"(usage: hydrodae-solve CASE -o RESULTS [--set KEY=VALUE]... [--method NAME] [--quiet]
                      [--verify METHOD] [--strict] [--checkpoint SECONDS] [--resume]
                      [--library FILE]...
       hydrodae-solve --check CASE [--set KEY=VALUE]...
       hydrodae-solve --keys [TABLE [TYPE]]
       hydrodae-solve --version | --help

  -o RESULTS       results file (HDF5); an older one is replaced when the run ends, until then it
                   is written beside it (RESULTS.partial.h5 for RESULTS.h5)
  --set KEY=VALUE  replace a value of the case, for example --set solver.rtol=1e-8 or
                   --set joint.hinge1.initial.angle_deg=5
  --method NAME    the same as --set solver.method="NAME": auto, radau, ...
  --force          run a pair of method and formulation that is known to fail
  --verify METHOD  estimate the error by a second run with another method: radau, ida, explicit_rk
  --strict         exit with 5 where the motion of a body or line is not reproducible to the end, or
                   no estimate of the error reaches the end
  --checkpoint SECONDS
                   keep RESULTS.checkpoint.h5 beside RESULTS.h5 while the run lasts: what --resume
                   goes on from, anew after so many seconds of wall time
  --resume         go on from the checkpoint of a run that was cut off; the results file then holds
                   the whole run. The case, its overrides and the files that it reads have to be
                   those of that run
  --library FILE   take force laws of types library_load and library_wrench from this shared library
  --check          read and check the case, print what is in it, do not run
  --keys           list the tables of a case file, the keys of one, or those of a type of entry:
                   --keys solver, --keys force pto_linear
  --quiet          no progress on stderr

Exit codes: 0 done, 2 bad case or model, 3 solver failure, 4 interrupted, 5 not reproducible
(--strict); what was computed before a failure or an interrupt (Ctrl-C, SIGTERM) is kept in the
results file.
)";

struct Arguments {
  enum class Task { run, check, keys, version, help } task = Task::run;
  std::string case_path, output;
  io::Overrides overrides;
  std::vector<std::string> libraries;
  std::vector<std::string> words; ///< words after --keys
  bool quiet = false;
  RunOptions options;
};

inline std::string next_value(int argc, char** argv, int& i) {
  if (i + 1 >= argc)
    throw CaseError(std::string(argv[i]) + ": a value is missing");
  return argv[++i];
}

/// Time of at least 0 [s].
inline double seconds(const std::string& text) {
  double value = -1.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= 0.0))
    throw CaseError("--checkpoint " + text + ": expected a number of seconds, 0 or more");
  return value;
}

/// Adds an override "KEY=VALUE".
inline void add_override(const std::string& text, io::Overrides& overrides) {
  const auto trimmed = [](const std::string& part) {
    const std::size_t first = part.find_first_not_of(' ');
    return first == std::string::npos ? ""
                                      : part.substr(first, part.find_last_not_of(' ') - first + 1);
  };
  const std::size_t equals = text.find('=');
  const std::string key = trimmed(text.substr(0, equals));
  if (equals == std::string::npos || key.empty())
    throw CaseError("--set " + text + ": expected KEY=VALUE");
  overrides[key] = trimmed(text.substr(equals + 1));
}

/// Parses the command line. Throws CaseError on unknown words.
inline Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-h" || word == "--help")
      arguments.task = Arguments::Task::help;
    else if (word == "--version")
      arguments.task = Arguments::Task::version;
    else if (word == "--check")
      arguments.task = Arguments::Task::check;
    else if (word == "--keys")
      arguments.task = Arguments::Task::keys;
    else if (word == "--quiet")
      arguments.quiet = true;
    else if (word == "--verify")
      arguments.options.verify = next_value(argc, argv, i);
    else if (word == "--strict")
      arguments.options.strict = true;
    else if (word == "--resume")
      arguments.options.resume = true;
    else if (word == "--checkpoint")
      arguments.options.checkpoint = seconds(next_value(argc, argv, i));
    else if (word == "-o" || word == "--output")
      arguments.output = next_value(argc, argv, i);
    else if (word == "--set")
      add_override(next_value(argc, argv, i), arguments.overrides);
    else if (word == "--library")
      arguments.libraries.push_back(next_value(argc, argv, i));
    else if (word == "--method")
      arguments.overrides["solver.method"] = '"' + next_value(argc, argv, i) + '"';
    else if (word == "--force")
      arguments.overrides["solver.force"] = "true";
    else if (arguments.task == Arguments::Task::keys && arguments.words.size() < 2 &&
             !word.starts_with("-"))
      arguments.words.push_back(word);
    else if (word.starts_with("-") || !arguments.case_path.empty() ||
             arguments.task == Arguments::Task::keys)
      throw CaseError("unexpected argument '" + word + "'; see hydrodae-solve --help");
    else
      arguments.case_path = word;
  }
  const bool runs = arguments.task == Arguments::Task::run;
  if (arguments.case_path.empty() && (runs || arguments.task == Arguments::Task::check))
    throw CaseError("a case file is missing; see hydrodae-solve --help");
  if (runs && arguments.output.empty())
    throw CaseError("-o RESULTS is missing; see hydrodae-solve --help");
  return arguments;
}

} // namespace hydrodae::app
