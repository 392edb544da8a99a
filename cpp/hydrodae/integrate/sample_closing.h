#pragma once
/// Closes the joints of a sample between two steps. The interpolant of a method misses the
/// constraints by its own error, where the ends of its steps meet them.

#include <optional>

#include "hydrodae/linalg/saddle_point.h"

namespace hydrodae::integrate {

class SampleClosing {
public:
  /// Of rows that stay as they are in `system`, which must outlive it, as must `pattern`.
  /// @param rates false: gaps alone call for it, as rates of gaps cost a sample more than they are
  ///   worth where the method closes these itself
  SampleClosing(const system::Regime& system, const system::Pattern& pattern, bool rates);

  /// To be called at each step's end: drives and couplers of angles know on which turn these are.
  void accept(double t, const VectorX& y, const VectorX& yp) {
    equations_.accept(t, y, yp);
    linearised_ = false;
  }

  /// Moves q, then u, by the smallest amount in the metric of M onto the constraints, where they
  /// miss them by more than a tolerance far below any of a run. In a pose where that does not
  /// succeed (a singular one) they stay.
  void close(double t, VectorX& y);

  /// Reactions and accelerations from one solve by the loads at t. At rest steps are as long as the
  /// motion allows, and the multipliers between their ends follow no load; those of BDF are in no
  /// error test.
  void hold(double t, VectorX& y, VectorX& yp);

private:
  bool open(double t, const VectorX& y, const VectorX& yp);

  const system::Regime& s_;
  const Index first_; ///< row that is looked at
  linalg::Equations equations_;
  std::optional<linalg::SaddlePoint> saddle_; ///< made for the first sample that is open
  bool linearised_ = false; ///< for the samples of this step: one matrix serves them all
  VectorX residual_, closed_, rates_;
};

} // namespace hydrodae::integrate
