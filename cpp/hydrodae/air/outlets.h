#pragma once
#include "hydrodae/air/impulse.h"
#include "hydrodae/air/measured_turbine.h"
#include "hydrodae/air/porous_plug.h"
#include "hydrodae/air/valve.h"
#include "hydrodae/air/wells.h"

namespace hydrodae::air {

/// Table [[outlet]]. A new type is one header and one entry here.
using AnyOutlet =
    OneOf<Outlet, Orifice, PorousPlug, Valve, Wells, Impulse, Biradial, MeasuredTurbine>;

} // namespace hydrodae::air
