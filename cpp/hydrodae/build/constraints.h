#pragma once
/// Constraint rows at a pose in units of the scales of the scene, for the assembly.

#include <functional>
#include <string>
#include <vector>

#include "hydrodae/build/rank.h"
#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::build {

/// Displacement of one unit of each velocity coordinate [m or rad], (n_u,).
VectorX displacement_scale(const system::System& system);

/// Constraint rows. Row i < n_rows belongs to the multiplier lambda0 + i; after them comes one row
/// for each motion with a given start. The regime must outlive this object, with the same layout.
class Constraints {
public:
  /// @param starts  conditions at the start; may be empty
  explicit Constraints(const system::Regime& regime, std::vector<system::MotionStart> starts = {});

  /// Computes gaps of rows at position level (0 at velocity level), and rates of all rows, in units
  /// of their scales; drives are taken at t = 0.
  void evaluate(const VectorX& y, VectorX& gaps, VectorX& rates);

  /// Gradient (rows, n_u) by scaled displacements at the last pose; rows with `wanted(i)` false
  /// stay empty.
  SparseMatrix gradient(const std::function<bool(Index)>& wanted) const;

  Index n_rows() const { return s_.n_lambda; }    ///< number of rows without those of the starts
  Index size() const { return size_.size(); }     ///< number of rows with those of the starts
  double size(Index i) const { return size_[i]; } ///< unit of row i [m or rad]
  /// Returns whether row i holds a position, or a rate.
  bool holds_position(Index i) const {
    return i < s_.n_lambda ? mu_[i] >= 0 : start(i).value.has_value();
  }
  bool holds_rate(Index i) const { return i < s_.n_lambda || start(i).rate.has_value(); }
  bool is_angle(Index i) const { return angle_[static_cast<std::size_t>(i)]; }
  double lever(Index i) const { return lever_[i]; } ///< arm of the smaller body [m]
  /// Returns whether row i belongs to a joint of the spanning tree. Joints enter it in the order of
  /// the case if their bodies are not connected yet. Its rows are independent in any pose.
  bool in_tree(Index i) const { return tree_[static_cast<std::size_t>(i)]; }
  const std::vector<bool>& tree() const { return tree_; } ///< (size(),) `in_tree` of all rows
  std::string name(Index i) const;                        ///< "joints/door gap along x"
  std::string key(Index i) const;                         ///< path in the case: "joint.door"

  /// Mechanisms connected by rows or conditions of the start; each closes separately.
  Index n_mechanisms() const { return n_mechanisms_; }
  /// Mechanism of row i
  Index mechanism(Index i) const { return mechanism_[static_cast<std::size_t>(i)]; }
  /// Mechanism of velocity coordinate k < n_u.
  Index owner(Index k) const { return owner_[static_cast<std::size_t>(k)]; }
  /// Largest entry of a vector of rows (size(),) in each mechanism.
  VectorX largest_row(const VectorX& rows) const;
  /// Largest entry of a vector of velocity coordinates (n_u,) in each mechanism.
  VectorX largest_motion(const VectorX& motion) const;
  /// Copies the positions of one mechanism.
  void copy_mechanism(Index mechanism, const VectorX& from, VectorX& to) const;

  const VectorX& scale() const { return scale_; }
  const system::Workspace<double>& workspace() const { return ws_; }
  const system::MotionStart& start(Index i) const {
    return starts_[static_cast<std::size_t>(i - s_.n_lambda)];
  }

private:
  void set_mechanisms();
  void set_tree();
  void append(std::vector<Eigen::Triplet<double>>& entries, const system::JointData& j, Index i,
              const joint::Vector12& gradient) const;

  const system::Regime& s_;
  std::vector<system::MotionStart> starts_;
  system::Workspace<double> ws_;
  VectorX scale_, size_, lever_;
  std::vector<Index> mu_;
  std::vector<bool> angle_, tree_;
  std::vector<Index> mechanism_, owner_; ///< mechanism of each row, and of each velocity coordinate
  Index n_mechanisms_ = 0;
};

} // namespace hydrodae::build
