/// Wave components, spectra and their sums in time against closed forms.

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "hydrodae/sea/dispersion.h"
#include "hydrodae/sea/random.h"
#include "hydrodae/sea/signals.h"
#include "hydrodae/sea/wave.h"

namespace {

using namespace hydrodae;

template <class W = sea::Jonswap> W irregular() {
  W wave;
  wave.name = "wind";
  wave.height = 2.0;
  if constexpr (requires { wave.period; })
    wave.period = 8.0;
  return wave;
}

std::vector<sea::Component> drawn(const sea::Jonswap& wave) {
  return wave.components({INFINITY, 9.81, {}}).components;
}

template <class W> void check_spectrum() {
  CAPTURE(W::type);
  const W wave = irregular<W>();
  const sea::Spectrum s = wave.spectrum(9.81);
  CHECK(s.m0 == doctest::Approx(0.25));
  CHECK(s.cumulative.back() == doctest::Approx(s.m0).epsilon(1e-4));
  const double wp = 2.0 * pi / wave.peak_period(9.81);
  CHECK(s(wp) > s(1.02 * wp));
  CHECK(s(wp) > s(0.98 * wp));
  for (double part : {0.01, 0.3, 0.9})
    CHECK(s.energy_below(s.frequency_at(part * s.m0)) ==
          doctest::Approx(part * s.m0).epsilon(1e-9));
}

double energy(const std::vector<sea::Component>& components) {
  double sum = 0.0;
  for (const sea::Component& c : components)
    sum += 0.5 * c.amplitude * c.amplitude;
  return sum;
}

/// Autocorrelation of the elevation at lag tau, averaged over all time, relative to lag 0.
double correlation(const std::vector<sea::Component>& components, double tau) {
  double sum = 0.0;
  for (const sea::Component& c : components)
    sum += 0.5 * c.amplitude * c.amplitude * std::cos(c.omega * tau);
  return sum / energy(components);
}

} // namespace

