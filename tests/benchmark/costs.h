#pragma once
/// Cost of a piece of a program: seconds, or instructions where valgrind's callgrind runs it.

#include <algorithm>
#include <chrono>
#include <cmath>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define RUNNING_ON_VALGRIND 0
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name)
#endif

namespace costs {

inline double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// The least seconds of one call of `piece`, of seven batches of 2 ms or more. Under callgrind one
/// call is counted, and a file of its counts is written that `name` names; the answer is NaN.
template <class Piece> double of(const char* name, Piece&& piece, double batch = 2e-3) {
  piece(); // what is made at the first call only
  if (RUNNING_ON_VALGRIND) {
    CALLGRIND_ZERO_STATS;
    piece();
    CALLGRIND_DUMP_STATS_AT(name);
    return NAN;
  }
  double least = INFINITY;
  long calls = 1;
  for (int k = 0; k < 7; ++k) {
    const double start = seconds();
    for (long i = 0; i < calls; ++i)
      piece();
    const double took = seconds() - start;
    least = std::min(least, took / static_cast<double>(calls));
    calls = std::max(calls, static_cast<long>(std::ceil(batch / least)));
  }
  return least;
}

} // namespace costs
