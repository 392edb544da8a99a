#pragma once
/// What explicit_rk integrates: the unknowns of the bodies themselves.

#include <string>

#include "hydrodae/linalg/saddle_point.h"

namespace hydrodae::integrate {

/// The coordinates of the bodies themselves: x = y, with all multipliers. Another space is that of
/// the joints, with the same functions (joint_space.h).
class BodySpace {
public:
  explicit BodySpace(linalg::Equations& equations) : e_(equations), saddle_(equations) {}
  Index size() const { return e_.system.lambda0; } ///< of what the method integrates in x
  void enter(double t, const VectorX& y, const VectorX& yp, VectorX& x, VectorX& xp) {
    x = y;
    xp = yp;
    e_.accept(t, y, yp);
  }
  void follow() {}
  bool rates(double t, VectorX& x, VectorX& xp) { return saddle_.accelerations(t, x, xp); }
  bool project(double t, VectorX& x) { return saddle_.project(t, x); }
  bool close(double t, VectorX& x, const VectorX&) {
    saddle_.close(t, x);
    return true;
  }
  void accept(double t, const VectorX& x, const VectorX& xp) { e_.accept(t, x, xp); }
  static bool leave(double, const VectorX& x, const VectorX& xp, VectorX& y, VectorX& yp) {
    y = x;
    yp = xp;
    return true;
  }
  static const VectorX& of_bodies(const VectorX&, const VectorX& change) { return change; }
  static constexpr bool is_of_bodies = true;
  const std::string& jam() const { return saddle_.jam(); }
  static linalg::Statistics statistics() { return {}; }

private:
  linalg::Equations& e_;
  linalg::SaddlePoint saddle_;
};

} // namespace hydrodae::integrate
