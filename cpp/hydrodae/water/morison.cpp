#include "hydrodae/water/morison.h"

namespace hydrodae::water {

Fields<Morison> Morison::fields() {
  using M = Morison;
  return {
      {"name", &M::name, "-", "Name of this element in the results, as a force.", true},
      {"body", &M::body, "-", "Body that carries it.", true},
      {"point", &M::point, "m", "Where a point element is in the reference pose, world axes."},
      {"point_a", &M::point_a, "m", "First end of a member in the reference pose, world axes."},
      {"point_b", &M::point_b, "m", "Second end of a member in the reference pose, world axes."},
      {"diameter", &M::diameter, "m", "Diameter D of a member, or of a point element (a sphere).",
       false, more_than(0)},
      {"area", &M::area, "m2", "Drag area A of a point element without a diameter.", false,
       at_least(0)},
      {"volume", &M::volume, "m3", "Volume V of a point element without a diameter.", false,
       at_least(0)},
      {"drag_coefficient", &M::drag_coefficient, "-",
       "C_d: drag across a member (over D dl), or of a point element (over A).", false,
       at_least(0)},
      {"drag_axial", &M::drag_axial, "-",
       "C_dt: drag along a member, over its wetted surface pi D dl.", false, at_least(0)},
      {"added_mass_coefficient", &M::added_mass_coefficient, "-",
       "C_a, across a member; the inertia force is rho V (1 + C_a). Without this key there is no "
       "inertia force: right for a body whose database holds excitation and added mass.",
       false, at_least(0)},
      {"added_mass_axial", &M::added_mass_axial, "-", "C_at: added mass along a member.", false,
       at_least(0)},
      {"segments", &M::segments, "-",
       "Pieces of equal length into which a member is cut ; 20 by default.", false,
       between(1, 1000)},
      {"surface",
       &M::surface,
       "-",
       "Up to which surface the element is wet: the mean one (as in linear theory), or the "
       "instantaneous one, where the water above z = 0 moves as at z = 0.",
       false,
       any_value,
       {"mean", "instantaneous"}},
  };
}

} // namespace hydrodae::water
