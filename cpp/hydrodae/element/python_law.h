#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Law as a function of the calling program: load (width,) at t, x (width,), v (width,). It must
/// not throw; values that are not numbers end the run.
using Function = std::function<void(double t, const double* x, const double* v, double* load)>;

/// Law that evaluates a function; derivatives by central differences with a step of h = 6e-6 |x|
/// (error 1e-10 for a smooth law).
template <int w> struct FunctionLaw {
  Function function;

  void operator()(const In<double>& in, const Out<double>& out) const {
    function(in.t, in.x, in.v, out.load);
  }
  void operator()(const In<Dual>& in, const Out<Dual>& out) const {
    std::array<double, 2 * w> x;
    for (int k = 0; k < 2 * w; ++k)
      x[k] = in.x[k].a; // v follows x
    std::array<double, w> value, slope;
    function(in.t, x.data(), x.data() + w, value.data());
    for (int i = 0; i < w; ++i)
      out.load[i] = value[i];
    for (int k = 0; k < 2 * w; ++k) {
      difference(in.t, x, k, slope);
      for (int i = 0; i < w; ++i)
        out.load[i].b += slope[i] * in.x[k].b;
    }
  }

  template <class J> void jacobian(const In<double>& in, J& j) const {
    std::array<double, 2 * w> x;
    std::copy(in.x, in.x + 2 * w, x.begin());
    std::array<double, w> slope;
    for (int k = 0; k < 2 * w; ++k) {
      difference(in.t, x, k, slope);
      for (int i = 0; i < w; ++i)
        j(i, k) = slope[i];
    }
  }

private:
  void difference(double t, std::array<double, 2 * w>& x, int k, std::array<double, w>& out) const {
    constexpr double part = 6e-6, least = 1e-4;
    const double at = x[k], h = part * std::max(std::abs(at), least);
    std::array<double, w> before;
    x[k] = at - h;
    function(t, x.data(), x.data() + w, before.data());
    x[k] = at + h;
    function(t, x.data(), x.data() + w, out.data());
    x[k] = at;
    for (int i = 0; i < w; ++i)
      out[i] = (out[i] - before[i]) / (2.0 * h);
  }
};

/// Load along the free motion of a joint by a Python function of t, s, s'.
struct PythonLoad {
  static constexpr std::string_view type = "python_load";
  static constexpr std::string_view doc = "Load along a joint by a Python function f(t, s, s').";
  static constexpr Port port = Port::along_joint;
  static constexpr bool timed = true;
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  Function function; ///< function set by the program

  FunctionLaw<1> law() const { return {function}; }

  template <class P = PythonLoad> static Fields<P> fields() {
    return {
        {"name", &P::name, "-",
         "Name of this force in the results; its function f(t, s, s') is given to "
         "hydrodae.run(..., "
         "forces={name: function}).",
         true},
        {"joint", &P::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
    };
  }
};

/// Force and moment about the centre of gravity of a body by a Python function of t, xi, twist (6
/// each, earth axes).
struct PythonWrench {
  static constexpr std::string_view type = "python_wrench";
  static constexpr std::string_view doc =
      "Force and moment on a body by a Python function f(t, displacement, twist).";
  static constexpr Port port = Port::on_body;
  static constexpr bool timed = true;
  std::string name;
  std::string body;
  Function function; ///< function set by the program

  FunctionLaw<6> law() const { return {function}; }

  template <class P = PythonWrench> static Fields<P> fields() {
    return {
        {"name", &P::name, "-",
         "Name of this force in the results; its function f(t, displacement, twist) is given to "
         "hydrodae.run(..., forces={name: function}).",
         true},
        {"body", &P::body, "-", "Body that is loaded.", true},
    };
  }
};

} // namespace hydrodae::element
