#pragma once
/// Reported quantities of a run: motions, every force component by name, reactions, energies.

#include <span>

#include "hydrodae/core/channel.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::measure {

using system::BodyState, system::ElementList, system::ElementScratch, system::HydroData,
    system::JointData, system::PortData, system::Regime, system::RowData, system::Turns,
    system::Workspace;

/// One force component on one body: force and moment about the centre of gravity, world axes.
struct ComponentLoad {
  int component = 0; ///< index into Observation::components
  int body = 0;
  double power = 0.0; ///< [W]
  Vector6 load = Vector6::Zero();
};

/// State of the scene at one instant, by quantities.
struct Observation {
  std::vector<std::string> components; ///< names: weight, hydrostatic, radiation, ..., constraints
  std::vector<element::Work> works;    ///< part in the energy balance, per component
  std::vector<ComponentLoad> loads;    ///< loads of all components except the reactions
  std::vector<Vector6> reactions;      ///< per joint: force and moment on B, axes of A's marker
  std::vector<Vector6> supports;       ///< per body: load of its locked coordinates on it, world
  std::vector<double> powers;          ///< per component [W]
  std::vector<std::array<double, 2>> motions; ///< per motion: coordinate and rate
  std::vector<double> constraints;            ///< per coupler: multiplier [N or N m]
  double kinetic = 0.0;                       ///< kinetic energy of the bodies [J]
  double kinetic_added_mass = 0.0;            ///< kinetic energy of the fluid, U . A_inf U / 2 [J]
  std::vector<double> mechanism_kinetic;      ///< kinetic energy of the bodies, per mechanism [J]
  std::vector<double> mechanism_constraints;  ///< power of the rows, per mechanism [W]
  std::vector<double> elements;               ///< channels of all laws, as declared
  bool in_waves = false;                      ///< true: an element reads waves
  double elevation = 0.0;                     ///< elevation of these waves at the origin [m]
  /// Potential energy of weight, hydrostatics, springs; zero in the reference pose [J]
  double potential = 0.0;
};

/// Evaluates observations; owns its scratch.
class Observer {
public:
  explicit Observer(const Regime& system);

  /// Fills `observation()` from t, y, y'. Allocates nothing after the first call.
  const Observation& observe(double t, const VectorX& y, const VectorX& yp);
  const Observation& observation() const { return out_; }

  /// Fills only loads, reactions, powers and kinetic energies: the data of an energy balance. Loads
  /// of the water on coordinates that cannot move are left out.
  const Observation& observe_balance(double t, const VectorX& y, const VectorX& yp);

  /// Fills only the loads of `observation()` and their powers, for reactions that do no work.
  void observe_powers(double t, const VectorX& y, const VectorX& yp);
  const std::vector<BodyState<double>>& bodies() const { return ws_.bodies; }

  /// Sets the turns of angles, from an accepted step.
  void follow(const Turns& turns) { ws_.turns = turns; }
  /// Writes the motions of the last `observe`.
  void read(Turns& turns) const { system::read_turns(s_, ws_, turns); }
  /// Displacement of a body from its reference pose at the last `observe` [m; rad].
  Vector6 displacement(int body, const VectorX& y) const {
    return system::displacement<double>(s_, ws_, body, y.data());
  }

private:
  void begin(double t, const VectorX& y, const VectorX& yp);
  const element::Elements& observe_loads(const ElementList& list, const double* y);
  void observe_loads(const HydroData& hydro, const double* y);
  void add_load(const Vector6& world_load);
  void observe_weight();
  void observe(const ElementList& list, const double* y);
  void observe(const HydroData& hydro, const double* y);
  void observe_ports(const ElementList& list, const ElementScratch<double>& scratch);
  void observe_motions(const system::PortData& port, const double* load,
                       const joint::Vec12<double>* rows);
  double power_absorbed(const element::Shape& shape, const PortData& port, const double* in,
                        const double* load, const joint::Vec12<double>* rows) const;
  void add_loads(const HydroData& hydro);
  void observe_tables(const HydroData& hydro);
  void observe_joints(const double* y);
  void share_reactions(const double* y);
  void subtract(const JointData& j, const joint::Vector12& load);
  void observe_energy();

  const Regime& s_;
  Workspace<double> ws_;
  Observation out_;
  std::vector<Vector6> totals_;         ///< per body: inertia minus all loads, tangent axes
  VectorX rate_, momentum_, radiation_; ///< (6 n,) rate of the momentum, momentum, radiation
  VectorX moving_; ///< (n_moving,) rows of moving coordinates, before they are spread
  /// Values of one list: energies and declared channels, or loads
  std::vector<double> element_values_;
  const element::Elements* in_waves_ = nullptr; ///< law that shows the elevation
  std::size_t next_load_ = 0;
  double* own_ = nullptr;             ///< next entry of Observation::elements
  std::vector<int> redundant_joints_; ///< joints with redundant rows
  VectorX shared_;                    ///< multipliers of all rows, if some are redundant
};

} // namespace hydrodae::measure
