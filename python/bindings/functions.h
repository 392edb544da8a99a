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

#include "hydrodae/control/law.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::bindings {

namespace py = pybind11;

/// Functions of time by the name of their constraint: t -> (f, f', f''); or laws by the name of
/// their force: t, x, v -> load; or controllers by their name: t, inputs ... -> outputs.
using Functions = std::map<std::string, py::function>;

/// A controller that is a Python function or object. An exception in it waits in `failure` until
/// the run, which ends on a SolverError, has come back.
class PythonLaw final : public control::Law {
public:
  PythonLaw(std::string name, const py::function& call, std::exception_ptr& failure,
            const control::Terminals& terminals)
      : name_(std::move(name)), call_(call), failure_(failure) {
    guarded(0.0, [&] {
      if (py::hasattr(call_, "signals"))
        call_.attr("signals")(named(terminals.inputs), named(terminals.outputs));
      if (py::hasattr(call_, "reset"))
        call_.attr("reset")();
    });
  }

  void sample(double t, std::span<const double> in, std::span<double> out) override {
    guarded(t, [&] {
      py::tuple arguments(in.size() + 1);
      arguments[0] = t;
      for (std::size_t k = 0; k < in.size(); ++k)
        arguments[k + 1] = in[k];
      take(call_(*arguments), out);
    });
  }

  /// What `state()` returns, for `restore(values)`, where the object has both.
  std::string state() override {
    State out;
    guarded(0.0, [&] {
      if (has_state())
        out.values = state_of(call_.attr("state")());
    });
    return to_bytes(out);
  }
  void set(const std::string& bytes) override {
    guarded(0.0, [&] {
      const auto from = from_bytes<State>(bytes);
      if (has_state())
        call_.attr("restore")(from.values);
    });
  }

private:
  struct State {
    std::vector<double> values;
  };

  bool has_state() const { return py::hasattr(call_, "state") && py::hasattr(call_, "restore"); }

  template <class Work> void guarded(double t, Work&& work) {
    const py::gil_scoped_acquire gil;
    try {
      work();
    } catch (...) {
      failure_ = std::current_exception();
      throw SolverError(t, {Reason::controller,
                            "the Python controller " + in_quotes(name_) + " has failed",
                            "controllers/" + name_});
    }
  }

  /// Names and units.
  static py::list named(const std::vector<control::Terminal>& terminals) {
    py::list out;
    for (const control::Terminal& t : terminals)
      out.append(py::make_tuple(t.name, t.unit));
    return out;
  }

  std::vector<double> state_of(const py::object& told) const {
    try {
      return told.cast<std::vector<double>>();
    } catch (const py::cast_error&) {
      throw CaseError("controllers: state() of " + in_quotes(name_) +
                      " must return a list of numbers, got " + py::repr(told).cast<std::string>());
    }
  }

  void take(const py::object& answer, std::span<double> out) const {
    try {
      if (py::isinstance<py::array>(answer)) {
        const py::array array = answer;
        if (std::string_view("biuf").find(array.dtype().kind()) != std::string_view::npos &&
            array.ndim() <= 1 && static_cast<std::size_t>(array.size()) == out.size()) {
          const auto values =
              py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
          std::copy_n(values.data(), out.size(), out.begin());
          return;
        }
      } else if (out.size() == 1 && PyNumber_Check(answer.ptr()) != 0) {
        out[0] = py::float_(answer).cast<double>();
        return;
      }
      if (py::isinstance<py::sequence>(answer) && !py::isinstance<py::array>(answer)) {
        const auto values = answer.cast<std::vector<double>>();
        if (values.size() == out.size()) {
          std::copy(values.begin(), values.end(), out.begin());
          return;
        }
      }
    } catch (const std::exception&) { // reported below
    }
    throw CaseError("controllers: the function of " + in_quotes(name_) + " must return " +
                    (out.size() == 1 ? "one number" : std::to_string(out.size()) + " numbers") +
                    ", got " + py::repr(answer).cast<std::string>());
  }

  std::string name_;
  const py::function& call_; ///< the map outlives the run
  std::exception_ptr& failure_;
};

/// Calls Python from inside the residual. Solvers written in C are on the way: an exception waits
/// until the run, which ends on values that are no numbers, has come back.
class PythonFunctions {
public:
  /// A copy of the scene that has the functions.
  model::Scene join(const model::Scene& scene, const Functions& drives, const Functions& forces,
                    const Functions& controllers = {}, const Functions& again = {}) {
    model::Scene out = scene;
    const auto maker = [this](const std::string& name, const Functions& of) {
      control::Outside::Make make;
      if (const auto found = of.find(name); found != of.end())
        make = [this, name, call = &found->second](const control::Terminals& terminals) {
          return std::make_unique<PythonLaw>(name, *call, failure_, terminals);
        };
      return make;
    };
    for (model::Controller& c : out.controllers)
      if (auto* law = c.as<control::Python>())
        if (law->make = maker(law->name, controllers); law->make)
          law->make_again = maker(law->name, again);
    std::apply([&](auto&... list) { (join_laws(list, forces), ...); }, out.forces->lists);
    for (model::Constraint& c : out.constraints)
      if (const auto found = drives.find(c->name);
          c.as<model::DrivenCoordinate>() && found != drives.end())
        c.as<model::DrivenCoordinate>()->drive.function = [this, call = &found->second](double t) {
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
