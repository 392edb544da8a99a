#include <algorithm>

#include "hydrodae/system/jacobian.h"

namespace hydrodae::system {

Pattern make_pattern(Index n, const Visits& visits, const Visits& rates) {
  std::vector<std::pair<Index, Index>> entries = visits;
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  Pattern pattern;
  pattern.n = n;
  pattern.column_start.assign(n + 1, 0);
  for (const auto& [column, row] : entries) {
    ++pattern.column_start[column + 1];
    pattern.row.push_back(row);
  }
  for (Index c = 0; c < n; ++c)
    pattern.column_start[c + 1] += pattern.column_start[c];
  auto place = [&](const std::pair<Index, Index>& visit) -> Index {
    return std::lower_bound(entries.begin(), entries.end(), visit) - entries.begin();
  };
  for (const auto& visit : visits)
    pattern.slots.push_back(place(visit));
  pattern.has_rate.assign(entries.size(), false);
  for (const auto& visit : rates)
    pattern.has_rate[static_cast<std::size_t>(place(visit))] = true;
  return pattern;
}

} // namespace hydrodae::system
