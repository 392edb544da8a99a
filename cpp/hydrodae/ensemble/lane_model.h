#pragma once
/// Accelerations of several runs of one scene side by side:
///
///   [ M   G^T ] [  u'     ]   [ f      ]
///   [ G   0   ] [ -lambda ] = [ -gamma ]
///
/// Masses, joints and the water are the same in all runs, and are evaluated in lanes. The laws of
/// the elements (waves, take-offs, moorings) are those of each run, and are evaluated one run after
/// the other.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/ensemble/lane_cholesky.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::ensemble {

using BodyLanes = element::BodyState<Lanes>;

class LaneModel {
public:
  /// @param runs `width` regimes that differ in the laws of their elements alone (see
  ///   `why_not_together`); they outlive the model
  explicit LaneModel(std::span<const system::Regime* const> runs);

  Index size() const { return n_; } ///< number of q, u and z

  /// Computes y' of q, u and z from y (n,). Lanes without finite accelerations are cleared in
  /// `sound`.
  void accelerations(double t, const Lanes* y, Lanes* yp);

  /// Lets the loads on the bodies of run k judge the state of the last `accelerations`. Throws
  /// SolverError where one of them has no meaning there, as beyond the headings of a database.
  void check(std::size_t k, double t) const;

  /// Moves q, then u, by the smallest amount in the metric of M onto the constraints, with the
  /// matrix of the last `accelerations`. Lanes that stay open are cleared in `sound`.
  void project(Lanes* y);

  /// True for lanes that have been computed without failure.
  std::array<bool, width> sound;

  // Results of the last `accelerations`:
  /// Power absorbed by take-offs [W]
  const std::vector<Lanes>& absorbed() const { return absorbed_; }
  /// Power of the loads and kinetic energy: of the scene with the fluid in it, without the
  /// reactions; then, where there are several, of the bodies of each mechanism by all loads.
  struct Balance {
    Lanes power, kinetic; ///< [W], [J]
  };
  const std::vector<Balance>& balances() const { return balances_; }

  const std::vector<std::string>& take_offs() const { return take_offs_; }

  const std::vector<BodyLanes>& bodies() const { return bodies_; } ///< without accelerations
  /// Multipliers of the rows that hold, joint by joint [N, N m].
  const std::vector<Lanes>& multipliers() const { return lambda_; }
  /// What the laws of run k saw and answered, and its unknowns.
  const system::Workspace<double>& state(std::size_t k) const { return runs_[k].state; }
  const VectorX& unknowns(std::size_t k) const { return runs_[k].y; }
  const system::Regime& regime(std::size_t k) const { return runs_[k].s; }

  /// The angles of run k are followed from y, y' at an accepted time on.
  void accept(int k, double t, const VectorX& y, const VectorX& yp);
  const system::Turns& turns(int k) const { return runs_[static_cast<std::size_t>(k)].state.turns; }

private:
  struct Run {
    explicit Run(const system::Regime& regime);
    const system::Regime& s;
    system::Workspace<double> state;
    VectorX y, still, residual; ///< (n,) `still`: zero rates
  };
  /// A row of a joint that holds, and the clusters of its bodies: one or two.
  struct Row {
    const system::JointData* joint = nullptr;
    joint::BasicRow kind;
    Index mu = 0, lambda = 0; ///< indices in the residual
    struct Part {
      int cluster = 0;
      Index from = 0;       ///< first entry that is not zero
      std::vector<Lanes> w; ///< L^-1 G^T
    };
    std::vector<Part> parts;
    Lanes bias; ///< (dG/dt) u
    joint::Vec12<Lanes> gradient;
  };
  /// Bodies whose accelerations feel each other through the water.
  struct Cluster {
    std::vector<int> bodies;
    LaneCholesky mass;
    std::vector<Lanes> load; ///< (n,) right-hand side, then accelerations
    struct Feels {           ///< row of a joint that acts on the cluster
      Index row = 0;         ///< in `rows_`
      std::size_t part = 0;  ///< part of that row
    };
    std::vector<Feels> rows;
    Row::Part& part(std::vector<Row>& all, std::size_t i) const {
      return all[static_cast<std::size_t>(rows[i].row)].parts[rows[i].part];
    }
  };
  /// Turns of the force and of the moment from hydrodynamic axes into those of the momentum rows.
  struct Turn {
    Mat3<Lanes> force, moment;
  };

  void find_clusters();
  void find_rows();
  void see_bodies();
  void add_elements(double t, const Lanes* y, Lanes* yp);
  void add_water(const Lanes* y, Lanes* yp);
  void add_inertia(const Lanes* y, Lanes* yp);
  Vec6<Lanes> of_body(const system::HydroBody& hb, const std::vector<Lanes>& values) const;
  Turn turn_of(const system::HydroBody& hb) const;
  void fill_masses();
  void add_water_mass(std::size_t i, std::size_t j);
  void fill_row(Row& row, const joint::Geometry<Moving>& g);
  void fill_rows();
  void factorise_rows();
  void solve();
  void add_reactions();
  void weigh_mechanisms(const Lanes* yp);
  template <class S> joint::Geometry<S> geometry(const system::JointData& j) const;
  void close();
  void see(const Lanes* y);
  void put(Lanes* y) const;
  Lanes find_gaps(const Lanes* y);
  Lanes find_rates(const Lanes* y);
  double widest(const Lanes& gap) const;
  void move_positions(Lanes* y);
  void take(const Lanes* y, std::size_t k);

  const system::Regime& s_; ///< regime of the first run, for common data
  const Index n_;
  std::vector<Run> runs_;
  std::vector<BodyLanes> bodies_;
  std::vector<Vec6<Lanes>> loads_;
  std::vector<Lanes> U_, U_dot_, momentum_, force_, damped_;
  std::vector<Turn> turns_; ///< turns of each hydrodynamic body
  std::vector<Cluster> clusters_;
  std::vector<int> cluster_of_; ///< cluster of each body; -1: fixed
  std::vector<Index> offset_;   ///< offset of each body in its cluster
  std::vector<Row> rows_;
  LaneCholesky schur_; ///< G M^-1 G^T
  std::vector<Lanes> lambda_;
  std::vector<Lanes> gap_;  ///< gap of each row, or its rate
  std::vector<Lanes> step_; ///< (n_u,) step that closes the gaps
  std::vector<Lanes> absorbed_;
  std::vector<Balance> balances_;
  std::vector<std::string> take_offs_;
};

} // namespace hydrodae::ensemble
