/// hydrodae-solve: runs one case file.

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <optional>
#include <utility>

#include "arguments.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/libraries.h"
#include "hydrodae/simulation.h"
#include "keys.h"

namespace {

using hydrodae::ExitCode;
using hydrodae::app::Arguments;
using hydrodae::app::usage;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void note_interrupt(int) { interrupted = 1; }

/// Progress on stderr: a line that is updated on a terminal, else a line every 2 s.
class Reporter {
public:
  explicit Reporter(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}
  ~Reporter() { finish(); }

  bool operator()(double time, double end_time) {
    const auto now = std::chrono::steady_clock::now();
    if (!quiet_ && now - last_ > std::chrono::milliseconds(terminal_ ? 100 : 2000)) {
      std::fprintf(stderr,
                   terminal_ ? "\r%3.0f %%  %.6g s of %.6g s " : "%3.0f %%  %.6g s of %.6g s\n",
                   100.0 * time / end_time, time, end_time);
      last_ = now;
      open_line_ = terminal_;
    }
    return interrupted == 0;
  }

  void finish() {
    if (open_line_)
      std::fputc('\n', stderr);
    open_line_ = false;
  }

private:
  bool quiet_, terminal_, open_line_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Prints " 1.234 kW (1.1 to 1.38)", without unknown parts; the power decides the unit.
void print_mean(double power, const std::optional<hydrodae::Interval>& interval) {
  const double size = std::abs(power);
  const auto [factor, unit] = size >= 1e9   ? std::pair(1e-9, "GW")
                              : size >= 1e6 ? std::pair(1e-6, "MW")
                              : size >= 1e3 ? std::pair(1e-3, "kW")
                                            : std::pair(1.0, "W");
  std::printf(" %.4g %s", factor * power, unit);
  if (interval)
    std::printf(" (%.3g to %.3g)", factor * interval->low, factor * interval->high);
}

/// Prints "mean absorbed power after 30 s: pto1 1.2 kW (1.1 to 1.31), pto2 3.4 W (3.1 to 3.8), in
/// all 1.203 kW (1.1 to 1.31); in brackets: 95 % interval of the sea state".
void print_power(const hydrodae::RunStatistics& statistics) {
  if (statistics.mean_power.empty())
    return;
  double total = 0.0;
  std::printf("mean absorbed power");
  if (statistics.mean_power_from > 0.0)
    std::printf(" after %.6g s", statistics.mean_power_from);
  const char* between = ":";
  for (std::size_t k = 0; k < statistics.mean_power.size(); ++k) {
    const auto& [name, power] = statistics.mean_power[k];
    std::printf("%s %s", between, name.c_str());
    print_mean(power, statistics.mean_power_interval.empty() ? std::nullopt
                                                             : statistics.mean_power_interval[k]);
    between = ",";
    total += power;
  }
  if (statistics.mean_power.size() > 1) {
    std::printf(", in all");
    print_mean(total, statistics.total_power_interval);
  }
  if (statistics.total_power_interval)
    std::printf("; in brackets: 95 %% interval of the sea state");
  else if (!statistics.interval_missing.empty())
    std::printf("; %s", statistics.interval_missing.c_str());
  std::printf("\n");
}

/// Prints "controller pi: 2000 calls, 12 us each".
void print_controllers(const hydrodae::RunStatistics& statistics) {
  for (const auto& c : statistics.controllers)
    std::printf("controller %s: %ld calls, %.3g us each\n", c.name.c_str(), c.calls,
                1e6 * c.mean_time);
}

/// @returns whether the motion is known to be reproducible to the end
bool print_accuracy(const hydrodae::RunStatistics& statistics) {
  const hydrodae::accuracy::Estimate& estimate = statistics.accuracy;
  if (statistics.at_rest) {
    std::printf("at rest\n");
    return true;
  }
  if (const hydrodae::accuracy::MoverError* worst = estimate.worst())
    std::printf("estimated error %.1g of the motion (%s, t = %.4g s), by %s\n", worst->largest,
                worst->name.c_str(), worst->when, estimate.how.c_str());
  if (!estimate.missing.empty())
    std::printf("error not estimated%s: %s\n",
                estimate.known()
                    ? (" after t = " + hydrodae::rounded_text(estimate.until) + " s").c_str()
                    : "",
                estimate.missing.c_str());
  bool all = estimate.missing.empty() && !estimate.movers.empty();
  for (const hydrodae::accuracy::MoverError& m : estimate.movers)
    if (std::isfinite(m.parted)) {
      const bool reproducible = !std::isfinite(m.reproducible_until);
      all = all && reproducible;
      const std::string until =
          reproducible
              ? "error up to " + hydrodae::rounded_text(m.largest) + " of the motion"
              : "reproducible until t = " + hydrodae::rounded_text(m.reproducible_until) + " s";
      std::printf("%s: %s; two runs part by 5 %% at t = %.4g s\n", m.name.c_str(), until.c_str(),
                  m.parted);
    }
  return all;
}

ExitCode run(const hydrodae::model::Scene& scene, const Arguments& arguments) {
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  std::signal(SIGXFSZ, SIG_IGN); // file size limit of the shell: same message as for a full disk
  Reporter reporter(arguments.quiet);
  const hydrodae::RunStatistics statistics =
      hydrodae::simulate(scene, arguments.output, std::ref(reporter), arguments.options);
  reporter.finish();
  if (!arguments.quiet)
    for (const std::string& note : statistics.notes)
      std::cerr << "note: " << note << '\n';
  std::printf("%s at t = %.6g s: %ld steps in %.3g s, ", statistics.status.c_str(),
              statistics.end_time, statistics.steps, statistics.wall_time);
  std::printf("results in %s\n", arguments.output.c_str());
  if (statistics.method.starts_with("auto"))
    std::printf("method %s\n", statistics.method.c_str());
  const bool reproducible = print_accuracy(statistics);
  print_power(statistics);
  print_controllers(statistics);
  if (statistics.status == "interrupted")
    return ExitCode::interrupted;
  return arguments.options.strict && !reproducible ? ExitCode::not_reproducible : ExitCode::done;
}

ExitCode perform(const Arguments& arguments) {
  if (arguments.task == Arguments::Task::help) {
    std::cout << usage;
    return ExitCode::done;
  }
  if (arguments.task == Arguments::Task::version) {
    std::cout << "hydrodae " << hydrodae::version << '\n';
    return ExitCode::done;
  }
  if (arguments.task == Arguments::Task::keys) {
    std::cout << hydrodae::app::keys_answer(arguments.words);
    return ExitCode::done;
  }
  hydrodae::model::Scene scene = hydrodae::io::read_case(arguments.case_path, arguments.overrides);
  hydrodae::io::join_libraries(arguments.libraries, scene);
  try {
    if (arguments.task == Arguments::Task::run)
      return run(scene, arguments);
    std::cout << hydrodae::examine(scene);
    return ExitCode::done;
  } catch (const hydrodae::ModelError& error) {
    throw hydrodae::model::located(scene, error);
  }
}

} // namespace

int main(int argc, char** argv) {
  const auto complain = [](const std::string& message, ExitCode code) {
    std::cerr << "hydrodae-solve: " << message << '\n';
    return static_cast<int>(code);
  };
  const auto report = [&](const std::exception& error, ExitCode code) {
    return complain(error.what(), code);
  };
  try {
    const ExitCode code = perform(hydrodae::app::parse(argc, argv));
    if (!std::cout.flush() || std::fflush(stdout) != 0)
      return complain("standard output cannot be written", ExitCode::bad_case);
    return static_cast<int>(code);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory for this case", ExitCode::bad_case);
  } catch (const hydrodae::SolverError& error) {
    return report(error, ExitCode::solver_failure);
  } catch (const hydrodae::Error& error) {
    return report(error, ExitCode::bad_case);
  } catch (const std::exception& error) {
    return report(error, static_cast<ExitCode>(EXIT_FAILURE));
  }
}
