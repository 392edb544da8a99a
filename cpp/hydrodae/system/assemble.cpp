#include "hydrodae/system/assemble.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/rank.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::system {

namespace {

constexpr double closed = 1e-12; ///< gaps, in units of their scale, that count as none

/// All kept rows at a pose, measured by the scales of the scene; row i belongs to lambda0 + i.
/// After them come the motions whose start is given, one row each.
class Constraints {
public:
  explicit Constraints(const System& s)
      : s_(s), ws_(s), scale_(displacement_scale(s)),
        size_(s.n_lambda + static_cast<Index>(s.starts.size())), mu_(s.n_lambda, -1) {
    for (std::size_t k = 0; k < s.starts.size(); ++k) {
      const MotionData& motion = s.motions[s.starts[k].motion];
      const JointData& j = s.joints[motion.joint];
      const BodyData& b = s.bodies[j.B.body >= 0 ? j.B.body : j.A.body];
      size_[s.n_lambda + static_cast<Index>(k)] =
          motion.motion.is_angle() ? b.length_scale / b.lever : b.length_scale;
    }
    for_each_row(s, [&](Index lambda, Index mu, bool velocity_level) {
      if (lambda == redundant)
        return;
      const Index i = lambda - s.lambda0;
      size_[i] = s.row_scale[velocity_level ? lambda : mu];
      mu_[i] = velocity_level ? -1 : mu;
    });
  }

  /// Gaps of the rows at position level (rows at velocity level: 0), and rates of all rows.
  void evaluate(const VectorX& y, VectorX& gaps, VectorX& rates) {
    const VectorX rest = VectorX::Zero(s_.n);
    VectorX r(s_.n);
    residual<double>(s_, ws_, 0.0, y.data(), rest.data(), r.data());
    gaps = rates = VectorX::Zero(size_.size());
    for (Index i = 0; i < s_.n_lambda; ++i) {
      gaps[i] = mu_[i] < 0 ? 0.0 : r[mu_[i]] / size_[i];
      rates[i] = r[s_.lambda0 + i] / size_[i];
    }
    for (std::size_t k = 0; k < s_.starts.size(); ++k) {
      const MotionStart& start = s_.starts[k];
      const auto row = motion_row<double>(s_, ws_, start.motion);
      const JointData& j = s_.joints[s_.motions[start.motion].joint];
      const Index i = s_.n_lambda + static_cast<Index>(k);
      if (start.value)
        gaps[i] = (row.value - *start.value) / size_[i];
      if (start.rate)
        rates[i] =
            (row.gradient.dot(joint_velocity<double>(j, ws_.bodies)) - *start.rate) / size_[i];
    }
  }

  /// Gradient (rows, n_u) by scaled displacements at the pose evaluated last; rows for which
  /// `wanted(i)` is false stay empty.
  template <class Wanted> SparseMatrix gradient(Wanted&& wanted) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const JointData& j, Index i, const joint::Vector12& row) {
      if (wanted(i))
        append(entries, j, i, row);
    };
    for (const JointData& j : s_.joints) {
      const auto g = joint_geometry<double>(j, ws_.bodies);
      for (const RowData& row : j.rows)
        if (row.kept())
          add(j, row.lambda - s_.lambda0,
              joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient);
    }
    for (const CouplerData& c : s_.couplers)
      for (const CouplerData::Term& term : c.terms)
        if (c.kept())
          add(s_.joints[s_.motions[term.motion].joint], c.lambda - s_.lambda0,
              term.factor * motion_row<double>(s_, ws_, term.motion).gradient);
    for (std::size_t k = 0; k < s_.starts.size(); ++k)
      add(s_.joints[s_.motions[s_.starts[k].motion].joint], s_.n_lambda + static_cast<Index>(k),
          motion_row<double>(s_, ws_, s_.starts[k].motion).gradient);
    SparseMatrix G(size_.size(), s_.n_u);
    G.setFromTriplets(entries.begin(), entries.end());
    return G;
  }

  /// Does row i hold a position, does it hold a rate?
  bool holds_position(Index i) const {
    return i < s_.n_lambda ? mu_[i] >= 0 : start(i).value.has_value();
  }
  bool holds_rate(Index i) const { return i < s_.n_lambda || start(i).rate.has_value(); }
  std::string name(Index i) const {
    if (i >= s_.n_lambda) {
      const MotionData& motion = s_.motions[start(i).motion];
      return "joints/" + s_.joints[motion.joint].name + " initial " + motion.name;
    }
    return s_.row_names[mu_[i] < 0 ? s_.lambda0 + i : mu_[i]];
  }
  double size(Index i) const { return size_[i]; }
  const VectorX& scale() const { return scale_; }

