#pragma once
/// Gaps of redundant constraint rows, which the assembly leaves out because they follow from
/// others. A gap that stays zero proves it.

#include <string>

#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// Arm of the body with the smaller arm, among the moving bodies of a joint [m].
double smaller_arm(const System& system, const JointData& joint);

class DroppedRows {
public:
  /// @param regime  must outlive this object and keep its layout of positions and velocities
  explicit DroppedRows(const Regime& regime);

  bool empty() const { return joints_.empty() && couplers_.empty(); }

  /// Gap of a position row [m or rad] or of a rate row [m/s or rad/s].
  struct Gap {
    /// "joint.lower", "joints/lower gap along x"; empty: no row was left out
    std::string key, name;
    double gap = 0.0;
    /// Gap relative to the arm or one radian; of a rate row, to its largest rate
    double part = 0.0;
    const char* unit = "";
  };

  /// Largest relative gap (`part`) at time t and state y.
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
