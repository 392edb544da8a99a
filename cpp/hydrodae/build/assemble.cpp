#include "hydrodae/build/assemble.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/dropped_rows.h"

namespace hydrodae::build {

namespace {

constexpr double at_rest = 1e-12; ///< largest rate that counts as rest, in units of its scale
/// Displacement [levers or rad] too large for closing a small gap
constexpr double far = 0.5;

/// Makes the smallest change of the velocities after which all rates vanish.
void close_velocities(const system::System& s, Constraints& constraints, VectorX& y) {
  VectorX gaps, rates;
  for (int pass = 0; pass < 2; ++pass) { // linear; the second pass removes rounding
    constraints.evaluate(y, gaps, rates);
    if (rates.size() == 0 || rates.cwiseAbs().maxCoeff() < at_rest)
      return;
    const SparseMatrix G = constraints.gradient([&](Index i) { return constraints.holds_rate(i); });
    y.segment(s.u0, s.n_u) += smallest_solution(G, -rates).cwiseProduct(constraints.scale());
  }
}

/// Notes how far closing the joints moved a body; a pose given by the case must not change.
void note_move(system::System& s, const std::vector<BodyStart>& starts, int body, double moved,
               double angle) {
  const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
  if (moved <= 1e-9 * b.length_scale && angle <= 1e-7)
    return;
  const std::string size =
      number_text(moved) + " m and " + number_text(angle * 180.0 / pi) + " deg";
  const bool too_far = moved > far * b.lever || angle > far;
  const bool given = std::any_of(starts.begin(), starts.end(),
                                 [&](const BodyStart& a) { return a.body == body && a.placed; });
  if (too_far && given)
    throw ModelError("body." + b.name + ".initial",
                     "body '" + b.name +
                         "': the initial pose contradicts the joints, which close "
                         "only when it is moved by " +
                         size +
                         "; give a pose near one that they allow, or leave it out and give the "
                         "joints' initial angles or displacements");
  s.notes.push_back("closing the joints moved body '" + b.name + "' by " + size +
                    (too_far ? ": far from where the case puts it, check the start" : ""));
}

/// Writes the pose and velocities of y into the bodies; notes changes.
void write_back(system::System& s, const std::vector<BodyStart>& starts, const VectorX& y) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(y.size());
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    system::BodyData& b = s.bodies[i];
    const system::BodyState<double>& state = ws.bodies[i];
    const Vector4 p = b.rotation == system::BodyData::Rotation::free ? Vector4(state.p.normalized())
                                                                     : b.orientation;
    const double moved = (state.r - b.position).norm();
    const Matrix3 turn = rotation_matrix<double>(b.orientation).transpose() * state.R;
    const double angle = std::acos(std::clamp(0.5 * (turn.trace() - 1.0), -1.0, 1.0));
    note_move(s, starts, static_cast<int>(i), moved, angle);
    b.position = state.r;
    if (b.rotation == system::BodyData::Rotation::about_axis) {
      b.orientation.setZero();
      const double half = 0.5 * y[b.q0 + b.n_translations];
      b.orientation[0] = std::cos(half);
      b.orientation[1 + b.axis] = std::sin(half);
    } else {
      b.orientation = p;
    }
    b.velocity = state.v;
    b.angular_velocity = state.w;
  }
}

/// Checks that gaps of the omitted rows are within the tolerance, too.
void check_dropped(system::System& s, const system::Regime& kept, const VectorX& y,
                   double tolerance) {
  const system::DroppedRows::Gap worst = system::DroppedRows(kept).largest(0.0, y);
  const std::string size = number_text(worst.gap) + " " + worst.unit;
  if (worst.part > tolerance)
    throw ModelError(worst.key,
                     "joints are inconsistent: " + worst.name + " stays open by " + size +
                         ", more than solver.tolerance_assembly = " + number_text(tolerance) +
                         " of the body's arm, when the others close; a tolerance above " +
                         number_text(worst.part) + " lets it give way");
  if (worst.part > 1e-9)
    s.notes.push_back(worst.name + " is open by " + size +
                      " at the start, within "
                      "solver.tolerance_assembly");
}

[[noreturn]] void refuse_gap(Constraints& constraints, const VectorX& y) {
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  Index worst = 0;
  gaps.cwiseAbs().maxCoeff(&worst);
  throw ModelError(constraints.key(worst), "the bodies cannot be moved so that all joints close; " +
                                               constraints.name(worst) + " stays open by " +
                                               number_text(gaps[worst] * constraints.size(worst)) +
                                               (constraints.is_angle(worst) ? " rad" : " m"));
}

} // namespace

void assemble(system::System& s, const Fit& fit, const std::vector<BodyStart>& given) {
  VectorX y;
  {
    const system::Regime all(s);
    y = system::initial_state(all);
    Constraints constraints(all, s.starts);
    if (!find_pose(s, constraints, y))
      refuse_gap(constraints, y);
  }
  drop_dependent_rows(s, y, fit);
  const system::Regime kept(s);
  system::resize(kept, y);
  Constraints constraints(kept, s.starts);
  if (!(close_positions(s, constraints, y).array() < nearly_closed).all())
    refuse_gap(constraints, y);
  check_dropped(s, kept, y, fit.tolerance);
  start_velocities(s, given, constraints, y);
  write_back(s, given, y);
}

bool close(const system::Regime& s, VectorX& y) {
  Constraints constraints(s);
  if (!(close_positions(s, constraints, y).array() < nearly_closed).all())
    return false;
  close_velocities(s, constraints, y);
  return true;
}

SparseMatrix constraint_gradient(const system::Regime& s, const VectorX& y) {
  Constraints constraints(s);
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  return constraints.gradient([](Index) { return true; });
}

Index mobility(const system::Regime& s) {
  return s.n_u - static_cast<Index>(
                     independent_rows(constraint_gradient(s, system::initial_state(s))).size());
}

} // namespace hydrodae::build
