#pragma once
/// Interpolation between the headings of a database.

#include <optional>
#include <utility>

#include "hydrodae/core/types.h"

namespace hydrodae::hydro {

/// Interpolates over headings. The force on a body that is short against the wave, its phase taken
/// off, is 1, cos b and sin b; a longer one adds further harmonics. Hence harmonics of the heading
/// are fitted to the table by least squares, as many as its widest gap g resolves (order < pi / g;
/// Groechenig 1992, Math. Comp. 59), and a cubic spline goes through what they leave: exact at the
/// headings of the table, and between them for any body of revolution.
///
/// Headings whose last is the first, a full turn on, close a circle: the spline is periodic, and
/// equal steps make trigonometric interpolation, with the harmonic that alternates from heading to
/// heading of an even number of them. Others are a fan: order one (none for two
/// headings) and a natural spline.
class Headings {
public:
  /// `heading` ascending [rad], at least one.
  explicit Headings(VectorX heading) : Headings(std::move(heading), true) {}

  /// The heading as an angle within the table (turned by full turns), or nothing if it lies more
  /// than 1e-4 rad outside. A table of one heading covers that one only.
  std::optional<double> covered(double heading) const;

  /// Weights of the headings of the table, (nh,), at a heading from `covered`.
  VectorX weights(double heading) const;

  /// How the table tests itself: every other heading is left out (the ends of a fan stay), and the
  /// forces there are interpolated from the rest. Rows: what that misses, from the forces (n, nh).
  /// Of four headings all round the row is the amplitude of their one spare harmonic, cos 2 b.
  /// Empty for fewer headings and for a fan of three, which give no check of themselves.
  const MatrixX& misses() const { return misses_; }

  /// The share of the largest force over the headings by which forces between them may be off, from
  /// the largest miss, likewise a share: half the step leaves about a quarter of it (natural
  /// spline) down to its square (harmonics), hence miss max(1/3, min(1, 2 miss)). Without misses:
  /// of two headings, g apart, what a straight line misses of cos b at the middle, 1 - cos(g / 2);
  /// else 0.
  double doubt(double miss) const;

  const VectorX& table() const { return heading_; } ///< (nh,) [rad]
  bool round() const { return round_; }

private:
  Headings(VectorX heading, bool tested);
  std::optional<Headings> thinned() const;
  MatrixX own_misses() const;
  bool equal_steps() const;
  Eigen::Index functions() const { return 2 * order_ + 1 + (alternates_ ? 1 : 0); }
  VectorX basis(double heading) const; ///< 1, cos, sin, cos 2, sin 2 ... (functions,)

  VectorX heading_;
  bool round_ = false;
  Eigen::Index count_ = 0; ///< number of different headings, without the last one of a circle
  Eigen::Index order_ = 0;
  bool alternates_ = false; ///< cos(count b / 2) is one of the basis
  MatrixX harmonics_;       ///< coefficients of the basis from the forces (functions, count)
  MatrixX rest_;            ///< remainder after the harmonics (count, count)
  MatrixX misses_;
  MatrixX bending_; ///< second derivatives of the spline through it (count, count) [1/rad2]
};

} // namespace hydrodae::hydro