private:
  const MotionStart& start(Index i) const {
    return s_.starts[static_cast<std::size_t>(i - s_.n_lambda)];
  }

  void append(std::vector<Eigen::Triplet<double>>& entries, const JointData& j, Index i,
              const joint::Vector12& gradient) const {
    for (int side = 0; side < 2; ++side) {
      const int body = side == 0 ? j.A.body : j.B.body;
      if (body < 0)
        continue;
      const BodyData& b = s_.bodies[body];
      for (int k = 0; k < b.n_active; ++k) {
        const Index u = b.u0 - s_.u0 + k;
        entries.emplace_back(i, u, gradient[6 * side + b.active[k]] * scale_[u] / size_[i]);
      }
    }
  }

  const System& s_;
  Workspace<double> ws_;
  VectorX scale_, size_;
  std::vector<Index> mu_;
};

/// Newton's method with smallest corrections in units of the scales. Returns the largest gap left.
double close_positions(const System& s, Constraints& constraints, VectorX& y) {
  VectorX gaps, rates;
  double size = 0.0, before = INFINITY;
  for (int iteration = 0; iteration < 200; ++iteration) {
    constraints.evaluate(y, gaps, rates);
    size = gaps.size() > 0 ? gaps.cwiseAbs().maxCoeff() : 0.0;
    if (!std::isfinite(size) || size < closed || (size < 1e-9 && size > 0.5 * before))
      break;
    before = size;
    VectorX step = smallest_solution(
        constraints.gradient([&](Index i) { return constraints.holds_position(i); }), -gaps);
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest > 3.0) // three scales are 0.3 levers: keep to the branch
      step *= 3.0 / largest;
    retract(s, step.cwiseProduct(constraints.scale()), y);
  }
  return size;
}

/// The smallest change of the velocities after which all rates vanish.
void close_velocities(const System& s, Constraints& constraints, VectorX& y) {
  VectorX gaps, rates;
  for (int pass = 0; pass < 2; ++pass) { // linear; the second pass removes rounding
    constraints.evaluate(y, gaps, rates);
    if (rates.size() == 0 || rates.cwiseAbs().maxCoeff() < closed)
      return;
    const SparseMatrix G = constraints.gradient([&](Index i) { return constraints.holds_rate(i); });
    y.segment(s.u0, s.n_u) += smallest_solution(G, -rates).cwiseProduct(constraints.scale());
  }
}

