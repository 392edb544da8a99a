#pragma once
/// Line at rest.

#include "hydrodae/line/line_model.h"

namespace hydrodae::line {

/// Line with the ends at x (3 n_points,), in water without waves.
struct LineAtRest {
  VectorX ends;       ///< x
  VectorX z;          ///< (6 n_unknown,) states at rest
  VectorX load;       ///< (3 n_points,) load on the ends [N]
  MatrixX slope;      ///< (3 n_points, 3 n_points) d load / dx
  double tension = 0; ///< largest tension [N]
};

/// Approximate shape of a hanging line (line_shape.cpp): a catenary if one fits; with a free end
/// straight down, then along the seabed towards `free_end`; (3 n_unknown,).
VectorX line_shape(const LineModel& model, const double* x, const Vector3& free_end);

/// Line at rest by Newton's method on the places of the nodes from a catenary shape. Steps shrink
/// where it does not converge (pseudo-transient continuation: Kelley and Keyes, SIAM J. Numer.
/// Anal. 35 (1998) 508). Friction of the seabed does not act at rest. Throws ModelError about
/// `name`.
/// @param before  line at rest with its ends elsewhere, as the start of the search; or null
LineAtRest line_at_rest(const LineModel& model, const sea::WaveField& sea, const double* x,
                        const Vector3& free_end, const std::string& name, bool with_slope,
                        const LineAtRest* before = nullptr);

} // namespace hydrodae::line
