#pragma once
#include "hydrodae/core/one_of.h"
#include "hydrodae/model/coupler.h"
#include "hydrodae/model/driven_coordinate.h"
#include "hydrodae/model/stop.h"

namespace hydrodae::model {

/// Table [[constraint]]. A new type is one header and one entry here.
using Constraint = OneOf<Conditional, DrivenCoordinate, Coupler, Stop>;

} // namespace hydrodae::model
