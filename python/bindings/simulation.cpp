#include "hydrodae/simulation.h"

#include <array>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <pybind11/stl.h>

#include "bindings.h"
#include "functions.h"
#include "hydrodae/core/error.h"
#include "hydrodae/ensemble/lanes.h"
#include "hydrodae/ensemble/together.h"

namespace py = pybind11;

namespace hydrodae::bindings {
namespace {

/// Asks Python at every output sample whether to go on. An exception in Python ends the run and is
/// raised after the results file is closed; Ctrl-C ends it as "interrupted".
class PythonProgress {
public:
  explicit PythonProgress(py::object callback) : callback_(std::move(callback)) {}

  bool operator()(double time, double end_time) {
    const py::gil_scoped_acquire gil;
    try {
      if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
      if (callback_.is_none())
        return true;
      const py::object answer = callback_(time, end_time);
      return answer.is_none() || answer.cast<bool>();
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_KeyboardInterrupt))
        failure_ = std::current_exception();
    } catch (const py::cast_error&) {
      failure_ = std::current_exception();
    }
    return false;
  }

  /// With the GIL held.
  void raise_failure() {
    if (failure_)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

private:
  py::object callback_;
  std::exception_ptr failure_;
};

py::dict as_dict(const RunStatistics& s) {
  using namespace py::literals;
  py::dict until;
  if (!s.accuracy.time.empty())
    for (const accuracy::MoverError& m : s.accuracy.movers)
      until[py::str(m.name)] = m.reproducible_until;
  return py::dict(
      "status"_a = s.status, "steps"_a = s.steps, "residual_calls"_a = s.residual_calls,
      "jacobian_calls"_a = s.jacobian_calls, "newton_iterations"_a = s.newton_iterations,
      "error_test_failures"_a = s.error_test_failures,
      "convergence_failures"_a = s.convergence_failures, "events"_a = s.events,
      "end_time"_a = s.end_time, "setup_time"_a = s.setup_time, "solver_time"_a = s.solver_time,
      "wall_time"_a = s.wall_time, "at_rest"_a = s.at_rest, "unknowns"_a = s.unknowns,
      "nonzeros"_a = s.nonzeros, "notes"_a = s.notes, "reproducible_until"_a = until);
}

py::dict run(const model::Scene& scene, const std::string& output, const py::object& callback,
             const Functions& drives, const Functions& forces, const Functions& controllers,
             const Functions& again, const std::string& verify, double checkpoint, bool resume,
             bool strict) {
  PythonProgress progress(callback);
  PythonFunctions functions;
  const model::Scene driven = functions.join(scene, drives, forces, controllers, again);
  RunStatistics statistics;
  try {
    const py::gil_scoped_release release;
    statistics = simulate(driven, output,
                          [&](double time, double end_time) {
                            return !functions.failed() && progress(time, end_time);
                          },
                          {verify, checkpoint, resume, strict});
  } catch (const ModelError& error) {
    functions.raise_failure();
    throw model::located(scene, error);
  } catch (const Error&) {
    functions.raise_failure();
    throw;
  }
  if (statistics.status != "completed") // else a function failed in the second run, with a note
    functions.raise_failure();
  progress.raise_failure();
  return as_dict(statistics);
}

std::string examine_scene(const model::Scene& scene, const Functions& drives,
                          const Functions& forces) {
  PythonFunctions functions;
  try {
    const std::string text = examine(functions.join(scene, drives, forces));
    functions.raise_failure();
    return text;
  } catch (const ModelError& error) {
    functions.raise_failure();
    throw model::located(scene, error);
  }
}

py::dict count_scene(const model::Scene& scene) {
  py::dict out;
  try {
    for (const auto& [name, number] : count(scene))
      out[py::str(name)] = number;
  } catch (const ModelError& error) {
    throw model::located(scene, error);
  }
  return out;
}

/// A signal: terms (channel, component, factor, power), start, turning points?, frequency.
using Signal = std::tuple<std::vector<std::tuple<std::string, std::string, double, int>>, double,
                          bool, double>;

std::vector<ensemble::Wanted> wanted_of(const std::vector<Signal>& signals) {
  std::vector<ensemble::Wanted> out;
  for (const auto& [terms, start, turns, frequency] : signals) {
    ensemble::Wanted wanted{{}, start, turns, frequency};
    for (const auto& [channel, component, factor, power] : terms)
      wanted.terms.push_back({channel, component, factor, power});
    out.push_back(std::move(wanted));
  }
  return out;
}

py::dict dict_of(const ensemble::Measured& m) {
  using namespace py::literals;
  const auto array = [](const std::vector<double>& x) {
    return py::array_t<double>(static_cast<py::ssize_t>(x.size()), x.data());
  };
  return py::dict("unit"_a = m.unit, "start"_a = m.start, "duration"_a = m.duration,
                  "mean"_a = m.mean, "mean_square"_a = m.mean_square, "last"_a = m.last,
                  "least"_a = m.least, "most"_a = m.most, "span_means"_a = array(m.span_means),
                  "span_squares"_a = array(m.span_squares), "times"_a = array(m.times),
                  "turns"_a = array(m.turns), "cosine"_a = m.cosine, "sine"_a = m.sine);
}

/// Attributes and measured signals of each scene, or the reason why it has to be run alone.
py::list run_together(const std::vector<const model::Scene*>& scenes,
                      const std::vector<Signal>& signals) {
  std::vector<ensemble::Answer> answers;
  const std::vector<ensemble::Wanted> wanted = wanted_of(signals);
  {
    const py::gil_scoped_release release;
    answers = ensemble::simulate_together(scenes, wanted);
  }
  py::list out;
  for (const ensemble::Answer& answer : answers) {
    if (!answer.alone.empty()) {
      out.append(answer.alone);
      continue;
    }
    py::dict attributes;
    for (const auto& [name, value] : answer.attributes)
      attributes[py::str(name)] = std::visit([](const auto& x) { return py::cast(x); }, value);
    py::list measured;
    for (const ensemble::Measured& each : answer.measured)
      measured.append(dict_of(each));
    if (!signals.empty())
      attributes["measured"] = measured;
    out.append(attributes);
  }
  return out;
}

} // namespace

