#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/math/spline.h"

namespace hydrodae {

/// A function of time that a coordinate follows, with its first two derivatives.
///
///   f(t) = constant + rate t + ramp(t) amplitude sin(2 pi t / period + phase) + table(t)
///          + function(t)
///
/// ramp(t) = (1 - cos(pi t / T)) / 2 for t < T = `ramp`, then 1. The table is a natural cubic
/// spline. The function comes from the program that runs the scene, where `python` asks for it.
struct Drive {
  static constexpr std::string_view doc =
      "Function of time: constant + rate t + ramp(t) amplitude sin(2 pi t / period + phase) + "
      "table + function; ramp(t) = (1 - cos(pi t / ramp)) / 2, then 1.";
  double constant = 0.0;
  double rate = 0.0;
  double amplitude = 0.0;
  double period = 0.0; ///< 0: not given
  double phase = 0.0;
  double ramp = 0.0;
  std::vector<double> time, values;
  CubicSpline table; ///< table of `time` and `values`, made by `prepare`
  bool python = false;
  std::function<std::array<double, 3>(double)> function; ///< f, f', f''; must not throw

  void prepare() {
    if (!time.empty())
      table = CubicSpline(time, values);
  }

  /// Text "0.1 + 0.2 sin(2 pi t / 5 - 30 deg) + a table of 12 points".
  std::string text() const;

  /// Returns whether f changes other than linearly.
  bool moves() const { return amplitude != 0.0 || !table.empty() || static_cast<bool>(function); }

  /// f, f', f'' at time t [s].
  std::array<double, 3> operator()(double t) const {
    std::array<double, 3> f{constant + rate * t, rate, 0.0};
    if (amplitude != 0.0) {
      const double w = 2.0 * pi / period, s = std::sin(w * t + phase), c = std::cos(w * t + phase);
      std::array<double, 3> r{1.0, 0.0, 0.0};
      if (t < ramp) {
        const double k = pi / ramp;
        r = {0.5 * (1.0 - std::cos(k * t)), 0.5 * k * std::sin(k * t),
             0.5 * k * k * std::cos(k * t)};
      }
      f[0] += amplitude * r[0] * s;
      f[1] += amplitude * (r[1] * s + r[0] * w * c);
      f[2] += amplitude * (r[2] * s + 2.0 * r[1] * w * c - r[0] * w * w * s);
    }
    if (!table.empty()) {
      const std::array<double, 3> y = table(t);
      for (std::size_t k = 0; k < 3; ++k)
        f[k] += y[k];
    }
    if (function) {
      const std::array<double, 3> y = function(t);
      for (std::size_t k = 0; k < 3; ++k)
        f[k] += y[k];
    }
    return f;
  }

  template <class D = Drive> static Fields<D> fields() {
    return {
        {"constant", &D::constant, "m or rad", "Constant part."},
        {"rate", &D::rate, "m/s or rad/s", "Grows linearly with time."},
        {"amplitude", &D::amplitude, "m or rad", "Amplitude of the sine."},
        {"period", &D::period, "s", "Period of the sine.", false, more_than(0, longest_time)},
        {"phase_deg", &D::phase, "deg", "Phase of the sine at t = 0."},
        {"ramp", &D::ramp, "s", "Time over which the sine grows to its amplitude.", false,
         at_least(0, longest_time)},
        {"time", &D::time, "s", "Times of a table, ascending."},
        {"values", &D::values, "m or rad", "Values of the table, joined by a cubic spline."},
        {"python", &D::python, "-",
         "true: a Python function of time, given to hydrodae.run(..., drives={name: function}), is "
         "added."},
    };
  }
};

} // namespace hydrodae
