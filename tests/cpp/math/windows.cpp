#include <cmath>

#include <doctest/doctest.h>

#include "hydrodae/math/windows.h"

using namespace hydrodae;

namespace {

std::vector<double> sampled(double end, int cells, double (*f)(double)) {
  std::vector<double> values;
  for (int i = 0; i <= cells; ++i)
    values.push_back(f(end * i / cells));
  return values;
}

double pulse(double t) { return std::exp(-(t - 45.0) * (t - 45.0)); }
double sine(double t) { return std::sin(t); }
double straight(double t) { return 3.0 * t; }

} // namespace

TEST_CASE("a straight line may be passed in one step") {
  std::size_t hint = 0;
  CHECK(smooth_windows(sampled(64.0, 1024, &straight), 64.0).reach(0.0, hint) ==
        doctest::Approx(64.0));
}

TEST_CASE("steps end before a late pulse and are short within it") {
  const Windows windows = smooth_windows(sampled(64.0, 1024, &pulse), 64.0);
  std::size_t hint = 0;
  CHECK(windows.reach(0.0, hint) > 10.0);
  CHECK(windows.reach(0.0, hint) < 45.0);
  CHECK(windows.reach(45.0, hint) - 45.0 < 1.0);
  double t = 0.0;
  int steps = 0;
  for (hint = 0; t < 45.0 && steps < 1000; ++steps)
    t = windows.reach(t, hint);
  CHECK(steps < 100);
  CHECK(t < 46.0);
}

TEST_CASE("a sine is cut into parts of its period, whatever the place of the step") {
  const Windows windows = smooth_windows(sampled(64.0, 4096, &sine), 64.0);
  std::size_t hint = 0;
  for (double t = 0.0; t < 60.0; t += 0.37) {
    const double step = windows.reach(t, hint) - t;
    CHECK(step > 0.02);
    // Dyadic parts: as long as a third of the period where the step begins at the best place.
    CHECK(step < 0.35 * 6.2832);
  }
}

TEST_CASE("nothing limits steps beyond the end") {
  std::size_t hint = 0;
  CHECK(std::isinf(smooth_windows(sampled(64.0, 1024, &sine), 64.0).reach(64.0, hint)));
}
