#include "hydrodae/statics/consistent_start.h"

#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/system/trouble.h"

namespace hydrodae::statics {

namespace {

using system::Regime;

constexpr double largest_gap = 1e-6; ///< largest gap, in units of its scale
constexpr double start_balanced = 1e-8;

/// Returns whether the joint keeps axis `axis` of both markers parallel: two rows keep the other
/// axes of A perpendicular to it, or three rows hold all axes.
bool tied(const joint::JointType& type, int axis) {
  int own = 0, all = 0;
  for (const joint::BasicRow& row : type.rows) {
    const auto* perp = std::get_if<joint::PerpRow>(&row);
    if (!perp)
      continue;
    ++all;
    if (perp->j == axis && perp->i != axis)
      ++own;
  }
  return own == 2 || all == 3;
}

/// Throws if the row at velocity level (`lambda`) or position level (`mu`) does not hold.
void check_row(const Regime& s, const VectorX& r, const std::string& key, Index lambda, Index mu,
               bool angle) {
  auto refuse = [&](Index row, const char* verb, const char* unit) {
    throw ModelError(key, s.row_names[row] + " " + verb + " " + number_text(r[row]) +
                              (angle ? " rad" : " m") + unit + " at the start");
  };
  if (mu >= 0 && std::abs(r[mu]) > largest_gap * s.row_scale[mu])
    refuse(mu, "is", "");
  if (std::abs(r[lambda]) > largest_gap * s.row_scale[lambda])
    refuse(lambda, "is", "/s");
}

/// Checks that joints are closed, on the right branch, and stay closed with the given velocities.
void check_constraints(const Regime& s, const VectorX& y, const VectorX& r) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (const system::JointData& j : s.joints) {
    const std::string key = "joint." + j.name;
    for (const system::RowData& row : j.rows)
      if (s.holds(row))
        check_row(s, r, key, s.lambda(row), s.mu(row), joint::is_angle(row.kind));
    // Rows of perpendicular axes also vanish if B is flipped. Fixed axes must stay aligned: those
    // of which no row of the type measures the angle between like axes.
    const auto g = system::joint_geometry<double>(j, ws.bodies);
    for (int axis = 0; axis < 3 && j.type->has_row<joint::PerpRow>(); ++axis)
      if (tied(*j.type, axis) && j.A.axes.col(axis).dot(g.N * j.B.axes.col(axis)) < 0.0)
        throw ModelError(key, "joint '" + j.name + "' starts flipped by 180 degrees");
  }
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c))
      check_row(s, r, "constraint." + c.name, s.lambda(c), c.velocity_level ? -1 : s.mu(c),
                s.motions[c.terms.front().motion].motion.is_angle());
}

/// Changes the velocities so that all rows hold, if they deviate by more than rounding. The work of
/// an impulse is that at the mean of the rates before and after, drives included.
/// @returns the work of the rows [J]; nothing: the velocities stay
std::optional<double> jump(const Regime& s, double t, linalg::SaddlePoint& saddle, VectorX& y) {
  constexpr double least_jump = 1e-9; // part of the unit rates
  VectorX struck = y;
  const linalg::SaddlePoint::Strike strike = saddle.strike(t, struck, VectorX::Zero(s.n_lambda));
  const auto scale = s.row_scale.segment(s.lambda0, s.n_lambda);
  if (strike.before.cwiseQuotient(scale).cwiseAbs().maxCoeff() <= least_jump)
    return std::nullopt;
  if (!strike.balanced)
    throw SolverError(t, {Reason::friction, std::string(linalg::SaddlePoint::no_friction_fits)});
  y = struck;
  double work = 0.5 * strike.impulses.dot(strike.before) + strike.rubbed;
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c))
      work += strike.impulses[s.lambda(c) - s.lambda0] * s.drive(c, t)[c.velocity_level ? 0 : 1];
  return work;
}

