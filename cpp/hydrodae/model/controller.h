#pragma once
/// Sampled controllers of a case.

#include "hydrodae/control/bang_bang.h"
#include "hydrodae/control/declutching.h"
#include "hydrodae/control/latching.h"
#include "hydrodae/control/outside.h"
#include "hydrodae/control/pid.h"
#include "hydrodae/control/reactive.h"
#include "hydrodae/control/table.h"
#include "hydrodae/core/one_of.h"

namespace hydrodae::model {

/// Table [[controller]]. A new type is one header in control/ and one entry here.
using Controller = OneOf<control::Sampled, control::Pid, control::Reactive, control::Resistive,
                         control::BangBang, control::Latching, control::Declutching, control::Table,
                         control::Python, control::Tcp, control::Fmu>;

} // namespace hydrodae::model
