#pragma once
/// Drives of constraints that are Python functions.

#include <array>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <pybind11/stl.h>

#include "hydrodae/model/scene.h"

namespace hydrodae::bindings {

namespace py = pybind11;

/// Functions of time by the name of their constraint: t -> (f, f', f'').
using Drives = std::map<std::string, py::function>;

/// Calls Python from inside the residual. Solvers written in C are on the way: an exception waits
/// until the run, which ends on values that are no numbers, has come back.
class PythonDrives {
public:
  /// A copy of the scene that has the functions.
  model::Scene join(const model::Scene& scene, const Drives& drives) {
    model::Scene out = scene;
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
  std::array<double, 3> value(const py::function& call, double t) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
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
