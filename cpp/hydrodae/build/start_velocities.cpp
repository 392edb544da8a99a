#include "hydrodae/build/start_velocities.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/mass.h"

namespace hydrodae::build {

namespace {

constexpr double exact = 1e-12; ///< rate that counts as zero, in units of its scale
/// Difference without a note, as part of the largest given velocity
constexpr double digits = 1e-6;
/// Largest allowed difference, as part of the largest given velocity
constexpr double allowed = 1e-3;

/// Conditions on the velocities, in unit displacements per second: matrix x = target. The
/// constraints come first, then the values of the case.
struct Conditions {
  struct Given { ///< one velocity or rate of the case
    int body = -1, motion = -1;
    bool turns = false;
    double length = 1.0; ///< size of a unit displacement [m], for angles by the lever
    double unit = 1.0;   ///< unit [m or rad]
  };
  SparseMatrix matrix;
  VectorX target;
  Index n_constraints = 0;
  std::vector<Given> given;      ///< values of the rows after the constraints
  std::vector<BodyStart> starts; ///< origin of the values
  const BodyStart* start_of(int body) const {
    const auto found = std::find_if(starts.begin(), starts.end(),
                                    [&](const BodyStart& a) { return a.body == body; });
    return found == starts.end() ? nullptr : &*found;
  }
};

using Entries = std::vector<Eigen::Triplet<double>>;

SparseMatrix matrix_of(const Entries& entries, Index rows, Index columns) {
  SparseMatrix out(rows, columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Adds rows v_k = given for the free coordinates of bodies with given velocity.
void add_bodies(const system::System& s, const std::vector<BodyStart>& given,
                const Constraints& constraints, Entries& entries, std::vector<double>& target,
                Conditions& out) {
  for (const BodyStart& start : given) {
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(start.body)];
    const Matrix3& R = constraints.workspace().bodies[static_cast<std::size_t>(start.body)].R;
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[k];
      const bool turns = c >= 3;
      if (!(turns ? start.angular_velocity : start.velocity))
        continue;
      const Index u = b.u0 - s.u0 + k;
      const double value =
          turns ? (R.transpose() * *start.angular_velocity)[c - 3] : (*start.velocity)[c];
      entries.emplace_back(static_cast<Index>(target.size()), u, 1.0);
      target.push_back(value / constraints.scale()[u]);
      out.given.push_back({start.body, -1, turns, b.length_scale, constraints.scale()[u]});
    }
  }
}

/// All conditions at the last pose; `rates` are those of the rows at rest.
Conditions conditions(const system::System& s, const std::vector<BodyStart>& given,
                      const Constraints& constraints, const VectorX& rates) {
  Conditions out;
  out.starts = given;
  const SparseMatrix G = constraints.gradient([&](Index i) { return constraints.holds_rate(i); });
  Entries entries;
  std::vector<double> target(static_cast<std::size_t>(constraints.n_rows()));
  std::vector<Index> place(static_cast<std::size_t>(G.rows()), -1);
  for (Index i = 0; i < G.rows(); ++i) {
    if (i < constraints.n_rows()) {
      place[static_cast<std::size_t>(i)] = i;
      target[static_cast<std::size_t>(i)] = -rates[i];
      continue;
    }
    if (!constraints.holds_rate(i))
      continue;
    const int motion = constraints.start(i).motion;
    const system::JointData& j = s.joints[s.motions[motion].joint];
    const system::BodyData& b = s.bodies[j.B.body >= 0 ? j.B.body : j.A.body];
    place[static_cast<std::size_t>(i)] = static_cast<Index>(target.size());
    target.push_back(-rates[i]);
    out.given.push_back({-1, motion, constraints.is_angle(i), b.length_scale, constraints.size(i)});
  }
  for (Index c = 0; c < G.cols(); ++c)
    for (SparseMatrix::InnerIterator it(G, c); it; ++it)
      if (place[static_cast<std::size_t>(it.row())] >= 0)
        entries.emplace_back(place[static_cast<std::size_t>(it.row())], c, it.value());
  out.n_constraints = constraints.n_rows();
  add_bodies(s, given, constraints, entries, target, out);
  const auto n = static_cast<Index>(target.size());
  out.matrix = matrix_of(entries, n, s.n_u);
  out.target = Eigen::Map<const VectorX>(target.data(), n);
  return out;
}

/// Coordinates y in which the kinetic energy is |y|^2 / 2: x = L^-T y, with L L^T the mass matrix
/// of each body. Bodies without mass follow from the others.
SparseMatrix energy_coordinates(const system::System& s, const Constraints& constraints) {
  constexpr double next_to_nothing = 1e-8; // part of the masses that count
  Entries entries;
  for (const system::BodyData& b : s.bodies) {
    const Matrix6 rigid = system::rigid_mass(b);
    MatrixX mass = MatrixX::Zero(b.n_active, b.n_active);
    for (int i = 0; i < b.n_active; ++i)
      for (int k = 0; k < b.n_active; ++k) {
        const int c = b.active[i], d = b.active[k];
        const double own =
            i == k ? next_to_nothing * b.scale_mass * (c < 3 ? 1.0 : b.lever * b.lever) : 0.0;
        mass(i, k) = (own + rigid(c, d)) * constraints.scale()[b.u0 - s.u0 + i] *
                     constraints.scale()[b.u0 - s.u0 + k];
      }
    const MatrixX by = mass.llt().matrixU().solve(MatrixX::Identity(b.n_active, b.n_active));
    for (int i = 0; i < b.n_active; ++i)
      for (int k = i; k < b.n_active; ++k)
        entries.emplace_back(b.u0 - s.u0 + i, b.u0 - s.u0 + k, by(i, k));
  }
  return matrix_of(entries, s.n_u, s.n_u);
}

/// Solution with the least kinetic energy among all that meet the conditions as `x` does: the
/// motion of bodies struck at rest (Kelvin's theorem; Lamb, Hydrodynamics, section 136).
VectorX least_energy(const Conditions& all, const SparseMatrix& coordinates, const VectorX& x) {
  const VectorX met = all.matrix * x;
  const SparseMatrix matrix = all.matrix * coordinates;
  VectorX y = VectorX::Zero(x.size());
  for (int pass = 0; pass < 3; ++pass) // linear; further passes remove rounding
    y += smallest_solution(matrix, met - matrix * y);
  const VectorX out = coordinates * y;
  return out.allFinite() ? out : x;
}

std::string vector_text(const Vector3& v) {
  const auto number = [](double x) { return number_text(std::abs(x) < 1e-12 ? 0.0 : x); };
  return "[" + number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]) + "]";
}

