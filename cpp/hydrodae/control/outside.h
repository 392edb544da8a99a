#pragma once
/// Controllers whose law comes from outside: Python functions, FMUs and other programs.

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

struct Outside : Sampled {
  static constexpr Arity arity = {};
  using Make = std::function<std::unique_ptr<Law>(const Terminals&)>;
  Make make;       ///< makes the law of one run
  Make make_again; ///< makes the law of a second run of the same scene; empty if it cannot restart

  std::unique_ptr<Law> law(const Place& place) const {
    if (make)
      return make(place.terminals);
    throw ModelError("controller." + name,
                     "controller " + in_quotes(name) +
                         " is a Python function, which nobody "
                         "gave; run the case as hydrodae.run(case, controllers={\"" +
                         name + "\": function})");
  }
};

struct Python : Outside {
  static constexpr std::string_view type = "python";
  static constexpr std::string_view doc = "A Python function or object, given to the run.";

  template <class C = Python> static Fields<C> fields() {
    return usual_fields<C>(Inputs::optional);
  }
};

struct Fmu : Outside {
  static constexpr std::string_view type = "fmu";
  static constexpr std::string_view doc = "An FMU for co-simulation (fmi-standard.org).";
  std::string file;
  std::vector<std::string> fmu_inputs, fmu_outputs, parameters;
  std::vector<double> parameter_values, fmu_factors;
  std::vector<std::string> text_parameters, text_values;
  std::string path; ///< path of that file, resolved from the folder of the case

  std::optional<Fault> fault() const {
    const auto unequal = [](const char* key, std::size_t n, const char* other, std::size_t wanted) {
      return n == wanted
                 ? std::optional<Fault>()
                 : Fault{key, in_quotes(key) + " must have as many as " + in_quotes(other) + ": " +
                                  std::to_string(wanted) + ", it has " + std::to_string(n)};
    };
    for (const std::optional<Fault>& fault :
         {unequal("fmu_inputs", fmu_inputs.size(), "inputs", inputs.size()),
          unequal("fmu_outputs", fmu_outputs.size(), "outputs", outputs.size()),
          unequal("parameter_values", parameter_values.size(), "parameters", parameters.size()),
          unequal("text_values", text_values.size(), "text_parameters", text_parameters.size())})
      if (fault)
        return fault;
    return fmu_factors.empty()
               ? std::optional<Fault>()
               : unequal("fmu_factors", fmu_factors.size(), "outputs", outputs.size());
  }

  template <class C = Fmu> static Fields<C> fields() {
    return usual_fields<C>(Inputs::optional) +
           Fields<C>{
               {"file", &C::file, "-", "FMU for co-simulation, version 2.0 or 3.0 of FMI.", true},
               {"fmu_inputs", &C::fmu_inputs, "-", "Its input for each of `inputs`."},
               {"fmu_outputs", &C::fmu_outputs, "-", "Its output for each of `outputs`.", true},
               {"fmu_factors", &C::fmu_factors, "unit of the output per that of the FMU",
                "What each of these is multiplied by; default 1."},
               {"parameters", &C::parameters, "-",
                "Numbers, booleans (0 or 1) and enumerations of it that are set before the start."},
               {"parameter_values", &C::parameter_values, "as the FMU says", "Their values."},
               {"text_parameters", &C::text_parameters, "-",
                "Strings of it that are set before the start."},
               {"text_values", &C::text_values, "-", "Their values."},
           };
  }
};

struct Tcp : Outside {
  static constexpr std::string_view type = "tcp";
  static constexpr std::string_view doc = "Another program, over TCP/IP in lock-step.";
  std::string protocol = "hydrodae", role = "server", host = "127.0.0.1";
  int port = 50000;
  double timeout = 10.0, connect_timeout = 60.0;

  template <class C = Tcp> static Fields<C> fields() {
    return usual_fields<C>(Inputs::optional) +
           Fields<C>{
               {"protocol",
                &C::protocol,
                "-",
                "hydrodae: a handshake with names and units, then numbered frames; hotint: bare "
                "numbers with a flag (docs/tcp.md).",
                false,
                any_value,
                {"hydrodae", "hotint"}},
               {"role",
                &C::role,
                "-",
                "server: the other program connects to the run; client: the run connects to it.",
                false,
                any_value,
                {"server", "client"}},
               {"host", &C::host, "-",
                "Address at which a server listens, or to which a client connects."},
               {"port", &C::port, "-", "TCP port.", false, between(1, 65535)},
               {"timeout", &C::timeout, "s", "Longest wait for an answer.", false,
                more_than(0, 1e6)},
               {"connect_timeout", &C::connect_timeout, "s",
                "Longest wait for the other program to be there.", false, more_than(0, 1e6)},
           };
  }
};

} // namespace hydrodae::control
