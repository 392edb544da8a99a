#pragma once
/// Names of unknowns and equations in messages.

#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// Sets the names of all unknowns and rows; needs the layout.
void set_names(Regime& regime);

} // namespace hydrodae::system
