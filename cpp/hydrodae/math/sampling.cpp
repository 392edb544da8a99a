#include "hydrodae/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hydrodae {

namespace {

/// 97.5 % quantile of Student's t with sampling_spans - 1 degrees of freedom.
constexpr double student_t = 3.182446305284263;
static_assert(sampling_spans == 4);

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

std::optional<Interval> mean_interval(std::span<const double> values) {
  constexpr std::size_t n = sampling_spans;
  if (values.size() < sampling_fewest)
    return std::nullopt;
  const double mean = mean_of(values);
  double squares = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t begin = values.size() * k / n, end = values.size() * (k + 1) / n;
    squares += std::pow(mean_of(values.subspan(begin, end - begin)) - mean, 2);
  }
  const double half = student_t * std::sqrt(squares / static_cast<double>((n - 1) * n));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if ((*least < 0.0 && *most > 0.0) || mean == 0.0)
    return Interval{mean - half, mean + half};
  const double one = mean * std::exp(-half / mean), other = mean * std::exp(half / mean);
  return Interval{std::min(one, other), std::max(one, other)};
}

} // namespace hydrodae
