#pragma once
/// Drives of constraints and laws of forces that are Python functions.

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "hydrodae/model/scene.h"

namespace hydrodae::bindings {

namespace py = pybind11;

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

} // namespace hydrodae::bindings
