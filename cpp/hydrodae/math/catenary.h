#pragma once
/// Elastic lines that hang between an anchor and a fairlead in one vertical plane, at rest: parts
/// of constant weight with loads between them, on a flat bed or free of it (Irvine, Cable
/// Structures, MIT Press 1981, section 2.2; Jonkman, NREL/TP-500-41958, appendix B).
///
/// Buoyancy ends at the surface: a part that crosses it has two weights, a load is a sphere that is
/// partly immersed. The energy of a line stays convex, so its balance is the only one.

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Part of a line along the unstretched length, from the anchor up.
struct LinePart {
  double length = 0.0;    ///< unstretched [m], > 0
  double weight = 0.0;    ///< weight in the fluid per unstretched length [N/m]; negative: buoyant
  double stiffness = 0.0; ///< EA [N], > 0
  double buoyancy = 0.0;  ///< additional weight out of the water [N/m], >= 0
};

/// A body that hangs between two parts: a sphere where it crosses the surface.
struct LineLoad {
  double weight = 0.0;   ///< weight in the fluid [N]; negative: a buoy
  double buoyancy = 0.0; ///< additional weight out of the water [N], >= 0
  double radius = 0.0;   ///< [m], > 0 with buoyancy
};

struct Catenary {
  std::vector<LinePart> parts; ///< parts, at least one
  std::vector<LineLoad> loads; ///< (n_parts - 1,)
  bool bed = false;            ///< true: a flat bed at the height of the anchor carries the line
  double friction = 0.0;       ///< friction coefficient of the bed [-]

  double length() const; ///< unstretched [m]
};

/// Forces at the fairlead, X [m] off the anchor and Z [m] above it.
struct CatenaryHold {
  double horizontal = 0.0; ///< horizontal pull H on the fairlead, towards the anchor [N]
  double vertical = 0.0;   ///< vertical pull V, downwards [N]
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero(); ///< d(H, V) / d(X, Z) of the fairlead [N/m]
  Eigen::Vector2d by_anchor = Eigen::Vector2d::Zero(); ///< -d(H, V) / d(height of anchor) [N/m]
  double anchor_stiffness = 0.0;  ///< -d(anchor_vertical) / d(height of anchor) [N/m]
  double out_of_plane = 0.0;      ///< H / X [N/m]
  double on_bed = 0.0;            ///< unstretched length on the bed [m]
  double anchor_horizontal = 0.0; ///< pull on the anchor, towards the fairlead [N]
  /// Vertical pull on the anchor, upwards [N]; negative: the line hangs below the anchor
  double anchor_vertical = 0.0;
  /// Tension at the fairlead [N]
  double tension() const { return std::hypot(horizontal, vertical); }
};

/// Position of a fairlead with the forces (H, V), with its derivatives.
struct CatenaryReach {
  using Row = Eigen::Vector3d; ///< derivatives by H, V [m/N], and by `above`

  double X = 0.0, Z = 0.0;                               ///< [m]
  Row X_by = Row::Zero(), Z_by = Row::Zero();            ///< derivatives of X and Z
  double on_bed = 0.0;                                   ///< unstretched length on the bed [m]
  double anchor_horizontal = 0.0, anchor_vertical = 0.0; ///< [N]
  Row anchor_vertical_by = Row::Zero();

  Eigen::Matrix2d gradient() const; ///< d(X, Z) / d(H, V) [m/N]
};

/// Height of a fairlead over the surface for a line that is all in the fluid [m].
inline constexpr double deep = -std::numeric_limits<double>::infinity();

/// @param H > 0
/// @param above  height of the fairlead over the surface [m]
CatenaryReach reach(const Catenary& line, double H, double V, double above = deep);

/// Number of parts, from the anchor up, that may lie on a bed: those below the lowest of what
/// floats, buoy or part. What is above hangs free of the bed.
std::size_t may_lie(const Catenary& line);

/// The balance for a fairlead at X >= 0, Z (Z >= 0 over a bed), to rounding. A line that is longer
/// than its way down to the bed and along it has H = 0 there. Not a number where Z < 0 over a bed,
/// where what floats, or a part above it, comes down to the bed, or where a part that floats lies
/// on the surface.
/// Pure: the same answer for the same place.
CatenaryHold hold(const Catenary& line, double X, double Z, double above = deep);

/// Energy that the line stores, by its stretch and its height over the surface, or over the anchor
/// without one [J], over a bed without friction. Forces at its ends are its derivatives.
double energy(const Catenary& line, const CatenaryHold& found, double X, double Z,
              double above = deep);

/// Part with the largest ratio of tension to strength.
struct LinePeak {
  double ratio = 0.0;   ///< ratio of its largest tension to its strength
  std::size_t part = 0; ///< number of the part, from the anchor up
};

/// @param strength  of all parts, or of each [N]
LinePeak peak(const Catenary& line, const CatenaryHold& found, double above,
              std::span<const double> strength);

/// A point of the line.
struct LinePoint {
  double s = 0.0;       ///< unstretched length from the anchor [m]
  double x = 0.0;       ///< horizontal distance from the anchor [m]
  double z = 0.0;       ///< height above the anchor [m]
  double tension = 0.0; ///< [N]
};

/// The line that `found` holds at X, at ascending unstretched lengths `s` from the anchor.
std::vector<LinePoint> profile(const Catenary& line, const CatenaryHold& found, double X,
                               std::span<const double> s, double above = deep);

} // namespace hydrodae
