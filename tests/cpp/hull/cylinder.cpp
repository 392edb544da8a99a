/// Froude-Krylov loads on a vertical cylinder: linear closed form, and a double integral over angle
/// and depth with the instantaneous surface.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>

#include "hull/meshes.h"
#include "hydrodae/hull/loads.h"

namespace hydrodae::test_hull_cylinder {

using hull::Stretching;

namespace {

constexpr double rho = 1025.0, g = 9.81, a = 5.0, draught = 8.0;

hull::Wave deep_wave(double period, double amplitude) {
  const double w = 2 * pi / period;
  return {w, w * w / g, 0.0, amplitude, 0.0};
}

/// Mean and first three harmonics of surge and heave force [N]: sum of c_n e^{i n w t}, real part.
struct Harmonics {
  std::array<std::complex<double>, 4> surge{}, heave{};
};

template <class Load> Harmonics harmonics(double period, const Load& load) {
  constexpr int n = 48;
  Harmonics out;
  for (int i = 0; i < n; ++i) {
    const auto [x, z] = load(period * i / n);
    for (std::size_t j = 0; j < 4; ++j) {
      const std::complex<double> turn =
          std::polar(j == 0 ? 1.0 / n : 2.0 / n, -2 * pi * double(j) * i / n);
      out.surge[j] += x * turn;
      out.heave[j] += z * turn;
    }
  }
  return out;
}

/// Whole pressure of a deep-water wave that travels along x.
double pressure(const hull::Wave& w, Stretching stretching, bool bernoulli, double t, double x,
                double z) {
  const double k = w.wavenumber, angle = w.omega * t - k * x, eta = w.amplitude * std::cos(angle);
  const double s = stretching == Stretching::wheeler        ? z - eta
                   : stretching == Stretching::extrapolated ? z
                                                            : std::min(z, 0.0);
  const double e = std::exp(k * s), speed = w.omega * w.amplitude * e;
  return rho * g * (eta * e - z) - (bernoulli ? 0.5 * rho * speed * speed : 0.0);
}

/// Five-point Gauss rule on parts of [from, to].
template <class F> double gauss(double from, double to, int parts, const F& f) {
  constexpr std::array<double, 5> x{-0.9061798459386640, -0.5384693101056831, 0.0,
                                    0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> w{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                    0.4786286704993665, 0.2369268850561891};
  const double h = (to - from) / parts;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      sum += 0.5 * h * w[j] * f(from + h * (i + 0.5 + 0.5 * x[j]));
  return sum;
}

/// Surge and heave of the exact cylinder.
std::array<double, 2> exact(const hull::Wave& w, Stretching stretching, bool bernoulli, double t) {
  constexpr int around = 48; // the rule of equal steps converges faster than any power
  double surge = 0.0, heave = 0.0;
  for (int i = 0; i < around; ++i) {
    const double c = std::cos(2 * pi * i / around);
    const auto p = [&](double x, double z) { return pressure(w, stretching, bernoulli, t, x, z); };
    const double x = a * c, eta = w.amplitude * std::cos(w.omega * t - w.wavenumber * x);
    const double below = std::min(eta, 0.0);
    const double side = gauss(-draught, below, 4, [&](double z) { return p(x, z); }) +
                        gauss(below, eta, 1, [&](double z) { return p(x, z); });
    surge -= a * c * side * 2 * pi / around;
    heave += gauss(0.0, a, 2, [&](double r) { return r * p(r * c, -draught); }) * 2 * pi / around;
  }
  return {surge, heave};
}

} // namespace

TEST_CASE("small waves: heave rho g A pi a^2 2 J1(ka)/(ka) e^{-kd}, surge 2 pi rho g A a J1(ka) "
          "(1 - e^{-kd}) / k") {
  for (double period : {4.0, 8.0, 12.0}) {
    CAPTURE(period);
    const hull::Wave w = deep_wave(period, 1e-5);
    const double k = w.wavenumber, weight = rho * g * w.amplitude;
    const double J1 = std::cyl_bessel_j(1.0, k * a), end = std::exp(-k * draught);
    const double heave = weight * pi * a * a * 2 * J1 / (k * a) * end;
    const double surge = 2 * pi * weight * a * J1 * (1 - end) / k;
    const hull::WaveField field({rho, g}, {w}, 10.0);
    // Two meshes remove the error of the facets, of second order.
    std::array<double, 2> found_heave{}, found_surge{};
    for (std::size_t i = 0; i < 2; ++i) {
      const int n = 32 << i;
      const hull::Mesh mesh = tests::cylinder(a, -draught, 3.0, n, 11 << i, 4 << i).mesh();
      hull::Workspace work(mesh, field);
      const hull::Pose pose;
      found_heave[i] = hull::loads(mesh, field, pose, {0.0}, work).dynamic[2];
      found_surge[i] = hull::loads(mesh, field, pose, {0.25 * period}, work).dynamic[0];
    }
    CHECK((4 * found_heave[1] - found_heave[0]) / 3 == doctest::Approx(heave).epsilon(1e-4));
    CHECK((4 * found_surge[1] - found_surge[0]) / 3 == doctest::Approx(-surge).epsilon(1e-4));
  }
}

TEST_CASE("a fixed cylinder in 3 m waves: mean and three harmonics, however they are continued") {
  constexpr double period = 8.0;
  const hull::Wave w = deep_wave(period, 1.5);
  const hull::Mesh mesh = tests::cylinder(a, -draught, 3.0, 128, 22, 8).mesh();
  const double buoyancy = rho * g * mesh.volume * draught / (draught + 3.0);
  struct Known { // kN, of the exact cylinder
    Stretching stretching;
    double second_surge, mean_heave;
  };
  for (const auto& [stretching, second_surge, mean_heave] :
       {Known{Stretching::vertical, 50.7, 0.0}, Known{Stretching::wheeler, 11.2, -33.8},
        Known{Stretching::extrapolated, 53.3, 0.0}})
    for (bool bernoulli : {false, true}) {
      CAPTURE(int(stretching));
      CAPTURE(bernoulli);
      const hull::WaveField field({rho, g, INFINITY, stretching, bernoulli}, {w}, 10.0);
      hull::Workspace work(mesh, field);
      const Harmonics found = harmonics(period, [&](double t) {
        const hull::Loads l = hull::loads(mesh, field, {}, {t}, work);
        const Vector6 whole = l.hydrostatic + l.dynamic;
        return std::array{whole[0], whole[2]};
      });
      const Harmonics truth =
          harmonics(period, [&](double t) { return exact(w, stretching, bernoulli, t); });
      // The facets take 0.04 % of the volume; 1 N for harmonics that vanish.
      for (std::size_t j = 0; j < 4; ++j) {
        CAPTURE(j);
        CHECK(std::abs(found.surge[j] - truth.surge[j]) < 1e-3 * std::abs(truth.surge[j]) + 1.0);
        CHECK(std::abs(found.heave[j] - truth.heave[j]) < 1e-3 * std::abs(truth.heave[j]) + 1.0);
      }
      const double mean = found.heave[0].real() - buoyancy;
      if (bernoulli) // of the speed at the bottom, mostly
        CHECK(mean == doctest::Approx(1e3 * mean_heave - 20.4e3).epsilon(0.01));
      else {
        CHECK(std::abs(found.surge[2]) == doctest::Approx(1e3 * second_surge).epsilon(0.005));
        CHECK(std::abs(mean - 1e3 * mean_heave) < 60.0);
      }
    }
}

} // namespace hydrodae::test_hull_cylinder
