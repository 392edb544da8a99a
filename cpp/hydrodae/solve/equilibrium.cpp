#include "hydrodae/solve/equilibrium.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/algebraic.h"
#include "hydrodae/system/assemble.h"
#include "hydrodae/system/build_parts.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/system/sanity.h"

namespace hydrodae::solve {

namespace {

using system::BodyData;
using system::System;

constexpr double balanced = 1e-10; ///< of weights and lengths
constexpr double longest = 3.0;    ///< largest step of Newton's method, in length scales
constexpr int most_steps = 200;

/// Gaps of all rows at position level, in the order of lambda; the others 0.
VectorX gaps_of(const System& s, const VectorX& r) {
  VectorX gaps = VectorX::Zero(s.n_lambda);
  system::for_each_row(s, [&](Index lambda, Index mu, bool velocity_level) {
    if (lambda != system::redundant && !velocity_level)
      gaps[lambda - s.lambda0] = r[mu];
  });
  return gaps;
}

VectorX gap_sizes(const System& s) {
  VectorX sizes = VectorX::Ones(s.n_lambda);
  system::for_each_row(s, [&](Index lambda, Index mu, bool velocity_level) {
    if (lambda != system::redundant)
      sizes[lambda - s.lambda0] = s.row_scale[velocity_level ? lambda : mu];
  });
  return sizes;
}

/// Takes positions from y into the start of the bodies and motions, at rest.
void take_start(System& s, const VectorX& y) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    BodyData& b = s.bodies[i];
    b.position = ws.bodies[i].r;
    b.velocity = b.angular_velocity = Vector3::Zero();
    if (b.rotation == BodyData::Rotation::about_axis)
      b.orientation =
          quaternion_from_rotation_vector(y[b.q0 + b.n_translations] * Vector3::Unit(b.axis));
    if (b.rotation == BodyData::Rotation::free)
      b.orientation = ws.bodies[i].p.normalized();
  }
  for (int m = 0; m < static_cast<int>(s.motions.size()); ++m)
    s.motions[static_cast<std::size_t>(m)].start = system::motion_row<double>(s, ws, m).value;
}

/// Puts laws at rest in the place of those that have states for it.
/// @returns whether there are any
bool take_statics(System& s) {
  bool any = false;
  for (system::ElementList& list : s.elements)
    if (auto statics = list.laws->statics()) {
      list.laws = std::move(statics);
      any = true;
    }
  if (any)
    system::lay_out(s);
  return any;
}

/// Notes a direction, free of the constraints, in which the forces drive the scene away.
void note_instability(System& s, const LinearMatrices& m, const VectorX& scale) {
  const MatrixX G = m.constraints * scale.asDiagonal();
  MatrixX free = MatrixX::Identity(s.n_u, s.n_u);
  if (G.rows() > 0) {
    const Eigen::JacobiSVD<MatrixX> svd(G, Eigen::ComputeFullV);
    free = svd.matrixV().rightCols(s.n_u - svd.rank());
  }
  if (free.cols() == 0)
    return;
  const MatrixX K = free.transpose() * scale.asDiagonal() * m.stiffness * scale.asDiagonal() * free;
  const VectorX values =
      Eigen::SelfAdjointEigenSolver<MatrixX>(0.5 * (K + K.transpose())).eigenvalues();
  if (values[0] < -1e-6 * values.cwiseAbs().maxCoeff())
    s.notes.push_back("the equilibrium is unstable: the smallest displacement moves the scene away "
                      "from it");
}

/// A coordinate and the unit of the force along it: "heave of body 'sphere'", "N".
struct CoordinateName {
  std::string text, unit;
};

CoordinateName coordinate_name(const System& s, Index u) {
  for (const BodyData& b : s.bodies) {
    const Index k = u - (b.u0 - s.u0);
    if (k < 0 || k >= b.n_active)
      continue;
    const int c = b.active[static_cast<std::size_t>(k)];
    return {std::string(model::coordinate_names[static_cast<std::size_t>(c)]) + " of body " +
                in_quotes(b.name),
            c < 3 ? "N" : "N m"};
  }
  return {s.row_names[s.u0 + u], "N or N m"};
}

