#pragma once
/// Names of unknowns and equations, as a person reads them in messages.

#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// Names of all unknowns and rows; needs the layout.
void set_names(Regime& regime);

} // namespace hydrodae::system
