#pragma once
/// Rungs of radiation. A rung is a law along the hydrodynamic coordinates that move, with states of
/// its own:
///
///   F = F(U, U', z)   which the bodies lose,   z' = h(U, z)
///
/// system/hydrodynamics.h turns F into loads on the bodies, system/assembly_water.h its derivatives
/// into those of the loads. A rung is a struct with its word and keys in the case, with what it
/// reads of the database, and with the functions of `RadiationLaw` that differ from none. A new one
/// is one header, and one entry in water/radiation.h.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"
#include "hydrodae/hydro/database.h"
#include "hydrodae/water/added_mass.h"

namespace hydrodae::water {

/// Memory integral of a convolution at one time (system/history.h).
struct ConvolvedPast {
  VectorX memory;         ///< (n_moving,) int K U, without the parts of U(t) and U'(t) [N, N m]
  MatrixX by_U, by_U_dot; ///< (n_moving, n_moving) factors of U(t), U'(t) [N s/m, kg]
  VectorX memory_locked;  ///< (n_locked,) `memory` for the rows that do not move
  MatrixX locked_by_U, locked_by_U_dot; ///< (n_locked, n_moving)
};

/// What the loads of a rung depend on.
template <class S> struct WaterMotion {
  const WetBodies& wet;
  const S *U, *U_dot;        ///< (n_moving,)
  const S* z;                ///< states of the rung
  const S *weights, *slopes; ///< weights of pose tables, and their derivatives by the pose
  const ConvolvedPast* past; ///< null: everything was at rest before
  S* scratch;                ///< (n_scratch(),)
};

/// Database as a rung reads it.
struct RadiationSource {
  const hydro::Database& database;
  const hydro::MemoryFit* fit; ///< exponential fit of the case; null: nothing moves, or no fit
  const WetBodies& wet;
  /// (6 n_bodies,) "<body>.<dof>"; empty: the database does not load it
  std::vector<std::string> labels;

  /// Index among `among` of each coordinate of the bodies (6 n_bodies,); -1: missing.
  std::vector<int> all_places(const std::vector<std::string>& among) const;
  /// Index among `among` of each coordinate of U (n_moving,); -1: missing.
  std::vector<int> places(const std::vector<std::string>& among) const;
  /// Rows for all six coordinates of all bodies (zero where missing), and columns for U.
  MatrixX cut(const std::vector<std::string>& rows, const std::vector<std::string>& columns,
              const MatrixX& source) const;
};

/// A rung without loads: the functions that a rung may have. Matrices are along the hydrodynamic
/// coordinates.
struct RadiationLaw {
  static constexpr bool reads_tables = false; ///< true: reads A(w) and B(w)
  static constexpr bool reads_kernel = false; ///< true: reads K(t); its loads depend on the past
  static constexpr bool reads_fit = false;    ///< true: reads an exponential fit
  static constexpr std::string_view needs{};  ///< key that the case must have; empty: none
  /// Keys of [hydro] that belong to this rung alone.
  struct Keys {};
  template <class H> static Fields<H> keys() { return {}; }

  /// Reads the database; sets the added mass. Returns the labels of the loads that it gives. Throws
  /// ModelError.
  std::vector<std::string> read(const RadiationSource& from, const Keys&, AddedMass& added) {
    added.all = from.cut(from.database.coordinates, from.database.coordinates,
                         from.database.added_mass_inf);
    return from.database.coordinates;
  }
  /// Finds the products, after all data are there.
  void link(const WetBodies&) {}
  /// Adds the radiation `there` of one body at the next pose of its table. `weight`: index of the
  /// pose's weight; `blends_memory`: each pose has a memory of its own.
  template <class Law>
  void add_pose(const Law& /*there*/, const WetBodies&, int /*hydro_body*/, int /*weight*/,
                bool /*blends_memory*/) {}
  /// Adds the memory of one body at rest, if its poses share it.
  template <class Law> void add_rest(const Law&) {}

  int n_states() const { return 0; }
  /// Number of states that linalg/newton_matrix.h eliminates: all or none.
  int n_condensed() const { return 0; }
  std::vector<element::Unknown> unknowns(const VectorX& /*velocities: size of U*/) const {
    return {};
  }
  Index n_scratch(const WetBodies&) const { return 0; }
  bool acts() const { return false; }
  /// visit(row, column): coordinates of U that load each other.
  template <class Visit> void for_each_coupling(Visit&&) const {}

  /// Adds F to `force` (n_moving,).
  template <class S> void add_loads(const WaterMotion<S>&, S* /*force*/) const {}
  /// Adds F for all coordinates of all bodies to `force` (6 n_bodies,).
  void add_all_loads(const WaterMotion<double>&, double* /*force*/) const {}
  /// Adds factor h(U, z) to `rates` (n_states,).
  template <class S> void add_rates(const WaterMotion<S>&, double /*factor*/, S* /*rates*/) const {}

  /// Adds dF_i/dU'_j and dF_i/dU_j of two bodies; returns whether there may be the second.
  bool add_gradient(const WaterMotion<double>&, std::size_t /*i*/, std::size_t /*j*/,
                    Matrix6& /*by_U_dot*/, Matrix6& /*by_U*/) const {
    return false;
  }
  /// Adds dF_i/ds of a body with a table over the pose s.
  void add_by_pose(const WaterMotion<double>&, std::size_t /*i*/, Vector6& /*force*/) const {}
  /// visit(state, dF_i/dz).
  template <class Visit>
  void for_each_state_load(const WaterMotion<double>&, std::size_t /*i*/, Visit&&) const {}
  /// visit(row, column, dh/dz), also for zeros on the diagonal.
  template <class Visit> void for_each_rate_by_state(Visit&&) const {}
  /// visit(row, component of body i, dh/dU).
  template <class Visit> void for_each_drive(std::size_t /*i*/, Visit&&) const {}
};

} // namespace hydrodae::water
