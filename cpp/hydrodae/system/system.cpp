#include "hydrodae/system/system.h"

#include <algorithm>

#include "hydrodae/system/declare.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/turning.h"

namespace hydrodae::system {

System::System() = default;
System::~System() = default;
System::System(const System&) = default;
System::System(System&&) noexcept = default;
System& System::operator=(const System&) = default;
System& System::operator=(System&&) noexcept = default;

void number(System& s) {
  s.n_q = s.n_u = s.n_z = s.n_norms = 0;
  for (BodyData& b : s.bodies) {
    b.q0 = s.n_q;
    s.n_q += b.n_position;
    if (b.rotation == BodyData::Rotation::free)
      b.norm = s.n_norms++;
  }
  s.u0 = s.n_q;
  for (BodyData& b : s.bodies) {
    b.u0 = s.u0 + s.n_u;
    s.n_u += b.n_active;
  }
  s.z0 = s.u0 + s.n_u;
  for (ElementList& list : s.elements) {
    list.z0 = s.z0 + s.n_z;
    s.n_z += static_cast<Index>(list.laws->unknowns.size());
  }
  s.hydro.z0 = s.z0 + s.n_z;
  s.n_z += s.hydro.n_states();
  s.memory0 = s.z0 + s.n_z - s.hydro.visit([](const auto& rung) { return rung.n_condensed(); });
  s.states = declare(s).states;
  s.lambda0 = s.z0 + s.n_z;
  s.n_rows = 0;
  for_each_row(s, [&](Row& row, bool) { row.number = s.n_rows++; });
  set_groups(s);
  follow_rotations(s);
}

bool System::has_waves() const {
  return std::any_of(elements.begin(), elements.end(),
                     [](const ElementList& list) { return list.laws->waves().omega.size() > 0; });
}

void calm(System& s) {
  for (ElementList& list : s.elements)
    if (auto without = list.laws->calm())
      list.laws = std::move(without);
}

} // namespace hydrodae::system