void bind_simulation(py::module_& module) {
  module.def("count", &count_scene, py::arg("scene"),
             "Sizes of the equations of the scene, by name. Raises CaseError.");
  module.def(
      "examine", &examine_scene, py::arg("scene"), py::arg("drives"),
      py::arg("forces") = Functions{},
      "The scene as a tree, its unknowns, mobility and redundant rows. Raises CaseError when "
      "the joints cannot\nbe closed.");
  module.attr("lanes") = ensemble::width;
  module.def(
      "simulate_together", &run_together, py::arg("scenes"),
      py::arg("signals") = std::vector<Signal>{},
      "Run scenes that differ in their seas and take-offs side by side, without samples.\n\n"
      "`signals`: sums of terms (channel, component, factor, power), each with its start [s] "
      "(negative: the\nend of the ramp), whether its turning points are wanted, and the frequency "
      "[Hz] of a Fourier integral\n(negative: none).\n\n"
      "Returns for each scene the attributes that its results file would have, with one dict a "
      "signal under\n\"measured\". Where a scene has to be run by itself, the reason as text.");
  module.def(
      "simulate", &run, py::arg("scene"), py::arg("output"), py::arg("progress"), py::arg("drives"),
      py::arg("forces") = Functions{}, py::arg("controllers") = Functions{},
      py::arg("again") = Functions{}, py::arg("verify") = "", py::arg("checkpoint") = -1.0,
      py::arg("resume") = false, py::arg("strict") = false,
      "Run `scene` and write `output`; `progress(t, t_end)` returns False to stop;\n"
      "`drives` has a function t -> (f, f', f'') for every constraint in "
      "`scene.python_drives`;\n"
      "`forces` a law t, x, v -> load for every force in `scene.python_forces`;\n"
      "`controllers` a function t, inputs ... -> outputs for every one in "
      "`scene.python_controllers`;\n"
      "`again`: those of `controllers` that a second run may call, by name;\n"
      "`verify`: method of the second run, by which the error is estimated; empty: the same;\n"
      "`checkpoint`: wall time between checkpoints [s], negative: none; `resume`: goes on "
      "from one;\n"
      "`strict`: an estimate of the error is needed.\n\n"
      "Returns the status (\"completed\" or \"interrupted\") and the statistics of the "
      "solver. Raises\nSolverError when the integration fails; the file then holds what was "
      "computed.");
}

} // namespace hydrodae::bindings
