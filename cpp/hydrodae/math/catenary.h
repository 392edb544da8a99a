#pragma once
/// Elastic lines that hang between an anchor and a fairlead in one vertical plane, at rest: parts
/// of constant weight with loads between them, on a flat bed or free of it (Irvine, Cable
/// Structures, MIT Press 1981, section 2.2; Jonkman, NREL/TP-500-41958, appendix B).

#include <cmath>
#include <span>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Along unstretched length, from the anchor up.
struct LinePart {
  double length = 0.0;    ///< unstretched [m], > 0
  double weight = 0.0;    ///< in the fluid, per unstretched length [N/m]; negative: buoyant
  double stiffness = 0.0; ///< EA [N], > 0
};

struct Catenary {
  std::vector<LinePart> parts; ///< at least one
  std::vector<double>
      loads;             ///< (n_parts - 1,) weight of what hangs between two parts [N]; < 0: buoy
  bool bed = false;      ///< flat, at the height of the anchor; carries the line from there on
  double friction = 0.0; ///< of the bed, coefficient [-]

  double length() const; ///< unstretched [m]
};

/// What holds the line at the fairlead, X [m] off the anchor and Z [m] above it.
struct CatenaryHold {
  double horizontal = 0.0; ///< H, of the pull on the fairlead, towards the anchor [N]
  double vertical = 0.0;   ///< V, downwards [N]
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero(); ///< d(H, V) / d(X, Z) [N/m]
  double out_of_plane = 0.0;                           ///< H / X [N/m]
  double on_bed = 0.0;                                 ///< unstretched length that lies [m]
  double anchor_horizontal = 0.0; ///< pull on the anchor, towards the fairlead [N]
  double anchor_vertical = 0.0;   ///< upwards [N]; negative: the line hangs below the anchor
  double tension() const { return std::hypot(horizontal, vertical); } ///< at the fairlead [N]
};

/// Where a fairlead is that pulls with (H, V), and how that changes.
struct CatenaryReach {
  double X = 0.0, Z = 0.0;                               ///< [m]
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();    ///< d(X, Z) / d(H, V) [m/N]
  double on_bed = 0.0;                                   ///< unstretched length that lies [m]
  double anchor_horizontal = 0.0, anchor_vertical = 0.0; ///< [N]
};

/// @param H > 0
CatenaryReach reach(const Catenary& line, double H, double V);

/// Number of parts, from the anchor up, that may lie on a bed: those below the lowest of what
/// floats, buoy or part. What is above hangs free of the bed.
std::size_t may_lie(const Catenary& line);

/// The balance for a fairlead at X >= 0, Z (Z >= 0 over a bed), to rounding. A line that is longer
/// than its way down to the bed and along it has H = 0 there. Not a number where Z < 0 over a bed,
/// or where what floats, or a part above it, comes down to the bed.
/// Pure: the same answer for the same place.
CatenaryHold hold(const Catenary& line, double X, double Z);

/// Energy that the line stores, by its stretch and its height [J], over a bed without friction: H
/// and V are its derivatives by X and Z. Zero is where nothing else is.
double energy(const Catenary& line, const CatenaryHold& found, double X, double Z);

/// A point of the line.
struct LinePoint {
  double s = 0.0;       ///< unstretched length from the anchor [m]
  double x = 0.0;       ///< from the anchor [m]
  double z = 0.0;       ///< above it [m]
  double tension = 0.0; ///< [N]
};

/// The line that `found` holds at X, at ascending unstretched lengths `s` from the anchor.
std::vector<LinePoint> profile(const Catenary& line, const CatenaryHold& found, double X,
                               std::span<const double> s);

} // namespace hydrodae
