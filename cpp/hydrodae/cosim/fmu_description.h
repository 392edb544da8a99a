#pragma once
/// Model description of an FMU.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/unit.h"
#include "hydrodae/cosim/fmu_values.h"

namespace hydrodae::cosim {

struct FmuVariable {
  std::string name, type, causality; ///< "Real" or "Float64"; "input", "output", "parameter", ...
  FmuType kind = FmuType::other;
  std::optional<unsigned> reference;
  bool is_array = false;
  std::string unit_name;    ///< "bar"; empty if not declared
  std::optional<Unit> unit; ///< unit, if the FMU defines it

  /// Conversion from its unit to that of a signal; empty if it declares no unit, or an unknown one.
  /// Throws CaseError where they are units of different things.
  Conversion to(const std::string& unit_of_signal, const std::string& name_of_signal) const;
};

struct FmuDescription {
  std::string path; ///< path of the FMU
  int version = 0;  ///< version of FMI: 2 or 3
  std::string identifier, token;
  bool saves_states = false; ///< true: states can be got, set and serialised
  std::vector<FmuVariable> variables;

  /// Folder of the shared library for this machine: "binaries/linux64/".
  std::string binaries() const;
  std::string library() const { return binaries() + identifier + ".so"; }

  /// The number, boolean or enumeration, or the string, of this name and causality. Throws
  /// CaseError with the nearest name if it is missing.
  const FmuVariable& find(const std::string& name, const std::string& causality,
                          bool text = false) const;
};

/// Throws CaseError where the file is no FMU for co-simulation of FMI 2.0 or 3.0 with a library for
/// this machine.
FmuDescription describe_fmu(const std::string& path);

} // namespace hydrodae::cosim
