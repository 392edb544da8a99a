#include "hydrodae/system/jacobian.h"

#include <algorithm>
#include <utility>

#include "hydrodae/system/assembly_elements.h"
#include "hydrodae/system/assembly_water.h"

namespace hydrodae::system {

namespace {

/// Sink that collects the places that the assembly visits.
template <Part made> struct PatternSink {
  static constexpr bool whole = made != Part::accelerations, memory = made == Part::whole;
  Visits visits, rates; ///< (column, row) of all entries; `rates`: entries of dF/dy'
  void by_y(Index row, Index column, double) { visits.emplace_back(column, row); }
  void by_yp(Index row, Index column, double) {
    visits.emplace_back(column, row);
    rates.emplace_back(column, row);
  }
  void row_rate(Index, double) {}
  bool take_mass(const JacobianWorkspace&) { return false; }
  void keep_mass(const JacobianWorkspace&, bool) {}
};

/// Sink that adds the values into the slots of the pattern.
template <Part made> struct ValueSink {
  static constexpr bool whole = made != Part::accelerations, memory = made == Part::whole;
  const Index* slot;
  JacobianParts& out;
  const Index* first = slot;
  void by_y(Index, Index, double value) { out.by_y[*slot++] += value; }
  void by_yp(Index, Index, double value) { out.by_yp[*slot++] += value; }
  void row_rate(Index row, double value) { out.row_rates[row] += value; }
  /// Takes the mass matrix that is kept, which accelerations need first; returns false if the axes
  /// of the water have turned.
  bool take_mass(const JacobianWorkspace& ws) {
    const JacobianParts::Mass& stored = out.mass;
    if (whole || stored.values.empty() || stored.axes != ws.hydro_axes)
      return false;
    std::copy(stored.values.begin(), stored.values.end(), out.by_yp.begin());
    slot += stored.visits;
    return true;
  }
  /// @param constant  the mass matrix changes with the axes of the water alone
  void keep_mass(const JacobianWorkspace& ws, bool constant) {
    JacobianParts::Mass& stored = out.mass;
    if (whole || !constant)
      return;
    if (stored.axes == ws.hydro_axes) { // axes that turn at each call are not worth a copy
      stored.values = out.by_yp;
      stored.visits = slot - first;
    } else {
      stored.axes = ws.hydro_axes;
      stored.values.clear();
    }
  }
};

/// Kinematics, past and tangent maps at (t, y, y'): d phi = 2 L(p)^T dp / |p|^2.
void prepare(const Regime& s, JacobianWorkspace& ws, double t, const double* y, const double* yp) {
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

template <Part made> Pattern pattern_of(const Regime& system) {
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
void fill(const Regime& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
          const double* y, const double* yp, JacobianParts& out) {
  ValueSink<made> sink{pattern.slots.data(), out};
  Assembly<ValueSink<made>>{system, ws, t, y, yp, sink}.run();
}

void fill_memory(const Regime& s, const JacobianWorkspace& ws, JacobianParts& out) {
  const HydroData& h = s.hydro;
  out.memory.resize(h.bodies.size()); // allocates on the first call only
  const auto& rung = h.as<water::ExponentialRadiation>();
  if (rung.blended) {
    out.memory_weights.setOnes(rung.n_states());
    for (int z = 0; z < rung.n_states(); ++z)
      if (const int weight = rung.weight_of_state[static_cast<std::size_t>(z)]; weight >= 0)
        out.memory_weights[z] = ws.state.weights[weight];
  }
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const auto body = static_cast<std::size_t>(hb.body);
    const BodyData& b = s.bodies[body];
    const BodyState<double>& state = ws.state.bodies[body];
    const HydroMotionGradient d = hydro_motion_gradient(h.axes, hb, state);
    MemoryPort& port = out.memory[i];
    port.L = hydro_axes(h.axes, hb, state);
    port.by_unknown.setZero();
    if (b.rotation == BodyData::Rotation::about_axis)
      port.by_unknown.col(0) = d.U_phi.col(b.axis);
    if (b.rotation == BodyData::Rotation::free)
      port.by_unknown.leftCols<4>() = d.U_phi * ws.rotation[body];
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[static_cast<std::size_t>(k)];
      port.by_unknown.col(4 + k) = c < 3 ? d.U_v.col(c) : d.U_w.col(c - 3);
    }
  }
}

} // namespace

JacobianWorkspace::JacobianWorkspace(const Regime& system)
    : state(system), rotation(system.bodies.size(), Eigen::Matrix<double, 3, 4>::Zero()),
      hydro_axes(system.hydro.bodies.size(), Matrix6::Identity()),
      table_curvatures(static_cast<std::size_t>(system.hydro.added_mass.n_weights)) {
  std::size_t most = 0;
  for (const ElementList& list : system.elements)
    most = std::max(most, list.laws->size() * list.laws->jacobian_size());
  element_jacobian.resize(most);
}

Pattern find_pattern(const Regime& system, Part part) {
  switch (part) {
  case Part::whole:
    return pattern_of<Part::whole>(system);
  case Part::condensed:
    return pattern_of<Part::condensed>(system);
  case Part::accelerations:
    break;
  }
  return pattern_of<Part::accelerations>(system);
}

void jacobian(const Regime& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
              const double* y, const double* yp, JacobianParts& out) {
  std::fill(out.by_y.begin(), out.by_y.end(), 0.0);
  std::fill(out.by_yp.begin(), out.by_yp.end(), 0.0);
  prepare(system, ws, t, y, yp);
  switch (pattern.part) {
  case Part::whole:
    return fill<Part::whole>(system, pattern, ws, t, y, yp, out);
  case Part::condensed:
    fill<Part::condensed>(system, pattern, ws, t, y, yp, out);
    return fill_memory(system, ws, out);
  case Part::accelerations:
    out.row_rates.setZero(system.n_lambda);
    break;
  }
  fill<Part::accelerations>(system, pattern, ws, t, y, yp, out);
}

} // namespace hydrodae::system