/// Velocity of a row: as given, and as the constraints allow it.
struct Told {
  std::string key, name, unit, from, to;
};

Told tell(const system::System& s, const Constraints& constraints, const Conditions& all,
          std::size_t k, const VectorX& x) {
  const Conditions::Given& g = all.given[k];
  const Index row = all.n_constraints + static_cast<Index>(k);
  if (g.motion >= 0) {
    const system::MotionData& m = s.motions[g.motion];
    const double rate = all.matrix.row(row).dot(x);
    return {"joint." + s.joints[m.joint].name + ".initial." + m.name + "_rate",
            "joint '" + s.joints[m.joint].name + "': initial " + m.name + "_rate",
            g.turns ? "rad/s" : "m/s", number_text(all.target[row] * g.unit),
            number_text(rate * g.unit)};
  }
  const system::BodyData& b = s.bodies[g.body];
  const BodyStart* start = all.start_of(g.body);
  Vector3 v = Vector3::Zero();
  for (int i = 0; i < b.n_active; ++i)
    if ((b.active[i] >= 3) == g.turns) {
      const Index u = b.u0 - s.u0 + i;
      v[b.active[i] % 3] = x[u] * constraints.scale()[u];
    }
  if (g.turns)
    v = constraints.workspace().bodies[static_cast<std::size_t>(g.body)].R * v;
  const std::string name = g.turns ? "angular_velocity" : "velocity";
  return {"body." + b.name + ".initial." + name, "body '" + b.name + "': initial " + name,
          g.turns ? "rad/s" : "m/s",
          vector_text(g.turns ? *start->angular_velocity : *start->velocity), vector_text(v)};
}

/// Largest given velocity of each connected part [m/s], by row.
VectorX speeds(const Conditions& all, const Constraints& constraints) {
  VectorX size(all.target.size());
  for (Index i = 0; i < all.n_constraints; ++i)
    size[i] = std::abs(all.target[i] * constraints.size(i)) *
              (constraints.is_angle(i) ? constraints.lever(i) : 1.0);
  for (std::size_t k = 0; k < all.given.size(); ++k)
    size[all.n_constraints + static_cast<Index>(k)] =
        std::abs(all.target[all.n_constraints + static_cast<Index>(k)]) * all.given[k].length;
  VectorX out = size;
  for (const Component& part : components(all.matrix)) {
    double largest = 0.0;
    for (Index row : part.rows)
      largest = std::max(largest, size[row]);
    for (Index row : part.rows)
      out[row] = largest;
  }
  return out;
}