/// Writes the pose and velocities of y into the bodies; notes what moved.
void write_back(System& s, const VectorX& y) {
  Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    BodyData& b = s.bodies[i];
    const BodyState<double>& state = ws.bodies[i];
    const Vector4 p =
        b.rotation == BodyData::Rotation::free ? Vector4(state.p.normalized()) : b.orientation;
    const double moved = (state.r - b.position).norm();
    const Matrix3 turn = rotation_matrix<double>(b.orientation).transpose() * state.R;
    const double angle = std::acos(std::clamp(0.5 * (turn.trace() - 1.0), -1.0, 1.0));
    if (moved > 1e-9 * b.length_scale || angle > 1e-7)
      s.notes.push_back("closing the joints moved body '" + b.name + "' by " + number_text(moved) +
                        " m and " + number_text(angle * 180.0 / pi) + " deg");
    b.position = state.r;
    if (b.rotation == BodyData::Rotation::about_axis) {
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

} // namespace

VectorX displacement_scale(const System& s) {
  VectorX scale(s.n_u);
  for (const BodyData& b : s.bodies)
    for (int k = 0; k < b.n_active; ++k)
      scale[b.u0 - s.u0 + k] = b.active[k] < 3 ? b.length_scale : b.length_scale / b.lever;
  return scale;
}

void retract(const System& s, const VectorX& step, VectorX& y) {
  for (const BodyData& b : s.bodies) {
    for (int k = 0; k < b.n_active; ++k)
      if (b.active[k] < 3 || b.rotation == BodyData::Rotation::about_axis)
        y[b.q0 + k] += step[b.u0 - s.u0 + k];
    if (b.rotation != BodyData::Rotation::free)
      continue;
    const Index q = b.q0 + b.n_translations;
    const Vector4 turn =
        quaternion_from_rotation_vector(step.segment<3>(b.u0 - s.u0 + b.n_translations));
    const Vector4 p = y.segment<4>(q);
    y.segment<4>(q) = p * turn[0] + quaternion_rate_matrix<double>(p) * turn.tail<3>();
  }
}

void assemble(System& s) {
  VectorX y = initial_state(s);
  Constraints constraints(s);
  const double left = close_positions(s, constraints, y);
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  if (!(left < 1e-8)) {
    Index worst = 0;
    gaps.cwiseAbs().maxCoeff(&worst);
    const std::string name = constraints.name(worst);
    const bool joint = name.starts_with("joints/");
    const std::string owner = name.substr(name.find('/') + 1, name.find(' ') - name.find('/') - 1);
    throw ModelError((joint ? "joint." : "constraint.") + owner,
                     "the bodies cannot be moved so that all joints close; " + name +
                         " stays open by " + number_text(gaps[worst] * constraints.size(worst)) +
                         " m or rad");
  }
  close_velocities(s, constraints, y);
  write_back(s, y);
}

bool close(const System& s, VectorX& y) {
  System free = s; // elsewhere than the start
  free.starts.clear();
  Constraints constraints(free);
  if (!(close_positions(free, constraints, y) < 1e-8))
    return false;
  close_velocities(free, constraints, y);
  return true;
}

SparseMatrix constraint_gradient(const System& s, const VectorX& y) {
  System rows = s; // without the conditions of the start
  rows.starts.clear();
  Constraints constraints(rows);
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  return constraints.gradient([](Index) { return true; });
}

Index mobility(const System& s) {
  return s.n_u -
         static_cast<Index>(independent_rows(constraint_gradient(s, initial_state(s))).size());
}

bool drop_redundant_rows(System& s) {
  if (s.n_lambda == 0)
    return false;
  const VectorX start = initial_state(s);
  std::vector<Index> best = independent_rows(constraint_gradient(s, start));
  const auto rank_of = [](const std::vector<Index>& rows) {
    return static_cast<Index>(rows.size());
  };
  Index rank = rank_of(best);
  if (rank == s.n_u)
    s.notes.push_back(
        "the constraints leave nothing to move (or their axes and points are not exact: "
        "rows that agree to less than nine digits count as independent)");
  const Index at_start = rank;
  if (rank == s.n_lambda)
    return false;
  std::mt19937 random(7);
  System free = s; // elsewhere than the start
  free.starts.clear();
  Constraints constraints(free);
  for (int sample = 0; sample < 4; ++sample) {
    VectorX step(s.n_u), y = start;
    for (double& x : step)
      x = 2.0 * (2.0 * (random() / 4294967296.0) - 1.0);
    retract(s, step.cwiseProduct(constraints.scale()), y);
    if (!(close_positions(free, constraints, y) < 1e-8))
      continue;
    std::vector<Index> rows = independent_rows(constraint_gradient(s, y));
    if (rank_of(rows) > rank) {
      rank = rank_of(rows);
      best = std::move(rows);
    }
  }
  if (rank > at_start)
    s.notes.push_back("the start is a singular pose: " + std::to_string(rank - at_start) +
                      " more degrees of freedom there than nearby");
  if (rank == s.n_lambda)
    return false;
  std::vector<std::string> dropped;
  for_each_row(s, [&](Index& lambda, Index& mu, bool velocity_level) {
    if (lambda == redundant || std::binary_search(best.begin(), best.end(), lambda - s.lambda0))
      return; // a switch that is open has no row now
    dropped.push_back(s.row_names[velocity_level ? lambda : mu]);
    lambda = mu = redundant;
  });
  s.notes.push_back(std::to_string(dropped.size()) +
                    " redundant constraint rows, which follow from the others: " + joined(dropped));
  return true;
}

} // namespace hydrodae::system