/// Throws with the name of the body with the largest part in the direction `free` of u.
[[noreturn]] void refuse_massless(const Regime& s, const VectorX& free) {
  Index most = 0;
  free.cwiseAbs().maxCoeff(&most);
  for (const system::BodyData& b : s.bodies) {
    const Index first = b.u0 - s.u0;
    if (most < first || most >= first + b.n_active)
      continue;
    const bool turns = most >= first + b.n_translations;
    const Index from = turns ? first + b.n_translations : first;
    Vector3 axis = Vector3::Zero();
    for (Index k = from; k < first + (turns ? b.n_active : b.n_translations); ++k)
      axis[b.active[static_cast<std::size_t>(k - first)] % 3] = free[k];
    axis /= axis.cwiseAbs().maxCoeff();
    const std::string along = "[" + rounded_text(axis[0], 3) + ", " + rounded_text(axis[1], 3) +
                              ", " + rounded_text(axis[2], 3) + "]";
    throw ModelError("body." + b.name + (turns ? ".inertia" : ".mass"),
                     "body '" + b.name + "' has no " + (turns ? "moment of inertia" : "mass") +
                         ", and no constraint holds its " +
                         (turns ? "rotation about its axis " : "translation along ") + along +
                         ": give it one, or lock this direction by 'motion' or a joint");
  }
  throw SolverError(0.0, {Reason::start, "a direction without inertia is held by nothing"});
}

/// Switches to the stabilised equations during its lifetime.
class Stabilised {
public:
  explicit Stabilised(Regime& s) : s_(s), formulation_(s.formulation) {
    s.formulation = system::Formulation::stabilised;
  }
  ~Stabilised() { s_.formulation = formulation_; }
  Stabilised(const Stabilised&) = delete;
  Stabilised& operator=(const Stabilised&) = delete;

private:
  Regime& s_;
  system::Formulation formulation_;
};

} // namespace

void consistent_start(const Regime& s, const system::Pattern& pattern, VectorX& y, VectorX& yp) {
  y.tail(s.n - s.lambda0).setZero();
  yp = VectorX::Zero(s.n);
  system::Workspace<double> ws(s);
  VectorX r(s.n);
  system::residual<double>(s, ws, 0.0, y.data(), yp.data(), r.data());
  if (const std::string why = system::unknown_load(s, ws); !why.empty())
    throw SolverError(0.0, {Reason::start, "no accelerations at the start: " + why});
  check_constraints(s, y, r);
  linalg::Equations equations(s, pattern, 1.0);
  linalg::SaddlePoint saddle(equations);
  const bool found = saddle.accelerations(0.0, y, yp);
  if (const VectorX free = saddle.undetermined(); free.size() > 0)
    refuse_massless(s, free);
  if (!saddle.jam().empty())
    throw SolverError(0.0, {Reason::friction, saddle.jam()});
  if (!found || saddle.mismatch() > start_balanced)
    throw SolverError(0.0,
                      {Reason::start, "no accelerations satisfy the constraints at the start: they "
                                      "contradict each other, or a body that moves has no mass"});
}

struct Consistency::Parts {
  system::Pattern pattern;
  linalg::Equations equations;
  linalg::SaddlePoint saddle;

  explicit Parts(const Regime& s)
      : pattern(system::find_pattern(s)), equations(s, pattern, 1.0), saddle(equations) {}
};

Consistency::Consistency(Regime& system) : s_(system) {
  const Stabilised lock(s_);
  parts_ = std::make_unique<Parts>(s_);
}

Consistency::~Consistency() = default;

std::optional<double> Consistency::restore(double t, VectorX& y, VectorX& yp) {
  const Stabilised lock(s_);
  linalg::SaddlePoint& saddle = parts_->saddle;
  parts_->equations.accept(t, y, yp);
  std::optional<double> work;
  bool good = saddle.accelerations(t, y, yp);
  if (good && s_.n_lambda > 0) {
    work = jump(s_, t, saddle, y);
    good = !work || saddle.accelerations(t, y, yp);
  }
  if (!good)
    throw SolverError(
        t, {saddle.jam().empty() ? Reason::not_finite : Reason::friction,
            "no finite accelerations" + (saddle.jam().empty() ? "" : ": " + saddle.jam())});
  return work;
}

} // namespace hydrodae::statics
