#pragma once
/// Elimination of the radiation memory at all stages of a step. Its states are linear with constant
/// coefficients, and depend on the bodies only through their velocities U. With increments Z_i and
/// their rates sum_j (a^-1)_ij Z_j / h:
///
///   sum_j ((a^-1)_ij / h - [i = j] A_r) dz_j - B_r dU_i = r_i
///   dz_i = sum_j G_ij (r_j + B_r dU_j)
///
/// Stage i of the bodies receives L C G_ij B_r dU_j from each stage j: as dense as the added mass
/// between the bodies. linalg/newton_matrix.h does the same for one stage.

#include <algorithm>
#include <vector>

#include "hydrodae/linalg/newton_matrix.h"
#include "hydrodae/math/dense.h"

namespace hydrodae::integrate {

class StageMemory {
public:
  explicit StageMemory(const system::Regime& s)
      : s_(s), rung_(s.hydro.as<Rung>()), input_(rung_.input_matrix()) {}

  /// Takes the ports of a stage from its Jacobian.
  void take(std::size_t stage, const system::JacobianParts& parts) {
    ports_.resize(std::max(ports_.size(), stage + 1));
    ports_[stage] = {parts.memory, parts.memory_weights};
  }

  /// Computes G and T_ij = C G_ij B_r for the step h, once the ports of all stages are there.
  void prepare(const MatrixX& a_inverse, double h) {
    const auto s = a_inverse.rows();
    const bool weighted = ports_.front().weights.size() > 0;
    if (h == h_ && !weighted)
      return;
    h_ = h;
    responses_.clear();
    for (const Rung::Block& block : rung_.blocks) {
      const Index m = block.pair ? 2 : 1;
      MatrixX K = MatrixX::Zero(m * s, m * s);
      for (Index i = 0; i < s; ++i)
        for (Index j = 0; j < s; ++j)
          for (Index c = 0; c < m; ++c)
            K(m * i + c, m * j + c) = a_inverse(i, j) / h - (i == j ? block.a : 0.0);
      for (Index i = 0; i < s && block.pair; ++i) {
        K(m * i, m * i + 1) = block.b;
        K(m * i + 1, m * i) = -block.b;
      }
      responses_.push_back(solve_square(K, MatrixX::Identity(m * s, m * s)));
    }
    transfers_.resize(static_cast<std::size_t>(s * s));
    MatrixX driven(input_.rows(), input_.cols());
    for (Index i = 0; i < s; ++i)
      for (Index j = 0; j < s; ++j) {
        std::size_t k = 0;
        for (const Rung::Block& block : rung_.blocks) {
          const Index m = block.pair ? 2 : 1;
          driven.middleRows(block.state, m).noalias() =
              responses_[k++].block(m * i, m * j, m, m) * input_.middleRows(block.state, m);
        }
        if (weighted)
          driven.array().colwise() *= ports_[static_cast<std::size_t>(i)].weights.array();
        transfers_[static_cast<std::size_t>(i * s + j)].noalias() = rung_.output * driven;
      }
  }

  /// Visits the loads on the bodies at stage i per velocity at stage j: visit(k-th entry of
  /// linalg::for_each_memory_entry, value).
  template <class Visit> void for_each_load(Index i, Index j, Index stages, Visit&& visit) const {
    const std::vector<system::HydroBody>& bodies = s_.hydro.bodies;
    const MatrixX& T = transfers_[static_cast<std::size_t>(i * stages + j)];
    std::size_t last_row = bodies.size(), last_column = last_row, entry = 0;
    Eigen::Matrix<double, 6, 10> of_pair;
    linalg::for_each_memory_entry(
        s_, [&](Index, Index, std::size_t row, int component, std::size_t column, int k) {
          if (row != last_row || column != last_column) {
            Matrix6 block = Matrix6::Zero();
            for (int m = 0; m < 6; ++m)
              for (int n = 0; n < 6; ++n)
                if (bodies[row].moving[m] >= 0 && bodies[column].moving[n] >= 0)
                  block(m, n) = T(bodies[row].moving[m], bodies[column].moving[n]);
            of_pair.noalias() = ports_[static_cast<std::size_t>(i)].memory[row].L * block *
                                ports_[static_cast<std::size_t>(j)].memory[column].by_unknown;
            last_row = row;
            last_column = column;
          }
          visit(entry++, of_pair(component, k));
        });
  }

