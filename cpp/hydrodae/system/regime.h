#pragma once
/// State of a System at a time of a run: rows that hold, multipliers, tolerances, and values set by
/// programs and events. Everything except y that changes between accepted steps is here; the System
/// is constant.

#include "hydrodae/system/system.h"

namespace hydrodae::system {

/// Equations in the rows of the multipliers. All formulations but the first have mu = 0.
///   stabilised   0 = g, 0 = G u               index 2 (Gear, Gupta and Leimkuhler)
///   index_2      0 = G u                      the gap g drifts
///   index_3      0 = g
///   index_1      0 = G u' + gamma + 2 b (G u) + b^2 g    Baumgarte's rate b [1/s], 0: none
/// Rows given at velocity level stay at that level, except in index 1.
enum class Formulation { stabilised, index_2, index_3, index_1 };

class History;

/// Signal that follows its target like an actuator of first order, T x' = target - x; exact,
/// because the target is constant between changes.
///
///   x(t) = target + (x0 - target) exp(-(t - t0) / T)
struct Lag {
  double time = 0.0;              ///< time constant T [s]; 0: no lag
  double since = 0.0, from = 0.0; ///< time t0 of the last target [s], and value x0 at t0

  double at(double t, double target) const {
    return time > 0.0 && from != target ? target + (from - target) * std::exp((since - t) / time)
                                        : target;
  }
};

/// Values set by events and programs.
struct Held {
  std::vector<SwitchData::State> modes;     ///< (n_switches,)
  std::vector<std::vector<double>> signals; ///< signals of the laws of each list
  std::vector<std::vector<Lag>> lags; ///< lags of the first signals of each list; empty: no lag
  std::vector<double> static_loads;   ///< (n_switches,) static loads of dry friction
  std::vector<double> rates;          ///< (n_couplers,) constant part of drives at velocity level
  /// Recent values of Turns::value: they select the turn of each angle
  std::vector<double> nearby;
  VectorX motion_scale;      ///< (n_groups,) motion as a part of the full scales
  VectorX translation_scale; ///< (n_groups,) part of motion_scale due to translations
};

struct Regime : Held {
  using Mode = SwitchData::State;

  /// @param system  must outlive this object and stay unchanged
  /// The regime begins as a run does: stabilised, all switches open, inputs from the case.
  explicit Regime(const System& system);

  /// Regime with the switches in the states `modes` (n_switches,).
  Regime(const System& system, const std::vector<SwitchData::State>& modes);

  const System& system;
  operator const System&() const { return system; }

  // Members of the system, under the same names.
  const double& gravity = system.gravity;
  const std::vector<BodyData>& bodies = system.bodies;
  const std::vector<JointData>& joints = system.joints;
  const std::vector<MotionData>& motions = system.motions;
  const std::vector<CouplerData>& couplers = system.couplers;
  const std::vector<SwitchData>& switches = system.switches;
  const std::vector<MarkerData>& markers = system.markers;
  const std::vector<ElementList>& elements = system.elements;
  const std::vector<DelayData>& delays = system.delays;
  const HydroData& hydro = system.hydro;
  const std::vector<StateBlock>& states = system.states;
  const std::vector<int>&group = system.group, &error_group = system.error_group;
  const VectorX& group_size = system.group_size;
  const std::vector<Block>& blocks = system.blocks;
  const Index n_q = system.n_q, n_u = system.n_u, n_z = system.n_z, u0 = system.u0, z0 = system.z0,
              memory0 = system.memory0, lambda0 = system.lambda0;
  const int n_groups = system.n_groups, n_mechanisms = system.n_mechanisms;
  const bool scales_follow = system.scales_follow;
  Index n_error_groups() const { return system.n_error_groups(); }
  bool has_memory() const { return system.has_memory(); }

  // Formulation chosen by the run.
  Formulation formulation = Formulation::stabilised;
  double baumgarte_rate = 0.0; ///< b of index 1 [1/s]
  /// Past up to the last accepted step (history.h); owned by the run. Null: everything was at rest
  /// before.
  const History* history = nullptr;

