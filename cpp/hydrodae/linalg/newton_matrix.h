#pragma once
/// Matrix dF/dy + alpha dF/dy' of Newton's iteration, real or complex, without the radiation
/// memory. Its states z depend on the bodies only through their velocities U, with the block
/// diagonal matrix D = alpha - A_r (blocks of one or two):
///
///   [ J     L C ] [dx]   [r_x]        (J + L T U_x) dx = r_x - L C D^-1 r_z,   T = C D^-1 B_r
///   [ -B U_x  D ] [dz] = [r_z]        dz = D^-1 (r_z + B_r U_x dx)
///
/// T is as dense as the added mass between the bodies, and depends on alpha alone. KLU solves the
/// reduced system. Velocities of points that move by themselves are eliminated first
/// (point_elimination.h).

#include <complex>
#include <vector>

#include "hydrodae/linalg/klu.h"
#include "hydrodae/linalg/point_elimination.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::linalg {

/// Visits the entries of L T U_x: visit(row, column, i, component of i, j, k) with bodies i and j
/// of the water, and k the rotation unknown or, from 4 on, the velocity unknown of j.
template <class Visit> void for_each_memory_entry(const system::Regime& s, Visit&& visit) {
  const std::vector<system::HydroBody>& bodies = s.hydro.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < bodies.size(); ++j) {
      if (!bodies[i].moves || !bodies[j].moves)
        continue;
      const system::BodyData &a = s.bodies[static_cast<std::size_t>(bodies[i].body)],
                             &b = s.bodies[static_cast<std::size_t>(bodies[j].body)];
      for (int m = 0; m < a.n_active; ++m) {
        for (int k = 0; k < b.n_position - b.n_translations; ++k)
          visit(a.u0 + m, b.q0 + b.n_translations + k, i, a.active[static_cast<std::size_t>(m)], j,
                k);
        for (int k = 0; k < b.n_active; ++k)
          visit(a.u0 + m, b.u0 + k, i, a.active[static_cast<std::size_t>(m)], j, 4 + k);
      }
    }
}

template <class Scalar> class NewtonMatrix {
public:
  /// @param system, pattern  must outlive this object; Part::condensed if there is memory
  NewtonMatrix(const system::Regime& system, const system::Pattern& pattern);

  /// Factorises; returns false if the matrix is singular or has values that are not finite. The
  /// parts must stay until the next call. `careful`: see SparseLu.
  bool factorise(const system::JacobianParts& parts, Scalar alpha, bool careful = false) {
    return factorise(parts, {alpha, alpha, alpha}, careful);
  }

  /// Values of alpha for the rates of positions, of memory states, and of all others.
  struct Alphas {
    Scalar of_most, of_positions, of_memory;
  };
  bool factorise(const system::JacobianParts& parts, const Alphas& alphas, bool careful = false);

  /// Overwrites b (n,) with the solution.
  void solve(Scalar* b);

  /// Subtracts the loads of memory states z (n_states,): b -= L C z, with the parts of the last
  /// `factorise`.
  void subtract_memory_loads(VecX<Scalar>& z, Scalar* b);

  /// Operations, see SparseLu.
  typename SparseLu<Scalar>::Work work() const { return lu_.work(); }

private:
  using VectorS = VecX<Scalar>;
  using MatrixS = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  void find_slots(const system::Pattern& pattern);
  void join(const system::JacobianParts& parts, const Alphas& alphas);
  void solve_bodies(Scalar* b);
  void find_transfer(Scalar alpha);
  void add_memory();
  void invert();
  void divide(Eigen::Ref<MatrixS> z) const;

  const system::Regime& s_;
  const water::ExponentialRadiation& rung_;
  const system::JacobianParts* parts_ = nullptr;
  PointElimination points_;
  SparseLu<Scalar> lu_;
  std::vector<Scalar> lifted_; ///< values of PointElimination::lifted
  Scalar rate_{};              ///< alpha of the places of points
  VectorS stays_;              ///< (PointElimination::n,) scratch
  std::size_t n_of_positions_; ///< number of entries in the columns of positions, which come first
  /// Slots of the entries that the memory adds to, in the order of its visits
  std::vector<Index> slots_;
  Scalar alpha_{};
  bool known_ = false; ///< true: T belongs to alpha
  MatrixS transfer_;   ///< T (n_moving, n_moving)
  MatrixX input_;      ///< B_r (n_states, n_moving)
  MatrixS driven_;     ///< D^-1 B_r
  MatrixS z_;          ///< (n_states, 1) scratch
  VectorS w_;          ///< (n_states,) scratch
  VectorS U_;          ///< (n_moving,) scratch
  struct Inverse {
    Scalar own, other;
  };
  std::vector<Inverse> inverse_; ///< D^-1, block by block
};

/// Pattern without the radiation memory, as a NewtonMatrix needs it.
inline system::Pattern condensed(const system::Regime& s, const system::Pattern& pattern) {
  return s.has_memory() ? system::find_pattern(s, system::Part::condensed) : pattern;
}

extern template class NewtonMatrix<double>;
extern template class NewtonMatrix<std::complex<double>>;

} // namespace hydrodae::linalg
