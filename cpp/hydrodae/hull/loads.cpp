#include "hydrodae/hull/loads.h"

#include <algorithm>

namespace hydrodae::hull {
namespace {

constexpr int batch = 128; ///< points at a time; all of their lists stay in the first cache
using List = Eigen::Array<double, Eigen::Dynamic, 1, 0, batch, 1>;
using Lists = Eigen::Array<double, Eigen::Dynamic, 6, 0, batch, 6>;

/// [w, x cross w] of points: the load of unit pressure, but for its sign.
void wrenches(const Columns& x, const Columns& w, int first, int n, Lists& out) {
  const auto in = [&](const Columns& c, int j) { return c.col(j).segment(first, n); };
  out.resize(n, 6);
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    out.col(j) = in(w, j);
    out.col(3 + j) = in(x, k) * in(w, l) - in(x, l) * in(w, k);
  }
}

/// Loads of points, and what they give to the gradient as points of the rigid body whose weights
/// turn with it: -sum [w, x cross w] [g, x cross g]^T, g the gradient of the whole pressure.
Loads sum_points(const WetPoints& points, double weight, bool still, Matrix6* gradient) {
  Loads sum;
  Lists arms, moved;
  List pressure;
  for (int first = 0; first < points.size; first += batch) {
    const int n = std::min(batch, points.size - first);
    wrenches(points.x, points.weight, first, n, arms);
    pressure = (-weight) * points.height.segment(first, n);
    for (int i = 0; i < 6; ++i) {
      sum.hydrostatic[i] -= (arms.col(i) * pressure).sum();
      if (!still)
        sum.dynamic[i] -= (arms.col(i) * points.dynamic.segment(first, n)).sum();
    }
    if (!gradient)
      continue;
    const auto x = [&](int j) { return points.x.col(j).segment(first, n); };
    moved.resize(n, 6);
    if (still) {
      // g = (0, 0, -rho g): columns 0, 1 and 5 vanish, column 2 is a sum of areas.
      for (int i = 0; i < 6; ++i) {
        (*gradient)(i, 2) += weight * arms.col(i).sum();
        (*gradient)(i, 3) += weight * (arms.col(i) * x(1)).sum();
        (*gradient)(i, 4) -= weight * (arms.col(i) * x(0)).sum();
      }
      continue;
    }
    for (int j = 0; j < 3; ++j)
      moved.col(j) = points.dynamic_gradient.col(j).segment(first, n);
    moved.col(2) -= weight;
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      moved.col(3 + j) = x(k) * moved.col(l) - x(l) * moved.col(k);
    }
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        (*gradient)(i, j) -= (arms.col(i) * moved.col(j)).sum();
  }
  return sum;
}

/// What the slides of the corners of a clipped triangle give to the gradient in waves. In still
/// water it is zero: there the rule is exact, and the pressure vanishes where the corners slide.
/// With its area A and the middles x_m of its edges, F = -A/3 n sum p_m and M = -A/3 sum p_m x_m
/// cross n.
void add_slides(const Facet& facet, const Workspace& work, double weight, Matrix6& gradient) {
  const WetPoints& points = work.points;
  const auto corner = [&](int i) -> const Corner& {
    return work.corners[static_cast<std::size_t>(facet.corner[static_cast<std::size_t>(i % 3)])];
  };
  if (!corner(0).slides && !corner(1).slides && !corner(2).slides)
    return;
  const Vector3& n = facet.normal;
  PoseRow area_by_pose = PoseRow::Zero();
  for (int i = 0; i < 3; ++i)
    if (corner(i).slides) {
      const Vector3 across = 0.5 * cross<double>(corner(i + 1).x - corner(i + 2).x, n);
      area_by_pose.noalias() += across.transpose() * corner(i).slide;
    }
  const Vector3 first_weight = points.weight.row(facet.point).transpose();
  const double third = dot(first_weight, n); // A/3
  PoseRow pressures = PoseRow::Zero();       // sum of A/3 dp_m + p_m dA/3
  for (int m = 0; m < 3; ++m) {
    const int at = facet.point + m;
    const Corner &a = corner(m), &b = corner(m + 1);
    const Vector3 x = points.x.row(at).transpose();
    const double p = points.dynamic[at] - weight * points.height[at];
    Vector3 g = points.dynamic_gradient.row(at).transpose();
    g[2] -= weight;
    PoseRow by_pose = (p / 3.0) * area_by_pose;
    const auto move = [&](const PoseRows& slide) {
      by_pose.noalias() += (0.5 * third) * g.transpose() * slide;
      // d x_m cross n, slide by slide
      for (int j = 0; j < 3; ++j)
        gradient.row(3 + j) -= (0.5 * third * p) * (slide.row((j + 1) % 3) * n[(j + 2) % 3] -
                                                    slide.row((j + 2) % 3) * n[(j + 1) % 3]);
    };
    if (a.slides)
      move(a.slide);
    if (b.slides)
      move(b.slide);
    pressures += by_pose;
    gradient.bottomRows<3>().noalias() -= cross(x, n) * by_pose;
  }
  gradient.topRows<3>().noalias() -= n * pressures;
}

} // namespace

Loads loads(const Mesh& mesh, const WaveField& field, const Pose& pose, const Instant& instant,
            Workspace& work, Matrix6* gradient) {
  find_wet_surface(mesh, field, pose, instant, gradient && !field.still(), work);
  const double weight = field.water().density * field.water().gravity;
  WetPoints& points = work.points;
  if (!field.still()) {
    Columns& g = points.dynamic_gradient;
    FieldLists out{points.dynamic.data()};
    if (gradient)
      out = {points.dynamic.data(), g.col(0).data(), g.col(1).data(), g.col(2).data()};
    field.pressure(
        work.view,
        {points.size, points.x.col(0).data(), points.x.col(1).data(), points.height.data()}, out);
  }
  if (gradient)
    gradient->setZero();
  const Loads sum = sum_points(points, weight, field.still(), gradient);
  if (gradient) {
    for (const Facet& facet : work.facets)
      add_slides(facet, work, weight, *gradient);
    // The load turns with the body.
    const Vector6 whole = sum.hydrostatic + sum.dynamic;
    gradient->topRightCorner<3, 3>() -= skew<double>(whole.head<3>());
    gradient->bottomRightCorner<3, 3>() -= skew<double>(whole.tail<3>());
  }
  return sum;
}

} // namespace hydrodae::hull
