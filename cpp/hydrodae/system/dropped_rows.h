#pragma once
/// Constraint rows that the assembly left out because they follow from others: their gaps are the
/// proof that they do.

#include <string>

#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// Arm of the smaller of the bodies of a joint that move [m].
double smaller_arm(const System& system, const JointData& joint);

class DroppedRows {
public:
  /// The regime must outlive it, with the same layout of positions and velocities.
  explicit DroppedRows(const Regime& regime);

  bool empty() const { return joints_.empty() && couplers_.empty(); }

  /// A gap of a position row [m or rad], or of a rate row [m/s or rad/s].
  struct Gap {
    std::string key, name; ///< "joint.lower", "joints/lower gap along x"; empty: none was left out
    double gap = 0.0;
    double part = 0.0; ///< of the arm or of one radian; of a rate, of the largest rate in the row
    const char* unit = "";
  };

  /// The largest gap, by its part, at y and t.
  Gap largest(double t, const VectorX& y);

private:
  struct JointRow {
    const JointData* joint;
    const RowData* row;
    double arm;
  };
  struct CouplerRow {
    const CouplerData* coupler;
    double arm;
  };
  double gap(const CouplerRow& row, double t, double& size);

  const Regime& s_;
  Workspace<double> workspace_;
  VectorX rest_; ///< (n,) zero rates
  std::vector<JointRow> joints_;
  std::vector<CouplerRow> couplers_;
};

} // namespace hydrodae::system
