#include "hydrodae/simulation.h"

#include <exception>
#include <functional>
#include <utility>

#include <pybind11/stl.h>

#include "bindings.h"
#include "hydrodae/core/error.h"

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
  return py::dict(
      "status"_a = s.status, "steps"_a = s.steps, "residual_calls"_a = s.residual_calls,
      "jacobian_calls"_a = s.jacobian_calls, "newton_iterations"_a = s.newton_iterations,
      "error_test_failures"_a = s.error_test_failures,
      "convergence_failures"_a = s.convergence_failures, "end_time"_a = s.end_time,
      "setup_time"_a = s.setup_time, "solver_time"_a = s.solver_time, "wall_time"_a = s.wall_time,
      "unknowns"_a = s.unknowns, "nonzeros"_a = s.nonzeros, "notes"_a = s.notes);
}

py::dict run(const model::Scene& scene, const std::string& output, const py::object& callback) {
  PythonProgress progress(callback);
  RunStatistics statistics;
  try {
    const py::gil_scoped_release release;
    statistics = simulate(scene, output, std::ref(progress));
  } catch (const ModelError& error) {
    throw CaseError(model::located(scene, error));
  }
  progress.raise_failure();
  return as_dict(statistics);
}

std::string examine_scene(const model::Scene& scene) {
  try {
    return examine(scene);
  } catch (const ModelError& error) {
    throw CaseError(model::located(scene, error));
  }
}

} // namespace

void bind_simulation(py::module_& module) {
  module.def(
      "examine", &examine_scene, py::arg("scene"),
      "The scene as a tree, its unknowns, mobility and redundant rows. Raises CaseError when "
      "the joints cannot\nbe closed.");
  module.def("simulate", &run, py::arg("scene"), py::arg("output"), py::arg("progress"),
             "Run `scene` and write `output`; `progress(t, t_end)` returns False to stop.\n\n"
             "Returns the status (\"completed\" or \"interrupted\") and the statistics of the "
             "solver. Raises\nSolverError when the integration fails; the file then holds what was "
             "computed.");
}

} // namespace hydrodae::bindings
