#pragma once
/// Which keys a [[joint]] has by its type: they follow from the rows and motions of the joint
/// table.

#include <string>
#include <vector>

#include "hydrodae/joint/types.h"

namespace hydrodae::model {

struct JointKeys {
  std::vector<std::string> own;     ///< all that it may have
  std::vector<std::string> needed;  ///< beside what every joint must have
  std::vector<std::string> initial; ///< of its table `initial`
};
JointKeys joint_keys(const joint::JointType& type);

} // namespace hydrodae::model
