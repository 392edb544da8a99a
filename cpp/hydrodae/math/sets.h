#pragma once
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Disjoint sets of the numbers below n, joined one by one.
class Sets {
public:
  explicit Sets(Index n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// Least number in the set of i.
  Index root(Index i) {
    while (at(i) != i)
      i = at(i) = at(at(i));
    return i;
  }
  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    at(std::max(a, b)) = std::min(a, b);
  }

  /// All sets, by their least numbers; members ascend.
  struct Lists {
    std::vector<std::vector<Index>> members;
    std::vector<std::size_t> set; ///< set of each number
    std::vector<Index> place;     ///< place of each number in its set
  };
  Lists lists() {
    Lists out{{}, std::vector<std::size_t>(parent_.size()), std::vector<Index>(parent_.size())};
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      const auto first = static_cast<std::size_t>(root(static_cast<Index>(i)));
      if (first == i)
        out.members.emplace_back();
      out.set[i] = first == i ? out.members.size() - 1 : out.set[first];
      std::vector<Index>& members = out.members[out.set[i]];
      out.place[i] = std::ssize(members);
      members.push_back(static_cast<Index>(i));
    }
    return out;
  }

private:
  Index& at(Index i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<Index> parent_;
};

} // namespace hydrodae
