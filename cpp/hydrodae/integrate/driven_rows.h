#pragma once
/// Driven constraints between the stages of a step. They hold at the stages for any step length, so
/// that error estimates from stages are blind to them.

#include <utility>
#include <vector>

#include "hydrodae/system/regime.h"
#include "hydrodae/system/system.h"

namespace hydrodae::integrate {

class DrivenRows {
public:
  /// Rows that drives move, and rows of joints that transmit their motion.
  explicit DrivenRows(const system::Regime& system);

  bool empty() const { return rows_.empty(); }

  /// Largest gap in a residual (n,), in units of the motion of its group.
  double largest(const VectorX& residual) const;

private:
  const system::Regime& s_;
  std::vector<std::pair<Index, int>> rows_; ///< rows with their groups
};

} // namespace hydrodae::integrate