/// Coordinates of the motions, free of the constraints, that a force drives and that have no
/// stiffness: K d = 0 but d . f != 0.
std::vector<std::string> unrestored(const System& s, const LinearMatrices& m,
                                    const VectorX& scale) {
  const MatrixX G = m.constraints * scale.asDiagonal();
  MatrixX free = MatrixX::Identity(s.n_u, s.n_u);
  if (G.rows() > 0) {
    const Eigen::JacobiSVD<MatrixX> svd(G, Eigen::ComputeFullV);
    free = svd.matrixV().rightCols(s.n_u - svd.rank());
  }
  std::vector<std::string> out;
  if (free.cols() == 0)
    return out;
  const VectorX forces = free.transpose() * scale.cwiseProduct(m.forces);
  const MatrixX K = free.transpose() * scale.asDiagonal() * m.stiffness * scale.asDiagonal() * free;
  Eigen::JacobiSVD<MatrixX> svd(K, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const VectorX sizes = svd.singularValues();
  const double weight = s.row_scale.segment(s.u0, s.n_u).cwiseProduct(scale).maxCoeff();
  VectorX drift = VectorX::Zero(free.cols());
  for (Index k = 0; k < sizes.size(); ++k)
    if (sizes[k] <= 1e-9 * std::max(sizes[0], weight))
      drift += svd.matrixU().col(k).dot(forces) * svd.matrixU().col(k);
  if (!(drift.norm() > 1e-9 * weight))
    return out;
  const VectorX moved = (free * drift).cwiseAbs();
  for (Index u = 0; u < s.n_u; ++u)
    if (moved[u] > 0.1 * moved.maxCoeff())
      out.push_back(coordinate_name(s, u).text);
  return out;
}

[[noreturn]] void refuse(const System& s, const LinearMatrices& m, const VectorX& scale) {
  Index worst = 0;
  m.forces.cwiseQuotient(s.row_scale.segment(s.u0, s.n_u).cwiseMax(1e-300))
      .cwiseAbs()
      .maxCoeff(&worst);
  const CoordinateName name = coordinate_name(s, worst);
  const std::vector<std::string> slack = unrestored(s, m, scale);
  throw ModelError("solver.start",
                   "no static equilibrium near the start: " + s.row_names[s.u0 + worst] +
                       " is off by " + number_text(m.forces[worst]) + " " + name.unit +
                       (slack.empty() ? "; start nearer to the equilibrium, or hold what drifts"
                                      : "; there is no stiffness in " + joined(slack) +
                                            ": balance weight, buoyancy and constant loads there, "
                                            "or add a mooring, a spring or hydrostatics"));
}

/// Newton's method from y to forces in balance and closed rows; y with the reactions.
LinearMatrices balance(const System& s, VectorX& y) {
  const system::Pattern pattern = system::find_pattern(s);
  const VectorX scale = system::displacement_scale(s), sizes = gap_sizes(s),
                rest = VectorX::Zero(s.n);
  const VectorX weights = s.row_scale.segment(s.u0, s.n_u).cwiseMax(1e-300);
  const VectorX units = s.scale.segment(s.lambda0, s.n_lambda).cwiseMax(1e-300);
  system::Workspace<double> ws(s);
  system::JacobianWorkspace laws(s);
  VectorX r(s.n);
  for (int step = 0;; ++step) {
    if (!system::solve_algebraic(s, laws, 0.0, y))
      throw ModelError("solver.start", "no static equilibrium near the start: an algebraic unknown "
                                       "of a force has no solution there");
    system::residual<double>(s, ws, 0.0, y.data(), rest.data(), r.data());
    const LinearMatrices m = linear_matrices(s, pattern, y);
    const VectorX gaps = gaps_of(s, r);
    const double force_error = m.forces.cwiseQuotient(weights).cwiseAbs().maxCoeff();
    const double gap_error = s.n_lambda > 0 ? gaps.cwiseQuotient(sizes).cwiseAbs().maxCoeff() : 0.0;
    if (force_error <= balanced && gap_error <= balanced) {
      for (const system::CouplerData& c : s.couplers)
        if (c.kept() && std::abs(r[c.lambda]) > 0.0)
          throw ModelError("constraint." + c.name, "constraint '" + c.name +
                                                       "' moves at the start: there is no "
                                                       "equilibrium");
      return m;
    }
    if (step == most_steps)
      refuse(s, m, scale);
    const Index n = s.n_u + s.n_lambda;
    MatrixX kkt = MatrixX::Zero(n, n);
    kkt.topLeftCorner(s.n_u, s.n_u) =
        weights.cwiseInverse().asDiagonal() * m.stiffness * scale.asDiagonal();
    kkt.topRightCorner(s.n_u, s.n_lambda) =
        -(weights.cwiseInverse().asDiagonal() * m.constraints.transpose() * units.asDiagonal());
    kkt.bottomLeftCorner(s.n_lambda, s.n_u) =
        sizes.cwiseInverse().asDiagonal() * m.constraints * scale.asDiagonal();
    VectorX rhs(n);
    rhs << m.forces.cwiseQuotient(weights), -gaps.cwiseQuotient(sizes);
    Eigen::CompleteOrthogonalDecomposition<MatrixX> cod;
    cod.setThreshold(1e-12);
    cod.compute(kkt);
    VectorX x = cod.solve(rhs);
    const double length = x.head(s.n_u).cwiseAbs().maxCoeff();
    if (!x.allFinite())
      refuse(s, m, scale);
    if (length > longest) // the reactions are taken whole: they are linear
      x.head(s.n_u) *= longest / length;
    system::retract(s, x.head(s.n_u).cwiseProduct(scale), y);
    y.segment(s.lambda0, s.n_lambda) += x.tail(s.n_lambda).cwiseProduct(units);
  }
}

/// Closes the stop that y violates most, or else opens the one that pulls most; false when every
/// stop agrees with y. Dry friction stays open: it holds any pose near.
bool correct_stops(System& s, const VectorX& y) {
  using State = system::SwitchData::State;
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  double worst = 0.0;
  system::SwitchData* which = nullptr;
  State next = State::open;
  const auto propose = [&](double wrong, system::SwitchData& element, State state) {
    if (wrong > worst) {
      worst = wrong;
      which = &element;
      next = state;
    }
  };
  for (system::SwitchData& element : s.switches) {
    if (element.kind != system::SwitchData::Kind::stop || element.holds())
      continue;
    const double value = system::motion_row<double>(s, ws, element.motion).value;
    propose(value - element.upper - 1e-9, element, State::upper);
    propose(element.lower - value - 1e-9, element, State::lower);
  }
  for (system::SwitchData& element : s.switches) {
    if (!element.holds() || worst > 0.0)
      continue;
    const Index row = s.couplers[static_cast<std::size_t>(element.coupler)].lambda;
    const double pull = y[row] / s.scale[row];
    propose((element.state == State::upper ? pull : -pull) - balanced, element, State::open);
  }
  if (which)
    system::set_state(s, *which, next);
  return which != nullptr;
}

/// What a linear model about the equilibrium has to know.
void note_switches(System& s) {
  for (const system::SwitchData& element : s.switches) {
    const std::string& name = s.couplers[static_cast<std::size_t>(element.coupler)].name;
    if (element.holds())
      s.notes.push_back("'" + name + "' holds its bound in the equilibrium");
    if (element.kind == system::SwitchData::Kind::friction)
      s.notes.push_back("dry friction '" + name + "' is left out of the equilibrium");
  }
}

} // namespace

