#include "hydrodae/simulation.h"

#include <algorithm>
#include <array>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include <pybind11/numpy.h>
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

/// Functions of time by the name of their constraint: t -> (f, f', f''); or laws by the name of
/// their force: t, x, v -> load.
using Functions = std::map<std::string, py::function>;

/// Calls Python from inside the residual. Solvers written in C are on the way: an exception waits
/// until the run, which ends on values that are no numbers, has come back.
class PythonFunctions {
public:
  /// A copy of the scene that has the functions.
  model::Scene join(const model::Scene& scene, const Functions& drives, const Functions& forces) {
    model::Scene out = scene;
    std::apply([&](auto&... list) { (join_laws(list, forces), ...); }, out.forces);
    for (model::Constraint& c : out.constraints)
      if (const auto found = drives.find(c.name); found != drives.end())
        c.drive.function = [this, call = &found->second](double t) {
          return value(*call, t); // the map outlives the run; copies need no GIL
        };
    return out;
  }

  /// With the GIL held.
  void raise_failure() {
    if (failure_)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  bool failed() const { return failure_ != nullptr; }

private:
  template <class F> void join_laws(std::vector<F>& list, const Functions& forces) {
    if constexpr (requires(F force) { force.function; })
      for (F& force : list)
        if (const auto found = forces.find(force.name); found != forces.end())
          force.function = [this, call = &found->second](double t, const double* x, const double* v,
                                                         double* load) {
            load_of<element::width(F::port)>(*call, t, x, v, load);
          };
  }

  template <int w>
  void load_of(const py::function& call, double t, const double* x, const double* v, double* load) {
    std::fill(load, load + w, nan);
    if (failure_)
      return;
    const py::gil_scoped_acquire gil;
    try {
      if constexpr (w == 1) {
        *load = call(t, *x, *v).template cast<double>();
      } else {
        const auto out = call(t, py::array_t<double>(w, x), py::array_t<double>(w, v))
                             .template cast<std::array<double, w>>();
        std::copy(out.begin(), out.end(), load);
      }
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  std::array<double, 3> value(const py::function& call, double t) {
    if (!failure_) {
      const py::gil_scoped_acquire gil;
      try {
        return call(t).cast<std::array<double, 3>>();
      } catch (...) {
        failure_ = std::current_exception();
      }
    }
    return {nan, nan, nan};
  }

  std::exception_ptr failure_;
};

py::dict as_dict(const RunStatistics& s) {
  using namespace py::literals;
  return py::dict(
      "status"_a = s.status, "steps"_a = s.steps, "residual_calls"_a = s.residual_calls,
      "jacobian_calls"_a = s.jacobian_calls, "newton_iterations"_a = s.newton_iterations,
      "error_test_failures"_a = s.error_test_failures,
      "convergence_failures"_a = s.convergence_failures, "events"_a = s.events,
      "end_time"_a = s.end_time, "setup_time"_a = s.setup_time, "solver_time"_a = s.solver_time,
      "wall_time"_a = s.wall_time, "estimated_error"_a = s.estimated_error,
      "estimated_error_of"_a = s.estimated_error_of,
      "estimated_error_time"_a = s.estimated_error_time, "verified_error"_a = s.verified_error,
      "verified_error_of"_a = s.verified_error_of, "verified_error_time"_a = s.verified_error_time,
      "unknowns"_a = s.unknowns, "nonzeros"_a = s.nonzeros, "notes"_a = s.notes);
}

py::dict run(const model::Scene& scene, const std::string& output, const py::object& callback,
             const Functions& drives, const Functions& forces, bool verify) {
  PythonProgress progress(callback);
  PythonFunctions functions;
  const model::Scene driven = functions.join(scene, drives, forces);
  RunStatistics statistics;
  try {
    const py::gil_scoped_release release;
    statistics = simulate(
        driven, output,
        [&](double time, double end_time) {
          return !functions.failed() && progress(time, end_time);
        },
        verify);
  } catch (const ModelError& error) {
    functions.raise_failure();
    throw CaseError(model::located(scene, error));
  } catch (const Error&) {
    functions.raise_failure();
    throw;
  }
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
    throw CaseError(model::located(scene, error));
  }
}

} // namespace

void bind_simulation(py::module_& module) {
  module.def(
      "examine", &examine_scene, py::arg("scene"), py::arg("drives"), py::arg("forces"),
      "The scene as a tree, its unknowns, mobility and redundant rows. Raises CaseError when "
      "the joints cannot\nbe closed.");
  module.def("simulate", &run, py::arg("scene"), py::arg("output"), py::arg("progress"),
             py::arg("drives"), py::arg("forces"), py::arg("verify") = false,
             "Run `scene` and write `output`; `progress(t, t_end)` returns False to stop;\n"
             "`drives` has a function t -> (f, f', f'') for every constraint in "
             "`scene.python_drives`;\n"
             "`forces` a law t, x, v -> load for every force in `scene.python_forces`;\n"
             "`verify`: compares the motion with that of a second, more exact run.\n\n"
             "Returns the status (\"completed\" or \"interrupted\") and the statistics of the "
             "solver. Raises\nSolverError when the integration fails; the file then holds what was "
             "computed.");
}

} // namespace hydrodae::bindings
