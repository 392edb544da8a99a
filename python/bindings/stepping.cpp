#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/eigen.h>

#include "bindings.h"
#include "functions.h"
#include "hydrodae/control/law.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu.h"
#include "hydrodae/cosim/tcp.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::bindings {
namespace {

using run::State;

/// A simulation with the Python functions that drive it.
class Stepper {
public:
  Stepper(const model::Scene& scene, Functions drives, Functions forces, Functions controllers)
      : drives_(std::move(drives)), forces_(std::move(forces)),
        controllers_(std::move(controllers)),
        scene_(functions_.join(scene, drives_, forces_, controllers_)) {
    cosim::join_tcp(scene_);
    cosim::join_fmus(scene_);
    call([&] { simulation_.emplace(scene_); });
  }

  double advance(double limit) {
    call([&] { simulation_->advance(limit); });
    return simulation_->time();
  }

  State state() {
    State out;
    call([&] { out = simulation_->state(); });
    return out;
  }

  void restore(const State& state) {
    call([&] { simulation_->restore(state); });
  }

  std::vector<double> read(const std::string& channel) {
    std::vector<double> out;
    call([&] {
      const std::span<const double> values = simulation_->read(channel);
      out.assign(values.begin(), values.end());
    });
    return out;
  }

  void close() {
    call([&] { simulation_->close(); });
  }

  void write(const std::string& input, double value) { simulation_->write(input, value); }

  const run::Simulation& simulation() const { return *simulation_; }

private:
  /// Errors of the scene get their place in the file; exceptions of drives come before all others.
  template <class Work> void call(Work&& work) {
    try {
      const py::gil_scoped_release release;
      work();
    } catch (const ModelError& error) {
      functions_.raise_failure();
      throw model::located(scene_, error);
    } catch (const control::Stopped& stopped) {
      functions_.raise_failure();
      const std::string end = number_text(simulation_->scene().solver.end_time);
      throw control::Stopped("stopped at t = " + number_text(simulation_->time()) + " s of " + end +
                             " s: " + stopped.what());
    } catch (const Error&) {
      functions_.raise_failure();
      throw;
    }
    functions_.raise_failure();
  }

  Functions drives_, forces_, controllers_;
  PythonFunctions functions_;
  model::Scene scene_;
  std::optional<run::Simulation> simulation_;
};

std::vector<std::tuple<std::string, int, std::string>> channels(const Stepper& s) {
  std::vector<std::tuple<std::string, int, std::string>> out;
  for (const Channel& c : s.simulation().channels())
    out.emplace_back(c.path, c.width, c.unit);
  return out;
}

std::map<std::string, double> inputs(const Stepper& s) {
  std::map<std::string, double> out;
  for (const run::Input& input : s.simulation().inputs())
    out[input.name] = *input.value;
  return out;
}

std::map<std::string, std::string> input_units(const Stepper& s) {
  std::map<std::string, std::string> out;
  for (const run::Input& input : s.simulation().inputs())
    out[input.name] = input.unit;
  return out;
}

} // namespace

void bind_stepping(py::module_& module) {
  py::class_<State>(module, "State", "All that a run is at an accepted instant; a value.")
      .def_readonly("time", &State::time)
      .def_property_readonly("y", [](const State& s) { return VectorX(s.y); })
      .def_property_readonly("yp", [](const State& s) { return VectorX(s.yp); })
      .def("__eq__", [](const State& a, const State& b) { return a == b; })
      .def("__copy__", [](const State& s) { return State(s); })
      .def("__deepcopy__", [](const State& s, const py::dict&) { return State(s); })
      .def(py::pickle([](const State& s) { return py::bytes(s.bytes()); },
                      [](const py::bytes& b) { return State::from_bytes(std::string(b)); }));
  py::class_<Stepper>(module, "Stepper", "A run that Python drives, step by step.")
      .def(py::init<const model::Scene&, Functions, Functions, Functions>(), py::arg("scene"),
           py::arg("drives"), py::arg("forces") = Functions{}, py::arg("controllers") = Functions{})
      .def("advance", &Stepper::advance, py::arg("limit"),
           "One accepted step, to `limit` [s] at most; returns the time reached.")
      .def("state", &Stepper::state)
      .def("restore", &Stepper::restore, py::arg("state"))
      .def("read", &Stepper::read, py::arg("channel"), "The values of a channel now.")
      .def("close", &Stepper::close, "Notifies controllers that are other programs of the end.")
      .def("write", &Stepper::write, py::arg("input"), py::arg("value"),
           "Holds an input at a value from now on.")
      .def_property_readonly("time", [](const Stepper& s) { return s.simulation().time(); })
      .def_property_readonly("finished", [](const Stepper& s) { return s.simulation().finished(); })
      .def_property_readonly("channels", &channels, "(name, width, unit) of each.")
      .def_property_readonly("inputs", &inputs, "What each input is held at.")
      .def_property_readonly("input_units", &input_units, "Unit of each input.");
}

} // namespace hydrodae::bindings
