#pragma once
/// Elimination of the velocities of points that move by themselves (nodes of lines). Their rows q'
/// - u = 0 become alpha dq - du = r in a Newton matrix dF/dy + alpha dF/dy', so that du = alpha dq
/// - r:
///
///   [ alpha  -1 ] [dq]   [r]
///   [ K       D ] [du] = [b]      (K + alpha D) dq = b + D r

#include <array>
#include <utility>
#include <vector>

#include "hydrodae/system/jacobian.h"

namespace hydrodae::linalg {

/// Maps entries of a pattern to the reduced pattern; without points both are equal.
class PointElimination {
public:
  PointElimination(const system::Regime& s, const system::Pattern& p);

  Index n = 0;                   ///< number of reduced unknowns
  std::vector<Index> start, row; ///< reduced pattern
  std::vector<bool> has_rate;    ///< true for reduced entries with rates or velocities
  std::vector<Index> target;     ///< place of each entry in the reduced pattern; -1: eliminated
  std::vector<Index> unknown;    ///< (n,) index in y of each reduced unknown
  /// (n,) index in y of its row; for places of points, the row of the velocity
  std::vector<Index> equation;
  struct Pair {
    Index place, velocity;
  };
  std::vector<Pair> pairs;
  /// Entry D in the column of a velocity.
  struct Lifted {
    Index entry, row, pair; ///< index in the pattern; in y; in `pairs`
  };
  std::vector<Lifted> lifted;
  bool empty() const { return pairs.empty(); }
};

inline PointElimination::PointElimination(const system::Regime& s, const system::Pattern& p) {
  std::vector<Index> pair(static_cast<std::size_t>(p.n), -1); // pair of each velocity
  for (const system::StateBlock& states : s.states)
    if (!states.unknowns.empty() && states.unknowns.front().length > 0.0)
      system::for_each_point(states, [&](Index place, Index velocity, double) {
        for (Index c = 0; c < 3; ++c) {
          pair[static_cast<std::size_t>(velocity + c)] = std::ssize(pairs);
          pairs.push_back({place + c, velocity + c});
        }
      });
  if (pairs.empty()) {
    n = p.n;
    start = p.column_start;
    row = p.row;
    return;
  }
  std::vector<Index> number(static_cast<std::size_t>(p.n), -1); // number in the reduced system
  for (Index i = 0; i < p.n; ++i)
    if (pair[static_cast<std::size_t>(i)] < 0) {
      number[static_cast<std::size_t>(i)] = n++;
      unknown.push_back(i);
    }
  equation = unknown;
  std::vector<bool> is_place(static_cast<std::size_t>(p.n), false);
  for (const Pair& of : pairs) {
    const Index own = number[static_cast<std::size_t>(of.place)];
    is_place[static_cast<std::size_t>(of.place)] = true;
    number[static_cast<std::size_t>(of.velocity)] = own;
    equation[static_cast<std::size_t>(own)] = of.velocity;
  }
  system::Visits visits, rates;
  for (Index column = 0; column < p.n; ++column)
    for (Index k = p.column_start[column]; k < p.column_start[column + 1]; ++k) {
      const Index r = p.row[k], of = pair[static_cast<std::size_t>(column)];
      if (is_place[static_cast<std::size_t>(r)])
        continue;
      visits.emplace_back(number[static_cast<std::size_t>(column)],
                          number[static_cast<std::size_t>(r)]);
      if (of >= 0)
        lifted.push_back({k, r, of});
      if (of >= 0 || p.has_rate[static_cast<std::size_t>(k)])
        rates.push_back(visits.back());
    }
  system::Pattern stays = system::make_pattern(n, visits, rates);
  start = std::move(stays.column_start);
  row = std::move(stays.row);
  has_rate = std::move(stays.has_rate);
  auto slot = stays.slots.begin();
  for (const Index r : p.row)
    target.push_back(is_place[static_cast<std::size_t>(r)] ? -1 : *slot++);
}

} // namespace hydrodae::linalg
