#include <numeric>

#include "hydrodae/system/jacobian.h"

namespace hydrodae::system {

namespace {

/// Sorts numbers by their keys below n; those of the same key keep their order.
template <class Key> void sort_by(Index n, std::vector<std::size_t>& numbers, Key&& key) {
  std::vector<std::size_t> next(static_cast<std::size_t>(n) + 1), sorted(numbers.size());
  for (const std::size_t k : numbers)
    ++next[static_cast<std::size_t>(key(k)) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const std::size_t k : numbers)
    sorted[next[static_cast<std::size_t>(key(k))]++] = k;
  numbers.swap(sorted);
}

} // namespace

Pattern make_pattern(Index n, const Visits& visits, const Visits& rates) {
  const std::size_t count = visits.size();
  const auto visit = [&](std::size_t k) { return k < count ? visits[k] : rates[k - count]; };
  std::vector<std::size_t> order(count + rates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  sort_by(n, order, [&](std::size_t k) { return visit(k).second; });
  sort_by(n, order, [&](std::size_t k) { return visit(k).first; });
  Pattern pattern;
  pattern.n = n;
  pattern.column_start.assign(n + 1, 0);
  pattern.slots.resize(count);
  std::pair<Index, Index> last{-1, -1};
  for (const std::size_t k : order) {
    if (const auto here = visit(k); here != last) {
      last = here;
      ++pattern.column_start[here.first + 1];
      pattern.row.push_back(here.second);
      pattern.has_rate.push_back(false);
    }
    if (k < count)
      pattern.slots[k] = std::ssize(pattern.row) - 1;
    else
      pattern.has_rate.back() = true;
  }
  for (Index c = 0; c < n; ++c)
    pattern.column_start[c + 1] += pattern.column_start[c];
  return pattern;
}

} // namespace hydrodae::system
