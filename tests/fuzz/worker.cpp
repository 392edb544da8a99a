/// hydrodae-fuzz: takes inputs in one process and reports how each ended.
///
/// A request is a line "<tasks> <folder>" on standard input, or two words of the command line. The
/// folder holds `case.toml`, and `words`: those of a command line of hydrodae-solve without the
/// case and the results, each ended by a zero. Tasks: e examine, l linearize, r run, w run and
/// write `results.h5`. The answer is a line "<exit code> <message>", the code that hydrodae-solve
/// would end with; 1 for an exception that hydrodae does not raise on purpose. A fault ends the
/// process. Answers go to what was standard output; what else is written there, by a library, goes
/// to standard error.

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "arguments.h"
#include "hydrodae/core/error.h"
#include "hydrodae/simulation.h"
#include "hydrodae/statics/analysis.h"

namespace {

using hydrodae::ExitCode;

constexpr double run_seconds = 0.2; ///< processor time after which a run is interrupted
constexpr double patience = 0.2;    ///< for programs that do not call [s]
constexpr long hang_seconds = 30;   ///< processor time after which an input counts as a hang

struct Answer {
  int code = 0;
  std::string message;
};

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// A sanitizer prints the stack of an abort: where the input hangs.
extern "C" void hang(int) {
  std::fputs("hydrodae-fuzz: hang\n", stderr);
  std::abort();
}

void limit_processor_time() {
  itimerval limit{};
  limit.it_value.tv_sec = hang_seconds;
  setitimer(ITIMER_PROF, &limit, nullptr);
}

std::vector<std::string> read_words(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> words;
  std::size_t start = 0;
  for (std::size_t end; (end = text.find('\0', start)) != std::string::npos; start = end + 1)
    words.push_back(text.substr(start, end - start));
  return words;
}

hydrodae::app::Arguments arguments_of(const std::string& folder, const std::string& results) {
  std::vector<std::string> words = {"hydrodae-solve", folder + "/case.toml", "-o", results};
  for (std::string& word : read_words(folder + "/words"))
    words.push_back(std::move(word));
  std::vector<char*> argv;
  for (std::string& word : words)
    argv.push_back(word.data());
  return hydrodae::app::parse(static_cast<int>(argv.size()), argv.data());
}

Answer run(hydrodae::model::Scene scene, const std::string& results) {
  for (hydrodae::model::Controller& c : scene.controllers) // nobody is at the other end
    if (auto* tcp = c.as<hydrodae::control::Tcp>())
      tcp->connect_timeout = std::min(tcp->connect_timeout, patience);
  const double start = processor_seconds();
  const auto statistics = hydrodae::simulate(
      scene, results, [&](double, double) { return processor_seconds() - start < run_seconds; });
  const bool whole = statistics.status == "completed";
  return {static_cast<int>(whole ? ExitCode::done : ExitCode::interrupted), statistics.status};
}

Answer perform(const std::string& tasks, const std::string& folder) {
  const bool writes = tasks.find('w') != std::string::npos;
  const std::string results = folder + "/results.h5";
  const hydrodae::app::Arguments arguments = arguments_of(folder, results);
  if (arguments.task == hydrodae::app::Arguments::Task::help ||
      arguments.task == hydrodae::app::Arguments::Task::version)
    return {0, "help"};
  const hydrodae::model::Scene scene =
      hydrodae::io::read_case(arguments.case_path, arguments.overrides);
  Answer answer{0, "read"};
  try {
    if (tasks.find('e') != std::string::npos)
      answer.message = hydrodae::examine(scene);
    if (tasks.find('l') != std::string::npos)
      hydrodae::statics::linearize(scene);
    if (writes || tasks.find('r') != std::string::npos)
      answer = run(scene, writes ? results : "");
  } catch (const hydrodae::ModelError& error) {
    throw hydrodae::model::located(scene, error);
  }
  return answer;
}

Answer answer_to(const std::string& tasks, const std::string& folder) {
  try {
    return perform(tasks, folder);
  } catch (const hydrodae::SolverError& error) {
    return {static_cast<int>(ExitCode::solver_failure), error.what()};
  } catch (const hydrodae::Error& error) {
    return {static_cast<int>(ExitCode::bad_case), error.what()};
  } catch (const std::exception& error) {
    return {EXIT_FAILURE, error.what()};
  } catch (...) {
    return {EXIT_FAILURE, "an exception of no known type"};
  }
}

/// Standard output, which from now on is standard error for all others.
std::FILE* take_output() {
  std::FILE* own = fdopen(dup(STDOUT_FILENO), "w");
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return own;
}

void tell(std::FILE* to, Answer answer) {
  std::replace(answer.message.begin(), answer.message.end(), '\n', ' ');
  std::fprintf(to, "%d %s\n", answer.code, answer.message.c_str());
  std::fflush(to);
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGPROF, hang);
  std::FILE* answers = take_output();
  if (argc == 3) {
    limit_processor_time();
    tell(answers, answer_to(argv[1], argv[2]));
    return 0;
  }
  for (std::string line; std::getline(std::cin, line);) {
    const std::size_t space = line.find(' ');
    limit_processor_time();
    tell(answers, answer_to(line.substr(0, space), line.substr(space + 1)));
  }
  return 0;
}
