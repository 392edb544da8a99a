#pragma once
/// What holds of a System at a time of a run: which rows, with what multipliers and tolerances, and
/// what programs and events have set. All that changes between two accepted steps, apart from y, is
/// here; the System itself is constant.

#include "hydrodae/system/system.h"

namespace hydrodae::system {

/// Which equations the rows of the multipliers hold. In all but the first mu = 0.
///   stabilised   0 = g, 0 = G u               index 2 (Gear, Gupta and Leimkuhler)
///   index_2      0 = G u                      the gap g drifts
///   index_3      0 = g
///   index_1      0 = G u' + gamma + 2 b (G u) + b^2 g    Baumgarte's rate b [1/s], 0: none
/// Rows given at velocity level stay there, but in index 1.
enum class Formulation { stabilised, index_2, index_3, index_1 };

class History;

/// A signal that follows what it is set to like an actuator of first order: T x' = target - x,
/// exactly, as the target is held.
///
///   x(t) = target + (x0 - target) exp(-(t - t0) / T)
struct Lag {
  double time = 0.0;              ///< T [s]; 0: at once
  double since = 0.0, from = 0.0; ///< t0 [s] of the last target, x0

  double at(double t, double target) const {
    return time > 0.0 && from != target ? target + (from - target) * std::exp((since - t) / time)
                                        : target;
  }
};

/// What events and programs have set.
struct Held {
  std::vector<SwitchData::State> modes;     ///< (n_switches,)
  std::vector<std::vector<double>> signals; ///< of the laws of each list
  std::vector<std::vector<Lag>> lags; ///< of the first signals of each list; empty: none has one
  std::vector<double> static_loads;   ///< (n_switches,) of dry friction
  std::vector<double> rates;          ///< (n_couplers,) constant part of drives at velocity level
  std::vector<double> nearby;         ///< Turns::value near those now: they fix the turn
  VectorX motion_scale;               ///< (n_groups,) part of the full scales that its motion takes
  VectorX translation_scale;          ///< (n_groups,) of which its translations take so much
};

struct Regime : Held {
  using Mode = SwitchData::State;

  /// As a run begins: stabilised, no switch holds, inputs as the case gives them. The system must
  /// outlive it, and stay as it is.
  explicit Regime(const System& system);

  /// With switches as they are in `modes` (n_switches,).
  Regime(const System& system, const std::vector<SwitchData::State>& modes);

  const System& system;
  operator const System&() const { return system; }

  // The system's own, by the same names.
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

  // What the run has chosen.
  Formulation formulation = Formulation::stabilised;
  double baumgarte_rate = 0.0; ///< b of index 1 [1/s]
  /// What has happened up to the last accepted step (history.h); owned by the run. Null: all has
  /// been at rest for ever.
  const History* history = nullptr;

  const Held& state() const { return *this; }

  /// Then `lay_out` has to be called. Throws Error for what another system holds.
  void set(const Held& held);

  // What follows from that: the layout of y and of the residual.
  Index n = 0;                        ///< unknowns
  Index n_lambda = 0, n_mu = 0;       ///< rows at velocity level, those also at position level
  Index mu0 = 0, sigma0 = 0;          ///< where multipliers of positions and of norms begin
  std::vector<Index> lambdas, mus;    ///< (n_rows,) `redundant`: the row does not hold
  VectorX scale;                      ///< (n,) what one unit of tolerance means for each unknown
  VectorX relative;                   ///< (n,) 1 where the tolerance also grows with |y|, else 0
  VectorX row_scale;                  ///< (n,) size of each residual row that matters, for messages
  std::vector<bool> algebraic;        ///< (n,) multipliers, and what elements declare so
  std::vector<std::string> names;     ///< (n,) of the unknowns, as channels
  std::vector<std::string> row_names; ///< (n,) of the equations

  bool holds(const Row& row) const { return lambdas[row.number] != redundant; }
  Index lambda(const Row& row) const { return lambdas[row.number]; }
  Index mu(const Row& row) const { return mus[row.number]; }
  Index sigma(const BodyData& b) const { return b.norm < 0 ? -1 : sigma0 + b.norm; }
  Mode mode(const SwitchData& element) const { return modes[element.number]; }
  bool holds(const SwitchData& element) const { return SwitchData::holds(mode(element)); }

  /// What the motions of a coupler sum up to, its drive apart: of a stop the bound that it is at.
  double offset(const CouplerData& c) const {
    if (c.of_switch < 0 || c.velocity_level)
      return c.offset;
    const SwitchData& stop = switches[static_cast<std::size_t>(c.of_switch)];
    return mode(stop) == Mode::lower ? stop.lower : stop.upper;
  }
  /// Signals of the laws of one of its lists, as programs have set them.
  const double* held(const ElementList& list) const {
    return signals[static_cast<std::size_t>(&list - elements.data())].data();
  }
  /// What they are at the time t [s], those with a lag in `room`.
  const double* held(const ElementList& list, double t, std::vector<double>& room) const {
    const auto i = static_cast<std::size_t>(&list - elements.data());
    if (lags[i].empty())
      return signals[i].data();
    room = signals[i];
    for (std::size_t k = 0; k < lags[i].size(); ++k)
      room[k] = lags[i][k].at(t, signals[i][k]);
    return room.data();
  }
  /// f, f', f'' of its drive.
  std::array<double, 3> drive(const CouplerData& c, double t) const;

  /// A position or velocity, of a body or of a point.
  bool is_motion(Index i) const { return i < z0 || is_absolute(i); }
  /// A state whose scale does not follow the motion.
  bool is_absolute(Index i) const { return i >= z0 && i < lambda0 && relative[i] == 0.0; }
  bool is_algebraic(Index i) const { return algebraic[static_cast<std::size_t>(i)]; }
};

/// Puts a switch into a mode: its row holds or not, its friction slips or not. Then `lay_out` has
/// to be called; of y only q, u, z keep their places.
void set_mode(Regime& regime, const SwitchData& element, Regime::Mode mode);

/// Offsets, scales and names of all unknowns, after rows came or went.
void lay_out(Regime& regime);

/// Scales of all unknowns, after those of the motion changed.
void set_scales(Regime& regime);

/// y from another layout of the same system: only q, u, z keep their places, the rest is zero.
void resize(const Regime& regime, VectorX& y);

/// The start: y with positions, velocities, states as declared and zero multipliers.
VectorX initial_state(const Regime& regime);

} // namespace hydrodae::system
