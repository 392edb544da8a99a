#pragma once
/// Names of unknowns and equations, as a person reads them in messages.

#include <string>

#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// What a constraint row holds, for people: "gap along x".
std::string row_name(const joint::BasicRow& row);

/// Names of all unknowns and rows; needs the layout.
void set_names(Regime& regime);

} // namespace hydrodae::system