/// Keeps given velocities exactly if the constraints allow it; otherwise within their printed
/// digits, with a note; otherwise refuses the case.
void judge(system::System& s, const Constraints& constraints, const Conditions& all,
           const VectorX& x) {
  const VectorX speed = speeds(all, constraints), misfit = all.matrix * x - all.target;
  std::vector<std::string> told;
  double worst = allowed;
  std::size_t which = all.given.size();
  for (std::size_t k = 0; k < all.given.size(); ++k) {
    const Index row = all.n_constraints + static_cast<Index>(k);
    const double part = std::abs(misfit[row]) * all.given[k].length / std::max(speed[row], 1e-300);
    if (part > worst) {
      worst = part;
      which = k;
    }
    if (part <= digits)
      continue;
    const Told t = tell(s, constraints, all, k, x);
    const std::string note = t.name + " projected from " + t.from + " to " + t.to + " " + t.unit +
                             ", which fits the "
                             "constraints";
    if (std::find(told.begin(), told.end(), note) == told.end())
      told.push_back(note);
  }
  if (which < all.given.size()) {
    const Told t = tell(s, constraints, all, which, x);
    const double size =
        std::abs(misfit[all.n_constraints + static_cast<Index>(which)]) * all.given[which].unit;
    throw ModelError(t.key, t.name + " = " + t.from + " " + t.unit +
                                " does not fit the constraints and the other velocities given: "
                                "off by " +
                                number_text(size) + " " + t.unit + "; nearest to all of them is " +
                                t.to + " " + t.unit +
                                ". Give velocities that fit, or leave some out: they follow from "
                                "the constraints");
  }
  s.notes.insert(s.notes.end(), told.begin(), told.end());
}

/// Notes bodies with a velocity that the case does not give.
void note_completed(system::System& s, const Conditions& all, const VectorX& x) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    const BodyStart* start = all.start_of(static_cast<int>(i));
    for (int k = 0; k < b.n_active; ++k) {
      const bool known = start && (b.active[k] < 3 ? start->velocity.has_value()
                                                   : start->angular_velocity.has_value());
      if (known || std::abs(x[b.u0 - s.u0 + k]) <= 1e-9 * x.cwiseAbs().maxCoeff())
        continue;
      names.push_back("'" + b.name + "'");
      break;
    }
  }
  constexpr std::size_t longest = 10;
  const std::size_t count = names.size();
  if (count > longest)
    names.resize(longest);
  if (count > 0)
    s.notes.push_back(
        "velocities that the case does not give follow from the constraints: " + joined(names) +
        (count > longest ? " and " + std::to_string(count - longest) + " more" : ""));
}

} // namespace

void start_velocities(system::System& s, const std::vector<BodyStart>& given,
                      Constraints& constraints, VectorX& y) {
  VectorX gaps, rates, u = VectorX::Zero(s.n_u);
  y.segment(s.u0, s.n_u).setZero();
  constraints.evaluate(y, gaps, rates);
  const Conditions all = conditions(s, given, constraints, rates);
  for (const BodyStart& start : given) {
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(start.body)];
    const Matrix3& R = constraints.workspace().bodies[static_cast<std::size_t>(start.body)].R;
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[k];
      if (c < 3 && start.velocity)
        u[b.u0 - s.u0 + k] = (*start.velocity)[c];
      if (c >= 3 && start.angular_velocity)
        u[b.u0 - s.u0 + k] = (R.transpose() * *start.angular_velocity)[c - 3];
    }
  }
  VectorX x = u.cwiseQuotient(constraints.scale());
  const auto worst = [](const VectorX& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0; };
  if (worst(all.matrix * x - all.target) > exact) {
    x = smallest_solution(all.matrix, all.target);
    const SparseMatrix G = all.matrix.topRows(all.n_constraints);
    for (int pass = 0; pass < 2; ++pass) // the constraints hold exactly
      x += smallest_solution(G, all.target.head(all.n_constraints) - G * x);
    judge(s, constraints, all, x);
    x = least_energy(all, energy_coordinates(s, constraints), x);
    note_completed(s, all, x);
    u = x.cwiseProduct(constraints.scale());
  }
  y.segment(s.u0, s.n_u) = u;
}

} // namespace hydrodae::build
