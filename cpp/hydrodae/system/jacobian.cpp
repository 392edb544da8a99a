#include "hydrodae/system/jacobian.h"

#include <algorithm>
#include <utility>

#include "hydrodae/system/assembly_elements.h"
#include "hydrodae/system/assembly_water.h"

namespace hydrodae::system {

namespace {

/// Collects the places that the assembly visits.
template <Part made> struct PatternSink {
  static constexpr bool whole = made == Part::whole;
  Visits visits, rates; ///< (column, row); rates: those of dF/dy'
  void by_y(Index row, Index column, double) { visits.emplace_back(column, row); }
  void by_yp(Index row, Index column, double) {
    visits.emplace_back(column, row);
    rates.emplace_back(column, row);
  }
};

/// Adds the values into the slots found before.
template <Part made> struct ValueSink {
  static constexpr bool whole = made == Part::whole;
  const Index* slot;
  JacobianParts& out;
  void by_y(Index, Index, double value) { out.by_y[*slot++] += value; }
  void by_yp(Index, Index, double value) { out.by_yp[*slot++] += value; }
};

/// Kinematics, past and tangent maps at (t, y, y'): d phi = 2 L(p)^T dp / |p|^2.
void prepare(const System& s, JacobianWorkspace& ws, double t, const double* y, const double* yp) {
  unpack<double>(s, y, yp, ws.state.bodies);
  ws.state.time = t;
  ws.state.past = past_at(s, t);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    ws.state.shifts[i].setZero();
    const Vector4& p = ws.state.bodies[i].p;
    if (s.bodies[i].rotation == BodyData::Rotation::free)
      ws.rotation[i] = 2.0 / p.squaredNorm() * quaternion_rate_matrix<double>(p).transpose();
  }
}

template <Part made> Pattern pattern_of(const System& system) {
  JacobianWorkspace ws(system);
  const VectorX y = initial_state(system), yp = VectorX::Zero(system.n);
  prepare(system, ws, 0.0, y.data(), yp.data());
  PatternSink<made> sink;
  Assembly<PatternSink<made>>{system, ws, 0.0, y.data(), yp.data(), sink}.run();
  Pattern pattern = make_pattern(system.n, sink.visits, sink.rates);
  pattern.part = made;
  return pattern;
}

template <Part made>
void fill(const System& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
          const double* y, const double* yp, JacobianParts& out) {
  ValueSink<made> sink{pattern.slots.data(), out};
  Assembly<ValueSink<made>>{system, ws, t, y, yp, sink}.run();
}

} // namespace

JacobianWorkspace::JacobianWorkspace(const System& system)
    : state(system), rotation(system.bodies.size(), Eigen::Matrix<double, 3, 4>::Zero()),
      fluid(state.fluid.size()) {
  std::size_t most = 0;
  for (const ElementList& list : system.elements)
    most = std::max(most, list.laws->size() * static_cast<std::size_t>(list.laws->shape.n_in() *
                                                                       list.laws->shape.n_out()));
  element_jacobian.resize(most);
}

Pattern find_pattern(const System& system, Part part) {
  return part == Part::whole ? pattern_of<Part::whole>(system)
                             : pattern_of<Part::accelerations>(system);
}

void jacobian(const System& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
              const double* y, const double* yp, JacobianParts& out) {
  std::fill(out.by_y.begin(), out.by_y.end(), 0.0);
  std::fill(out.by_yp.begin(), out.by_yp.end(), 0.0);
  prepare(system, ws, t, y, yp);
  if (pattern.part == Part::whole)
    fill<Part::whole>(system, pattern, ws, t, y, yp, out);
  else
    fill<Part::accelerations>(system, pattern, ws, t, y, yp, out);
}

} // namespace hydrodae::system