  /// Eliminates the residuals r of the states from those of the bodies, and keeps them; the rows of
  /// the states become rows of the identity.
  void forward(MatrixX& residual) {
    const system::HydroData& hydro = s_.hydro;
    auto rows = residual.middleRows(hydro.z0, rung_.n_states());
    kept_ = rows;
    rows.setZero();
    MatrixX z = respond(kept_);
    for (Index i = 0; i < z.cols(); ++i) {
      const Ports& ports = ports_[static_cast<std::size_t>(i)];
      if (ports.weights.size() > 0)
        z.col(i).array() *= ports.weights.array();
      const VectorX load = rung_.output * z.col(i);
      for (std::size_t k = 0; k < hydro.bodies.size(); ++k) {
        const system::HydroBody& hb = hydro.bodies[k];
        const system::BodyData& body = s_.bodies[static_cast<std::size_t>(hb.body)];
        const Vector6 force = ports.memory[k].L * hb.gather<double>(load);
        for (int c = 0; c < body.n_active; ++c)
          residual(body.u0 + c, i) -= force[body.active[static_cast<std::size_t>(c)]];
      }
    }
  }

  /// Computes the increments of the states from those of the bodies.
  void backward(MatrixX& increment) const {
    const system::HydroData& hydro = s_.hydro;
    MatrixX driven = kept_;
    for (Index i = 0; i < driven.cols(); ++i) {
      VectorX U = VectorX::Zero(hydro.n_moving);
      for (std::size_t k = 0; k < hydro.bodies.size(); ++k) {
        const system::HydroBody& hb = hydro.bodies[k];
        const system::BodyData& body = s_.bodies[static_cast<std::size_t>(hb.body)];
        const auto& by = ports_[static_cast<std::size_t>(i)].memory[k].by_unknown;
        Vector6 velocity = Vector6::Zero();
        for (int c = 0; c < body.n_position - body.n_translations; ++c)
          velocity += increment(body.q0 + body.n_translations + c, i) * by.col(c);
        for (int c = 0; c < body.n_active; ++c)
          velocity += increment(body.u0 + c, i) * by.col(4 + c);
        for (int c = 0; c < 6; ++c)
          if (hb.moving[c] >= 0)
            U[hb.moving[c]] = velocity[c];
      }
      driven.col(i) += input_ * U;
    }
    increment.middleRows(hydro.z0, rung_.n_states()) = respond(driven);
  }

private:
  using Rung = water::ExponentialRadiation;
  struct Ports {
    std::vector<system::MemoryPort> memory;
    VectorX weights;
  };

  /// Response sum_j G_ij r_j, one column for each stage.
  MatrixX respond(const MatrixX& r) const {
    MatrixX out(r.rows(), r.cols());
    std::size_t k = 0;
    for (const Rung::Block& block : rung_.blocks) {
      const Index m = block.pair ? 2 : 1;
      const MatrixX own = r.middleRows(block.state, m);
      const VectorX all = responses_[k++] * Eigen::Map<const VectorX>(own.data(), own.size());
      out.middleRows(block.state, m) = Eigen::Map<const MatrixX>(all.data(), m, r.cols());
    }
    return out;
  }

  const system::Regime& s_;
  const Rung& rung_;
  MatrixX input_; ///< B_r (n_states, n_moving)
  std::vector<Ports> ports_;
  double h_ = 0.0;
  std::vector<MatrixX> responses_; ///< responses G of each block, by stage and state
  std::vector<MatrixX> transfers_; ///< transfers T_ij at [i * s + j]
  MatrixX kept_;                   ///< (n_states, s) residuals r
};

} // namespace hydrodae::integrate
