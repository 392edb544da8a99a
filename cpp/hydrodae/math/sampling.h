#pragma once
/// Interval of the mean of one record about the mean of the random process that it samples.

#include <cstddef>
#include <optional>
#include <span>

namespace hydrodae {

struct Interval {
  double low = 0.0, high = 0.0;
};

/// Spans that a record is cut into. More of them give more degrees of freedom; longer ones have
/// less to do with each other, and that decides: Student's t knows of the former only.
inline constexpr int sampling_spans = 4;

/// Values of a record, four a span, below which it has no interval.
inline constexpr std::size_t sampling_fewest = 4 * sampling_spans;

/// Energy periods of the sea that a record has to last: five waves a span. In half of that 90 %
/// (JONSWAP, gamma 3.3) or 86 % (gamma 10) of the intervals hold the mean of v^2, instead of 94 %
/// and 91 % (docs/results.md).
inline constexpr double sampling_periods = 20.0;

/// The 95 % interval of the mean of a stationary process by batch means (Law and Carson, Operations
/// Research 27, 1979):
///
///   m +- h,   h = t_{0.975, n-1} s / sqrt(n)
///
/// with m the mean of all, s the standard deviation of the means of n = sampling_spans spans.
/// The mean of what never changes its sign, such as a power or a square, is skewed: its logarithm
/// has the same interval, and so m exp(+- h / m).
/// @param values at equal steps
/// @return none for fewer than `sampling_fewest`
std::optional<Interval> mean_interval(std::span<const double> values);

} // namespace hydrodae
