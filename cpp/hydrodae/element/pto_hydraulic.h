#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Hydraulic power take-off along the free motion of a joint: a cylinder with equal areas, four
/// check valves, two gas accumulators and a motor between them (Falcao, Ocean Engineering 34 (2007)
/// 2021-2032; the valves without losses).
///
///   f = -A (p_H - p_L) r(s')            [N], or [N m] if the motion is a rotation
///   Q = A s' r(s'),  r = tanh(s' / s'_v)       flow through the valves [m3/s]
///   Q_m = G (p_H - p_L)                 flow through the motor [m3/s]
///   p_H' = n p_H / V_H (Q - Q_m),  p_L' = -n p_L / V_L (Q - Q_m)
///   V_i = V_i0 (p_i0 / p_i)^(1/n)       volume of the gas [m3]
///
/// On a rotation, A is the area of the piston times its lever [m3/rad]. Energy is conserved: the
/// absorbed power -f s' is the sum of the motor power Q_m (p_H - p_L) and the power stored in the
/// gas.
struct PtoHydraulic {
  static constexpr std::string_view type = "pto_hydraulic";
  static constexpr std::string_view doc = "Hydraulic power take-off along a joint: cylinder, check "
                                          "valves, two gas accumulators, motor.";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_states = 2;
  static constexpr int n_signals = 1;
  static constexpr std::string_view at_rest_only =
      "its damping there is A (p_H - p_L) / valve_rate, far above that at working rates";
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double area = 0.0;
  double motor_conductance = 0.0;
  double pressure_high = 0.0, pressure_low = 0.0;
  double volume_high = 0.0, volume_low = 0.0;
  double polytropic = 1.4;
  double valve_rate = 0.0;

  const PtoHydraulic& law() const { return *this; }

  std::array<Unknown, n_states> unknowns() const {
    return {{{"pressure_high", "Pa", 0.01 * pressure_high, pressure_high},
             {"pressure_low", "Pa", 0.01 * pressure_low, pressure_low}}};
  }

  template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
    using std::exp, std::log;
    const S &rate = *in.v, &high = in.z[0], &low = in.z[1], drop = high - low;
    const S open = opening(rate), flow = S(area) * rate * open - S(in.signals[0]) * drop;
    const S n(polytropic);
    const S gas_high = S(volume_high) * exp(log(S(pressure_high) / high) / n);
    const S gas_low = S(volume_low) * exp(log(S(pressure_low) / low) / n);
    *out.load = S(-area) * drop * open;
    out.z_dot[0] = n * high / gas_high * flow;
    out.z_dot[1] = -n * low / gas_low * flow;
  }

  /// Energy of the gas, zero at the start: int p dV = (p V - p0 V0) / (n - 1), isothermal p0 V0
  /// log(p/p0).
  double energy(const In<double>& in) const {
    return stored(in.z[0], pressure_high, volume_high) + stored(in.z[1], pressure_low, volume_low);
  }

  static std::vector<Quantity> channels() {
    return {{"motor_flow", "m3/s", "Flow through the motor."},
            {"motor_power", "W", "Power that the motor takes from the fluid."}};
  }
  void observe(const In<double>& in, const Out<const double>&, double* values) const {
    const double drop = in.z[0] - in.z[1];
    values[0] = in.signals[0] * drop;
    values[1] = in.signals[0] * drop * drop;
  }

  /// Inputs that a program may change during the run: displacement of the motor times its speed.
  static std::vector<Signal> inputs() { return {{"motor_conductance", "m3/(s Pa)", 0.0}}; }
  std::array<double, n_signals> start_signals() const { return {motor_conductance}; }

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const {
    if (pressure_low > pressure_high)
      return Fault{"pressure_low", "the low accumulator has more pressure than the high one"};
    return {};
  }

  template <class P = PtoHydraulic> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of this force in the results.", true},
        {"joint", &P::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"area", &P::area, "m2 or m3/rad", "Area A of the piston; on a rotation times its lever.",
         true, more_than(0)},
        {"motor_conductance", &P::motor_conductance, "m3/(s Pa)",
         "Flow G through the motor for each pascal between the accumulators.", true, at_least(0)},
        {"pressure_high", &P::pressure_high, "Pa",
         "Pressure of the high accumulator at the start, absolute.", true, more_than(0)},
        {"pressure_low", &P::pressure_low, "Pa",
         "Pressure of the low accumulator at the start, absolute.", true, more_than(0)},
        {"volume_high", &P::volume_high, "m3", "Gas in the high accumulator at the start.", true,
         more_than(0)},
        {"volume_low", &P::volume_low, "m3", "Gas in the low accumulator at the start.", true,
         more_than(0)},
        {"polytropic", &P::polytropic, "-",
         "Exponent n of the gas: 1 isothermal, 1.4 adiabatic (nitrogen).", false, between(1, 2)},
        {"valve_rate", &P::valve_rate, "m/s or rad/s",
         "Rate s'_v about which the check valves change over.", true, more_than(0)},
    };
  }

private:
  /// Opening of the valves, tanh(s' / s'_v), with exponentials that cannot overflow.
  template <class S> S opening(const S& rate) const {
    using std::abs, std::exp;
    const S small = exp(S(-2.0 / valve_rate) * abs(rate));
    const S size = (S(1) - small) / (S(1) + small);
    return rate < S(0) ? -size : size;
  }

  double stored(double p, double p0, double v0) const {
    const double ratio = p / p0;
    return polytropic == 1.0
               ? p0 * v0 * std::log(ratio)
               : p0 * v0 * (std::pow(ratio, 1.0 - 1.0 / polytropic) - 1.0) / (polytropic - 1.0);
  }
};

} // namespace hydrodae::element
