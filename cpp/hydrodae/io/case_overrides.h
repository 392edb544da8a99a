#pragma once
#include <toml++/toml.h>

#include "hydrodae/io/case_reader.h"

namespace hydrodae::io {

/// Puts the values of `overrides` into a parsed case. Keys and values that come from here carry
/// "--set <key>" as their place. Throws CaseError on a value that is no TOML and on the name of an
/// entry ([[body]], [[joint]], [[constraint]], [[force]]) that does not exist.
void apply_overrides(toml::table& root, const Overrides& overrides);

} // namespace hydrodae::io