  const Held& state() const { return *this; }

  /// Sets the held values; call `lay_out` afterwards. Throws Error for values of another system.
  void set(const Held& held);

  // Layout of y and of the residual, derived from the above.
  Index n = 0; ///< number of unknowns
  /// Number of rows at velocity level, and of those also at position level
  Index n_lambda = 0, n_mu = 0;
  Index mu0 = 0, sigma0 = 0; ///< offsets of the multipliers of positions and of norms
  /// (n_rows,) indices of multipliers in y; `redundant`: the row does not hold
  std::vector<Index> lambdas, mus;
  VectorX scale;     ///< (n,) size of one unit of tolerance for each unknown
  VectorX relative;  ///< (n,) 1 if the tolerance also grows with |y|, else 0
  VectorX row_scale; ///< (n,) size of each residual row that matters, for messages
  /// (n,) true for multipliers, and for unknowns that elements declare algebraic
  std::vector<bool> algebraic;
  std::vector<std::string> names;     ///< (n,) names of the unknowns, as of channels
  std::vector<std::string> row_names; ///< (n,) names of the equations

  bool holds(const Row& row) const { return lambdas[row.number] != redundant; }
  Index lambda(const Row& row) const { return lambdas[row.number]; }
  Index mu(const Row& row) const { return mus[row.number]; }
  Index sigma(const BodyData& b) const { return b.norm < 0 ? -1 : sigma0 + b.norm; }
  Mode mode(const SwitchData& element) const { return modes[element.number]; }
  bool holds(const SwitchData& element) const { return SwitchData::holds(mode(element)); }

  /// Constant right side of a coupler without its drive; for a stop, its present bound.
  double offset(const CouplerData& c) const {
    if (c.of_switch < 0 || c.velocity_level)
      return c.offset;
    const SwitchData& stop = switches[static_cast<std::size_t>(c.of_switch)];
    return mode(stop) == Mode::lower ? stop.lower : stop.upper;
  }
  /// Signals of the laws of a list, as programs have set them.
  const double* held(const ElementList& list) const {
    return signals[static_cast<std::size_t>(&list - elements.data())].data();
  }
  /// Signals at time t [s]; signals with a lag are evaluated into `room`.
  const double* held(const ElementList& list, double t, std::vector<double>& room) const {
    const auto i = static_cast<std::size_t>(&list - elements.data());
    if (lags[i].empty())
      return signals[i].data();
    room = signals[i];
    for (std::size_t k = 0; k < lags[i].size(); ++k)
      room[k] = lags[i][k].at(t, signals[i][k]);
    return room.data();
  }
  /// Drive of a coupler: f, f', f''.
  std::array<double, 3> drive(const CouplerData& c, double t) const;

  /// Returns whether unknown i is a position or velocity, of a body or of a point.
  bool is_motion(Index i) const { return i < z0 || is_absolute(i); }
  /// Returns whether unknown i is a state whose scale does not follow the motion.
  bool is_absolute(Index i) const { return i >= z0 && i < lambda0 && relative[i] == 0.0; }
  bool is_algebraic(Index i) const { return algebraic[static_cast<std::size_t>(i)]; }
};

/// Sets the mode of a switch: whether its row holds, whether its friction slips. Call `lay_out`
/// afterwards; only q, u, z keep their places in y.
void set_mode(Regime& regime, const SwitchData& element, Regime::Mode mode);

/// Sets offsets, scales and names of all unknowns, after rows were added or removed.
void lay_out(Regime& regime);

/// Sets the scales of all unknowns, after the scales of the motion changed.
void set_scales(Regime& regime);

/// Converts y from another layout of the same system: q, u, z keep their places, the rest is zero.
void resize(const Regime& regime, VectorX& y);

/// Initial y: positions, velocities, states as declared; multipliers zero.
VectorX initial_state(const Regime& regime);

} // namespace hydrodae::system
