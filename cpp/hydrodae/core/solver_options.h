#pragma once
/// Table [solver] of a case: method and accuracy of the integration.

#include <optional>
#include <string>

#include "hydrodae/core/field.h"
#include "hydrodae/core/methods.h"

namespace hydrodae {

struct SolverOptions {
  static constexpr std::string_view doc =
      "Which method integrates the scene, how exactly, and what ends a run that goes wrong.";
  std::string method = "auto";
  std::string formulation = "stabilised";
  std::string start = "given";
  double end_time = 0.0;
  double rtol = 1e-6;
  double step = 0.0;
  double max_step = 0.0;
  int max_order = 5;
  int order = 0;
  double spectral_radius = 0.8;
  double baumgarte_time = 0.0;
  std::optional<double> energy_guard;
  bool branch_guard = true;
  std::string accuracy = "two_runs";
  double tolerance_assembly = 1e-6;
  bool force = false;
  std::optional<double> length_scale;
  std::optional<double> time_scale;

  template <class O = SolverOptions> static Fields<O> fields() {
    return {
        {"method", &O::method, "-",
         "Integrator: BDF (ida), implicit Runge-Kutta (radau, gauss, lobatto_iiic), generalised "
         "alpha on the Lie group, or projected explicit Runge-Kutta; auto: explicit_rk, radau or "
         "ida as suits the scene, and another of them where one cannot continue.",
         false, any_value, method_names()},
        {"formulation",
         &O::formulation,
         "-",
         "Equations of the constraints: stabilised index 2 (Gear, Gupta, Leimkuhler), plain index "
         "2, index 3, or index 1; the last three for comparisons.",
         false,
         any_value,
         {"stabilised", "index_2", "index_3", "index_1"}},
        {"start",
         &O::start,
         "-",
         "Start from the given pose, or at rest from the static equilibrium in still water near "
         "it.",
         false,
         any_value,
         {"given", "equilibrium"}},
        {"end_time", &O::end_time, "s", "End of the run.", true, more_than(0, longest_time)},
        {"rtol", &O::rtol, "-",
         "Local error tolerance relative to the scales of the scene (see length_scale, "
         "time_scale); with a fixed step it bounds Newton iterations and events only.",
         false, Range{1e-13, 1e-1, false}},
        {"step", &O::step, "s",
         "Fixed step; 0: the method chooses. Needed by gauss, lobatto_iiic and generalized_alpha.",
         false, at_least(0, longest_time)},
        {"max_step", &O::max_step, "s", "Longest step; 0: no limit.", false,
         at_least(0, longest_time)},
        {"max_order", &O::max_order, "-", "Highest order of the BDF method.", false, between(1, 5)},
        {"order", &O::order, "-",
         "Order of a Runge-Kutta method: radau 1, 3, .. 19, gauss 2, 4, .. 20, lobatto_iiic 2, 4, "
         ".. 18, explicit_rk 5 or 8; 0: radau chooses among 5, 9 and 13, gauss takes 6, "
         "lobatto_iiic 4, explicit_rk 8.",
         false, between(0, 20)},
        {"spectral_radius", &O::spectral_radius, "-",
         "Of generalized_alpha for infinitely fast modes: 1 no damping, 0 most.", false,
         between(0, 1)},
        {"baumgarte_time", &O::baumgarte_time, "s",
         "Time in which index 1 takes back a gap (Baumgarte); 0: never.", false,
         at_least(0, longest_time)},
        {"energy_guard", &O::energy_guard, "-",
         "A run ends as failed when the energy balance is off by more than this part of the energy "
         "exchanged; 0: no guard. By default 0.01; at a singular pose of a closed loop 0.01 "
         "sqrt(rtol), at least 1e-5, or 5e-4 with fixed steps. Mechanisms that drives guide "
         "altogether may miss ten times as much, since their reactions take and give it.",
         false, at_least(0, 1e6)},
        {"branch_guard", &O::branch_guard, "-",
         "A run of a scene with closed loops ends as failed when its velocities jump though "
         "nothing "
         "strikes: at a singular pose the motion left its branch."},
        {"accuracy",
         &O::accuracy,
         "-",
         "Estimate of the error of the motion, body by body: two_runs compares the run with a "
         "second "
         "one at 10 rtol, or at twice the fixed step, which runs in a second thread; none: no "
         "estimate.",
         false,
         any_value,
         {"two_runs", "none"}},
        {"tolerance_assembly", &O::tolerance_assembly, "-",
         "Allowed misalignment of joints, as part of the body's lever (its farthest joint or "
         "radius of gyration), or of one radian. Below it joints count as exact, and rows that "
         "follow from others are left out. Above it they would lock the mechanism and are refused.",
         false, between(1e-12, 0.1)},
        {"force", &O::force, "-",
         "Run what is known to fail, for comparisons: a pair of method and formulation, radiation "
         "that is not passive, joints that are out of line with each other."},
        {"length_scale", &O::length_scale, "m",
         "Length that the tolerance of positions refers to; default: from the bodies and joints.",
         false, between(1e-12, 1e12)},
        {"time_scale", &O::time_scale, "s",
         "Time that turns the position scale into the velocity scale; default: from gravity, "
         "else from the start.",
         false, between(1e-12, 1e12)},
    };
  }
};

} // namespace hydrodae
