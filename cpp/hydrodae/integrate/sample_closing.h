#pragma once
/// Closes the joints of a sample between two steps. The ends of steps meet the constraints; the
/// interpolant misses them by its error.

#include <optional>

#include "hydrodae/linalg/saddle_point.h"

namespace hydrodae::integrate {

class SampleClosing {
public:
  /// @param system  its rows must not change; like `pattern` it must outlive this object
  /// @param rates  false: only position gaps trigger the closing, for methods that close the rates
  /// themselves
  SampleClosing(const system::Regime& system, const system::Pattern& pattern, bool rates);

  /// Takes the end of a step, which sets the turns of the angles of drives and couplers.
  void accept(double t, const VectorX& y, const VectorX& yp) {
    equations_.accept(t, y, yp);
    linearised_ = false;
  }

  /// Moves q, then u, onto the constraints by the smallest amount in the metric of M, if the gap
  /// exceeds a tolerance far below that of any run. In a singular pose, where this fails, they
  /// stay.
  void close(double t, VectorX& y);

  /// Computes reactions and accelerations in one solve from the loads at t. At rest, steps are as
  /// long as the motion allows, and multipliers between their ends do not follow the loads; the
  /// error test of BDF excludes them.
  void hold(double t, VectorX& y, VectorX& yp);

private:
  bool open(double t, const VectorX& y, const VectorX& yp);

  const system::Regime& s_;
  const Index first_; ///< first row that is checked
  linalg::Equations equations_;
  std::optional<linalg::SaddlePoint> saddle_; ///< made for the first open sample
  bool linearised_ = false;                   ///< true: the matrix serves the samples of this step
  VectorX residual_, closed_, rates_;
};

} // namespace hydrodae::integrate
