#pragma once
/// Sampled controllers of a case.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"

namespace hydrodae::control {
class Law;
struct Terminals;
} // namespace hydrodae::control

namespace hydrodae::model {

/// Table [[controller]]: reads channels at fixed instants k T, and holds inputs from k T + delay on
/// (zero-order hold).
struct Controller {
  static constexpr std::string_view doc =
      "A sampled controller: it reads channels, and holds inputs between its instants.";
  std::string name;
  std::string type;
  std::vector<std::string> inputs, outputs;
  double period = 0.0, delay = 0.0, lag = 0.0;
  // pid
  double gain_p = 0.0, gain_i = 0.0, gain_d = 0.0, filter_time = 0.0, target = 0.0;
  std::optional<double> lower, upper, tracking_time;
  // reactive, resistive
  double stiffness = 0.0, damping = 0.0, neutral = 0.0;
  std::optional<double> limit;
  // bang_bang
  double band = 0.0;
  // declutching
  std::optional<double> engaged, free_time;
  double free = 0.0;
  // latching
  std::optional<double> hold_time, hold_load;
  // table
  std::vector<double> at, value;
  // fmu
  std::string file;
  std::vector<std::string> fmu_inputs, fmu_outputs, parameters;
  std::vector<double> parameter_values, fmu_factors;
  std::vector<std::string> text_parameters, text_values;
  std::string path, sha256; ///< of that file, found from the folder of the case
  // tcp
  std::string protocol = "hydrodae", role = "server", host = "127.0.0.1";
  int port = 50000;
  double timeout = 10.0, connect_timeout = 60.0;

  /// Makes the law of one run; given by the program where it is not one of the kernel's own.
  std::function<std::unique_ptr<control::Law>(const control::Terminals&)> make;
  /// Makes another one, for a second run of the same scene; empty where the law of the first cannot
  /// begin anew.
  std::function<std::unique_ptr<control::Law>(const control::Terminals&)> make_again;

  static Fields<Controller> fields(); ///< in controller.cpp
};

/// Keys of a controller of this type; empty where the type is unknown.
std::vector<std::string> controller_keys(const std::string& type);

/// Those that it must have beside what every controller must have.
std::vector<std::string> needed_controller_keys(const std::string& type);

/// Is its law given by the program that makes the run?
bool is_outside(const Controller& controller);

} // namespace hydrodae::model
