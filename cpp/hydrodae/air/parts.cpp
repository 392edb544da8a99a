#include "hydrodae/air/parts.h"

#include <algorithm>
#include <numeric>

namespace hydrodae::air {

int index_of(const std::vector<Chamber>& chambers, const std::string& name) {
  return static_cast<int>(std::find_if(chambers.begin(), chambers.end(),
                                       [&](const Chamber& c) { return c.name == name; }) -
                          chambers.begin());
}

std::vector<Parts> networks(const Parts& all) {
  std::vector<int> root(all.chambers.size());
  std::iota(root.begin(), root.end(), 0);
  const auto at = [&](const std::string& name) -> int& {
    return root[static_cast<std::size_t>(index_of(all.chambers, name))];
  };
  for (const AnyOutlet& outlet : all.outlets)
    if (outlet->to) {
      const int a = at(outlet->chamber), b = at(*outlet->to);
      std::replace(root.begin(), root.end(), std::max(a, b), std::min(a, b));
    }
  std::vector<Parts> out;
  for (std::size_t k = 0; k < root.size(); ++k) {
    if (root[k] != static_cast<int>(k))
      continue;
    Parts& own = out.emplace_back(Parts{all.outside, {}, {}, {}});
    const auto mine = [&](const std::string& name) { return at(name) == static_cast<int>(k); };
    for (const Chamber& chamber : all.chambers)
      if (mine(chamber.name))
        own.chambers.push_back(chamber);
    for (const Piston& piston : all.pistons)
      if (mine(piston.chamber))
        own.pistons.push_back(piston);
    for (const AnyOutlet& outlet : all.outlets)
      if (mine(outlet->chamber))
        own.outlets.push_back(outlet);
  }
  return out;
}

} // namespace hydrodae::air
