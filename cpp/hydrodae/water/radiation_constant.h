#pragma once
/// Radiation at one frequency w: the added mass A(w) in place of that at infinite frequency, and
/// the damping
///
///   F = B(w) U

#include "hydrodae/water/radiation_law.h"

namespace hydrodae::water {

struct ConstantRadiation : RadiationLaw {
  static constexpr std::string_view type = "constant";
  static constexpr std::string_view doc = "added mass and damping at one frequency";
  static constexpr bool reads_tables = true;
  static constexpr std::string_view needs = "frequency";
  struct Keys {
    std::optional<double> frequency;
  };
  template <class H> static Fields<H> keys() {
    return {{"frequency", &H::frequency, "rad/s",
             "Frequency of added mass and damping of constant radiation.", false, more_than(0)}};
  }

  /// Damping of one body over its pose.
  struct Table {
    int hydro_body = 0, first_weight = 0;
    std::vector<Matrix6> damping; ///< damping at each pose
  };
  double frequency = 0.0;       ///< [rad/s]
  MatrixX damping, damping_all; ///< B (n_moving, n_moving), (6 n_bodies, n_moving)
  VectorX largest;              ///< (n_moving,) damping on itself, largest over all frequencies
  BlockMatrix product, product_all;
  std::vector<Table> tables; ///< tables of bodies whose damping follows their pose

  std::vector<std::string> read(const RadiationSource& from, const Keys& keys, AddedMass& added);
  void link(const WetBodies&) {
    product = BlockMatrix(damping);
    product_all = BlockMatrix(damping_all);
  }
  void add_pose(const ConstantRadiation& there, const WetBodies& wet, int hydro_body, int weight,
                bool) {
    if (tables.empty() || tables.back().hydro_body != hydro_body)
      tables.push_back({hydro_body, weight, {}});
    tables.back().damping.push_back(
        own_block(wet.bodies[static_cast<std::size_t>(hydro_body)], hydro_body, there.damping_all));
  }

  bool operator==(const ConstantRadiation& other) const {
    return damping.rows() == other.damping.rows() && damping == other.damping;
  }
  bool acts() const { return true; }
  template <class Visit> void for_each_coupling(Visit&& visit) const {
    product.for_each([&](Index row, Index column, double) { visit(row, column); });
  }

  template <class S> void add_loads(const WaterMotion<S>& m, S* force) const {
    for (const Table& table : tables) {
      const HydroBody& hb = m.wet.bodies[static_cast<std::size_t>(table.hydro_body)];
      scatter<S>(hb, blend<S>(table.damping, m.weights + table.first_weight, hb.gather<S>(m.U)),
                 force);
    }
    product.add_product(m.U, force);
  }
  void add_all_loads(const WaterMotion<double>& m, double* force) const {
    product_all.add_product(m.U, force);
    for (const Table& table : tables) {
      const HydroBody& hb = m.wet.bodies[static_cast<std::size_t>(table.hydro_body)];
      Eigen::Map<Vector6>(force + 6 * table.hydro_body) +=
          blend<double>(table.damping, m.weights + table.first_weight, hb.gather<double>(m.U));
    }
  }
  bool add_gradient(const WaterMotion<double>& m, std::size_t i, std::size_t j, Matrix6&,
                    Matrix6& by_U) const {
    const HydroBody &a = m.wet.bodies[i], &b = m.wet.bodies[j];
    if (i == j && a.table >= 0)
      by_U += blended(m, a, m.weights);
    by_U += hydro_block(damping, a, b);
    return true;
  }
  void add_by_pose(const WaterMotion<double>& m, std::size_t i, Vector6& force) const {
    const HydroBody& hb = m.wet.bodies[i];
    force += blended(m, hb, m.slopes) * hb.gather<double>(m.U);
  }

private:
  Matrix6 blended(const WaterMotion<double>&, const HydroBody& hb, const double* weights) const {
    const Table& table = tables[static_cast<std::size_t>(hb.table)];
    return moving_rows(hb, blend(table.damping, weights + table.first_weight));
  }
};

} // namespace hydrodae::water
