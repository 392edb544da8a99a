#pragma once
/// Keys of a [[joint]] by its type, from the rows and motions of the joint table.

#include <string>
#include <vector>

#include "hydrodae/joint/types.h"

namespace hydrodae::model {

struct JointKeys {
  std::vector<std::string> own;     ///< all keys that it may have
  std::vector<std::string> needed;  ///< required keys, besides those of every joint
  std::vector<std::string> initial; ///< keys of its table `initial`
};
JointKeys joint_keys(const joint::JointType& type);

} // namespace hydrodae::model
