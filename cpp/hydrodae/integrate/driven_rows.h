#pragma once
/// Constraints that drives move, between the stages of a step. At the stages they hold, whatever
/// the step: no estimate made of stages sees them.

#include <utility>
#include <vector>

#include "hydrodae/system/regime.h"
#include "hydrodae/system/system.h"

namespace hydrodae::integrate {

class DrivenRows {
public:
  /// Those that drives move, and those of joints that pass their motion on.
  explicit DrivenRows(const system::Regime& system);

  bool empty() const { return rows_.empty(); }

  /// The largest gap of a residual (n,), in units of the motion of its group.
  double largest(const VectorX& residual) const;

private:
  const system::Regime& s_;
  std::vector<std::pair<Index, int>> rows_; ///< with their groups
};

} // namespace hydrodae::integrate
