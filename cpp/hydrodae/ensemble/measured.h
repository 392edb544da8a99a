#pragma once
/// Measures of a run without samples: what is asked for, and what a march answers.

#include <string>
#include <vector>

#include "hydrodae/math/sampling.h"

namespace hydrodae::ensemble {

/// factor x^power of one number of a channel; without a channel the factor alone.
struct Term {
  std::string channel;
  std::string component; ///< x, y, z; empty for a channel of one number
  double factor = 1.0;
  int power = 1;
};

/// A sum of terms over the time from `start` to the end of the run.
struct Wanted {
  std::vector<Term> terms;
  double start = -1.0;     ///< [s]; negative: the end of the ramp
  bool turns = false;      ///< are turning points asked for?
  double frequency = -1.0; ///< of the Fourier integral [Hz]; negative: not asked for
};

/// Measured values of one signal x in one run.
struct Measured {
  std::string unit;      ///< of the first channel
  double start = 0.0;    ///< [s]
  double duration = 0.0; ///< [s]
  double mean = 0.0, mean_square = 0.0, last = 0.0;
  double least = 0.0, most = 0.0; ///< at stages and ends of steps: do they differ in sign?
  /// Means of x and x^2 over equal spans, (sampling_spans,) each.
  std::vector<double> span_means, span_squares;
  /// Turning points and both ends: times [s] and values, in the order of time.
  std::vector<double> times, turns;
  double cosine = 0.0, sine = 0.0; ///< means of x cos(2 pi f t) and x sin(2 pi f t)
};

} // namespace hydrodae::ensemble
