#pragma once
/// Forces of a scene. Files that do not name a type of force include model/scene.h only.

#include <algorithm>
#include <tuple>
#include <type_traits>
#include <vector>

#include "hydrodae/element/bushing.h"
#include "hydrodae/element/constant_load.h"
#include "hydrodae/element/dry_friction.h"
#include "hydrodae/element/end_stop.h"
#include "hydrodae/element/friction_lugre.h"
#include "hydrodae/element/friction_stribeck.h"
#include "hydrodae/element/library_law.h"
#include "hydrodae/element/mooring_matrix.h"
#include "hydrodae/element/pto_general.h"
#include "hydrodae/element/pto_hydraulic.h"
#include "hydrodae/element/pto_lagged.h"
#include "hydrodae/element/pto_linear.h"
#include "hydrodae/element/pto_rotary.h"
#include "hydrodae/element/python_law.h"
#include "hydrodae/element/spring_damper.h"
#include "hydrodae/line/catenary_line.h"
#include "hydrodae/line/line.h"
#include "hydrodae/line/rope.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/water/viscous_damping.h"

namespace hydrodae::model {

/// Kinds of forces, in the order in which the case reader and the system visit them. A new kind
/// needs one header in element/ and one entry here.
using ForceLists =
    std::tuple<std::vector<element::MooringMatrix>, std::vector<element::PtoLinear>,
               std::vector<element::SpringDamper>, std::vector<element::ConstantLoad>,
               std::vector<water::ViscousDamping>, std::vector<element::DryFriction>,
               std::vector<element::PtoHydraulic>, std::vector<element::FrictionLugre>,
               std::vector<element::Bushing>, std::vector<element::PythonLoad>,
               std::vector<element::PythonWrench>, std::vector<element::PtoGeneral>,
               std::vector<element::PtoRotary>, std::vector<element::FrictionStribeck>,
               std::vector<element::EndStop>, std::vector<line::Rope>,
               std::vector<line::CatenaryLine>, std::vector<element::LibraryLoad>,
               std::vector<element::LibraryWrench>, std::vector<line::Line>,
               std::vector<element::PtoLagged>>;

struct Forces {
  ForceLists lists;
};

/// Calls `visit(force)` for every force, type by type.
template <class AnyScene, class Visit> void for_each_force(AnyScene& scene, const Visit& visit) {
  std::apply([&](auto&... list) { (std::ranges::for_each(list, visit), ...); },
             scene.forces->lists);
}

template <class... Force, class Visit>
void for_each_force_type(std::type_identity<std::tuple<std::vector<Force>...>>,
                         const Visit& visit) {
  (visit(std::type_identity<Force>{}), ...);
}

/// Calls `visit(std::type_identity<Force>{})` for the struct of every kind of force.
template <class Visit> void for_each_force_type(const Visit& visit) {
  for_each_force_type(std::type_identity<ForceLists>{}, visit);
}

} // namespace hydrodae::model