TEST_CASE("random numbers are those of xoshiro256** with splitmix64 on every machine") {
  sea::Random random(1);
  // First outputs for seed 1, computed from the published algorithms in integer arithmetic.
  CHECK(random.next() == 0xb3f2af6d0fc710c5u);
  CHECK(random.next() == 0x853b559647364ceau);
  CHECK(random.uniform() == doctest::Approx(0.5741057000197225).epsilon(1e-15));
  double mean = 0.0;
  for (int i = 0; i < 100000; ++i)
    mean += random.uniform() / 100000.0;
  CHECK(mean == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("dispersion: deep, shallow and in between") {
  CHECK(sea::wavenumber(2.0, INFINITY, 9.81) == doctest::Approx(4.0 / 9.81));
  CHECK(sea::wavenumber(1e-3, 10.0, 9.81) == doctest::Approx(1e-3 / std::sqrt(98.1)).epsilon(1e-6));
  for (double w : {0.1, 0.5, 1.0, 3.0}) {
    const double k = sea::wavenumber(w, 20.0, 9.81);
    CHECK(9.81 * k * std::tanh(20.0 * k) == doctest::Approx(w * w).epsilon(1e-13));
  }
}

TEST_CASE("spectra: energy, peak and known values") {
  check_spectrum<sea::Jonswap>();
  check_spectrum<sea::Bretschneider>();
  check_spectrum<sea::OchiHubble>();
  check_spectrum<sea::PiersonMoskowitz>();
  // Bretschneider in closed form: S = 5/16 Hs^2 wp^4 w^-5 exp(-5/4 (wp/w)^4).
  const double wp = 2.0 * pi / 8.0, w = 1.1;
  const double exact =
      0.3125 * 4.0 * std::pow(wp, 4) * std::pow(w, -5) * std::exp(-1.25 * std::pow(wp / w, 4));
  CHECK(irregular<sea::Bretschneider>().spectrum(9.81)(w) == doctest::Approx(exact).epsilon(1e-5));
  // Ochi-Hubble of shape 1 is the same; Pierson-Moskowitz: Tp = 5.0 sqrt(Hs) within 1 %.
  CHECK(irregular<sea::OchiHubble>().spectrum(9.81)(w) == doctest::Approx(exact).epsilon(1e-5));
  CHECK(irregular<sea::PiersonMoskowitz>().peak_period(9.81) ==
        doctest::Approx(5.0 * std::sqrt(2.0)).epsilon(0.01));
  // JONSWAP with gamma 3.3 is 3.3 times as high at the peak as its own Pierson-Moskowitz part.
  sea::Jonswap jonswap = irregular();
  const double sharp = jonswap.spectrum(9.81)(wp) / jonswap.spectrum(9.81)(4.0 * wp);
  jonswap.gamma = 1.0;
  const double blunt = jonswap.spectrum(9.81)(wp) / jonswap.spectrum(9.81)(4.0 * wp);
  CHECK(sharp / blunt == doctest::Approx(3.3).epsilon(1e-3));
}

TEST_CASE("components hold the energy of the spectrum and do not repeat") {
  for (const char* spacing : {"energy", "frequency"}) {
    CAPTURE(spacing);
    sea::Jonswap wave = irregular();
    wave.spacing = spacing;
    const sea::Sum sum = wave.components({INFINITY, 9.81, {}});
    const std::vector<sea::Component>& components = sum.components;
    CHECK(components.size() == 200);
    CHECK(energy(components) == doctest::Approx(0.994 * 0.25).epsilon(1e-6));
    CHECK(sum.note.find("99.4 % of the energy") != std::string::npos);
    // Equal steps in frequency would repeat, with correlation 1, after 2 pi / step.
    const double range = components.back().omega - components.front().omega;
    CHECK(std::abs(correlation(components, 2.0 * pi / (range / 199.0))) < 0.3);
    const auto again = drawn(wave);
    CHECK(again[17].omega == components[17].omega);
    wave.seed = 2;
    CHECK(drawn(wave)[17].phase != components[17].phase);
  }
}

TEST_CASE("spreading: mean direction and its width") {
  sea::Jonswap wave = irregular();
  wave.heading = 0.3;
  wave.spreading = 10.0;
  wave.count = 2000;
  const auto components = drawn(wave);
  double mean = 0.0, first = 0.0;
  for (const sea::Component& c : components) {
    mean += c.heading / 2000.0;
    first += std::cos(c.heading - 0.3) / 2000.0;
  }
  CHECK(mean == doctest::Approx(0.3).epsilon(0.01));
  CHECK(first == doctest::Approx(10.0 / 11.0).epsilon(2e-3)); // s/(s+1) without the cut at 90 deg
}

TEST_CASE("the table of a sum: stated error, two continuous derivatives, exact outside") {
  const auto components = drawn(irregular());
  const auto n = static_cast<Eigen::Index>(components.size());
  VectorX omega(n);
  Eigen::MatrixXcd c(2, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& wave = components[static_cast<std::size_t>(i)];
    omega[i] = wave.omega;
    c(0, i) = std::polar(wave.amplitude, wave.phase);
    c(1, i) = c(0, i) * std::complex<double>(0.0, 1e6 * wave.omega * wave.omega);
  }
  const sea::Signals signals(omega, c, 300.0, 0.0);
  REQUIRE(signals.step() > 0.0);
  const auto exact = [&](double t, int row) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      sum += (c(row, i) * std::polar(1.0, omega[i] * t)).real();
    return sum;
  };
  VectorX value(2);
  for (int row = 0; row < 2; ++row) {
    const double significant = 2.0 * std::sqrt(0.5 * c.row(row).cwiseAbs2().sum());
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double t = 0.1 * k + 0.0371;
      signals(t, value);
      worst = std::max(worst, std::abs(value[row] - exact(t, row)));
    }
    CHECK(worst <= 1e-8 * significant);
    CHECK(worst >= 1e-14 * significant); // it is the table that was tested
    signals(400.0, value);
    CHECK(value[row] == doctest::Approx(exact(400.0, row)).epsilon(1e-12));
  }
  // The second derivative across a knot: one-sided differences of value agree.
  const double knot = 50.0 * signals.step(), h = 1e-3 * signals.step();
  const auto at = [&](double t) {
    signals(t, value);
    return value[0];
  };
  const double right = (at(knot) - 2.0 * at(knot + h) + at(knot + 2.0 * h)) / (h * h);
  const double left = (at(knot) - 2.0 * at(knot - h) + at(knot - 2.0 * h)) / (h * h);
  CHECK(right == doctest::Approx(left).epsilon(0.05));
}

TEST_CASE("a value of the table depends on its time alone, whatever was asked before") {
  const auto components = drawn(irregular());
  const auto n = static_cast<Eigen::Index>(components.size());
  VectorX omega(n);
  Eigen::MatrixXcd c(1, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& wave = components[static_cast<std::size_t>(i)];
    omega[i] = wave.omega;
    c(0, i) = std::polar(wave.amplitude, wave.phase);
  }
  const sea::Signals forward(omega, c, 2e4, 0.0), mixed(omega, c, 2e4, 0.0);
  VectorX one(1), other(1);
  std::vector<double> values;
  for (int k = 0; k < 2000; ++k) {
    forward(10.0 * k + 0.037, one);
    values.push_back(one[0]);
  }
  for (int k = 0; k < 2000; ++k) { // 1009 is prime: all times, far from one another
    const int j = 1009 * k % 2000;
    mixed(10.0 * j + 0.037, other);
    CHECK(other[0] == values[static_cast<std::size_t>(j)]);
  }
}

TEST_CASE("ramp: smooth at both ends") {
  CHECK(sea::ramp(-1.0, 10.0) == 0.0);
  CHECK(sea::ramp(5.0, 10.0) == doctest::Approx(0.5));
  CHECK(sea::ramp(10.0, 10.0) == 1.0);
  CHECK(sea::ramp(0.0, 0.0) == 1.0);
  CHECK(sea::ramp(0.1, 10.0) < 40e-8);
  CHECK(1.0 - sea::ramp(9.9, 10.0) < 40e-8);
}
