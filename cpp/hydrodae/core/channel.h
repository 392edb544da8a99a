#pragma once
/// Named, documented columns of the results: one, three or four.

#include <string>
#include <utility>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

struct Channel {
  std::string path;        ///< "bodies/flap1/velocity": group path and dataset name in the results
  int width = 1;           ///< 1 scalar, 3 vector, 4 quaternion (w, x, y, z)
  std::string unit;        ///< "m/s", "rad", "-", ...
  std::string frame;       ///< "world", "marker A of hinge1", "-"
  std::string description; ///< one sentence
  std::vector<std::pair<std::string, Vector3>> vectors = {}; ///< further data on the frame, by name
};

} // namespace hydrodae
