#pragma once
/// Clipping of a plane polygon at the zero of a level that is linear along its edges, with the
/// derivatives of the new corners by the pose of the body.

#include <array>

#include "hydrodae/math/rotation.h"

namespace hydrodae::hull {

/// Derivatives by the pose: displacement of the body's origin [m], then rotation vector [rad], both
/// in world axes: delta x = delta r + delta phi x (x - r) for a point of the body.
using PoseRow = Eigen::Matrix<double, 1, 6>;
using PoseRows = Eigen::Matrix<double, 3, 6>;

/// Derivative by the pose of a field with gradient g at a point x of the body, x relative to the
/// body's origin.
inline PoseRow carried(const Vector3& g, const Vector3& x) {
  PoseRow row;
  row << g.transpose(), cross(x, g).transpose();
  return row;
}

/// Corner of a polygon. A corner on the surface slides over the body as the body moves.
struct Corner {
  Vector3 x;             ///< relative to the body's origin, world axes [m]
  double level;          ///< wet where negative [m]
  bool slides;           ///< false: `slide` is zero and not set
  PoseRow level_by_pose; ///< whole derivative of the level, slide included
  PoseRows slide;        ///< d x / d pose beyond the motion of the body
};

/// A convex polygon. A triangle cut twice has at most 5 corners.
struct Polygon {
  int size = 0;
  std::array<Corner, 6> corner;
};

/// Corner at level 0 between a (wet) and b (dry): x = a + s (b - a), s = l_a / (l_a - l_b).
template <bool gradient> void between(const Corner& a, const Corner& b, Corner& out) {
  const double span = a.level - b.level, s = a.level / span;
  out.x = a.x + s * (b.x - a.x);
  out.level = 0.0;
  out.slides = gradient;
  if constexpr (gradient) {
    const PoseRow by_pose = (a.level * b.level_by_pose - b.level * a.level_by_pose) / (span * span);
    out.slide.noalias() = (b.x - a.x) * by_pose;
    if (a.slides)
      out.slide += (1.0 - s) * a.slide;
    if (b.slides)
      out.slide += s * b.slide;
  }
}

/// The part of a convex polygon where the level is negative.
template <bool gradient> void clip(const Polygon& in, Polygon& out) {
  out.size = 0;
  for (int i = 0; i < in.size; ++i) {
    const Corner& a = in.corner[static_cast<std::size_t>(i)];
    const Corner& b = in.corner[static_cast<std::size_t>(i + 1 == in.size ? 0 : i + 1)];
    const bool a_wet = a.level < 0.0, b_wet = b.level < 0.0;
    const auto next = [&]() -> Corner& { return out.corner[static_cast<std::size_t>(out.size++)]; };
    if (a_wet) {
      Corner& kept = next();
      kept.x = a.x;
      kept.slides = a.slides;
      if constexpr (gradient)
        if (a.slides)
          kept.slide = a.slide;
    }
    if (a_wet && !b_wet)
      between<gradient>(a, b, next());
    else if (!a_wet && b_wet)
      between<gradient>(b, a, next());
  }
}

} // namespace hydrodae::hull
