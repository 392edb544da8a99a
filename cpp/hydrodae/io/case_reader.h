#pragma once
#include <map>
#include <string>

#include "hydrodae/model/scene.h"

namespace hydrodae::io {

/// Dotted key -> TOML value, e.g. {"solver.rtol", "1e-8"} or {"joint.hinge1.initial.angle_deg",
/// "0.5"}; entries of lists ([[body]], [[joint]], [[force]]) are addressed by name.
using Overrides = std::map<std::string, std::string>;

/// Reads and checks a case file and the database it names. Throws CaseError with
/// file:line:column, the key, what was expected and the nearest valid name.
model::Scene read_case(const std::string& path, const Overrides& overrides = {});

/// Parses a case from a string; relative paths in it are relative to `directory`.
model::Scene parse_case(const std::string& text, const std::string& directory,
                        const Overrides& overrides = {}, const std::string& name = "<case>");

/// Reads the tables of a part of a case: keys and values, each by itself; no table is required and
/// nothing is compared with another. Throws CaseError.
void check_tables(const std::string& text);

} // namespace hydrodae::io