VectorX move_to_equilibrium(System& system) {
  System s = system; // without waves
  system::calm(s);
  const bool less = take_statics(s);
  VectorX y = system::initial_state(s);
  if (!y.segment(s.u0, s.n_u).isZero(0.0))
    throw ModelError("solver.start", "start = \"equilibrium\" is at rest, but the case gives "
                                     "initial velocities");
  LinearMatrices m = balance(s, y);
  for (std::size_t pass = 0; correct_stops(s, y); ++pass) {
    if (pass > 4 * s.switches.size())
      throw ModelError("solver.start", "no static equilibrium that all stops agree with");
    system::lay_out(s);
    const VectorX head = y.head(s.lambda0);
    y.setZero(s.n);
    y.head(s.lambda0) = head;
    m = balance(s, y);
  }
  for (std::size_t k = 0; k < s.switches.size(); ++k)
    system::set_state(system, system.switches[k], s.switches[k].state);
  system::lay_out(system);
  note_switches(system);
  note_instability(system, m, system::displacement_scale(s));
  take_start(system, y);
  if (!less)
    return y;
  system::start_laws(system);
  VectorX all = system::initial_state(system);
  all.head(s.z0) = y.head(s.z0);
  all.tail(s.n - s.lambda0) = y.tail(s.n - s.lambda0);
  return all;
}

VectorX settle(const model::Scene& scene, System& s) {
  constexpr int most_passes = 20;
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::size_t notes = s.notes.size();
    const VectorX y = move_to_equilibrium(s);
    if (!system::take_mean_yaw(scene, s))
      return y;
    s.notes.resize(notes);
  }
  throw ModelError("solver.start", "no static equilibrium near the start: the yaw of the bodies, "
                                   "with which the hydrostatics turn, does not settle");
}

System starting_system(const model::Scene& scene) {
  const bool rests = scene.solver.start == "equilibrium";
  System s = system::build(scene, !rests);
  if (rests) {
    settle(scene, s);
    system::note_axes(scene, s);
    system::add_sea(scene, s);
  }
  system::note_findings(scene, s);
  return s;
}

} // namespace hydrodae::solve
