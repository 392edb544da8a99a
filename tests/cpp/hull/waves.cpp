/// Sums of waves at many points against closed forms and against their own gradients.

#include <doctest/doctest.h>

#include <random>

#include "hydrodae/hull/wave_field.h"

namespace hydrodae::test_hull_waves {

using hull::Stretching;

namespace {

constexpr double rho = 1025.0, g = 9.81;

/// Wavenumbers that satisfy the dispersion relation of the depth.
hull::Wave wave(double k, double depth, double heading, double amplitude, double phase) {
  const double w = std::sqrt(g * k * (std::isfinite(depth) ? std::tanh(k * depth) : 1.0));
  return {w, k, heading, amplitude, phase};
}

std::vector<hull::Wave> sea(double depth) {
  return {wave(0.11, depth, 0.4, 1.1, 0.3), wave(0.25, depth, -2.0, 0.6, 2.0),
          wave(0.9, depth, 1.3, 0.2, -1.0)};
}

struct Value {
  double p, eta;
  Vector3 gradient;
};

Value at(const hull::WaveField& field, double t, const Vector3& point) {
  hull::WaveView view = field.make_view();
  field.look({t}, {30.0, -20.0, -1.5}, view);
  const double x = point[0] - 30.0, y = point[1] + 20.0;
  Value out{};
  double unused = 0.0;
  field.pressure(view, {1, &x, &y, &point[2]},
                 {&out.p, &out.gradient[0], &out.gradient[1], &out.gradient[2]});
  field.elevation(view, {1, &x, &y, nullptr}, {&out.eta, &unused, &unused, nullptr});
  return out;
}

} // namespace

TEST_CASE("a regular wave: pressure at crest, side and node, by hand") {
  for (double depth : {10.0, 60.0, double(INFINITY)}) {
    CAPTURE(depth);
    const double k = 0.1, A = 1.2, z = -3.0, x = 7.0;
    const hull::Wave w = wave(k, depth, 0.0, A, 0.5);
    const double t = (k * x - 0.5) / w.omega; // the crest is at x
    const double f =
        std::isfinite(depth) ? std::cosh(k * (z + depth)) / std::cosh(k * depth) : std::exp(k * z);
    const double fp = std::isfinite(depth) ? k * std::sinh(k * (z + depth)) / std::cosh(k * depth)
                                           : k * std::exp(k * z);
    for (bool bernoulli : {false, true}) {
      const hull::WaveField field({rho, g, depth, Stretching::vertical, bernoulli}, {w}, 40.0);
      const Value crest = at(field, t, {x, 5.0, z});
      const double u = bernoulli ? g * k / w.omega * A * f : 0.0;
      CHECK(crest.eta == doctest::Approx(A).epsilon(1e-14));
      CHECK(crest.p == doctest::Approx(rho * (g * A * f - 0.5 * u * u)).epsilon(1e-13));
      const Value node = at(field, t + 0.5 * pi / w.omega, {x, 5.0, z});
      const double v = bernoulli ? g / w.omega * A * fp : 0.0;
      CHECK(node.p == doctest::Approx(-0.5 * rho * v * v).epsilon(1e-10).scale(1.0));
      // Horizontal velocity of the kinematics elsewhere in hydrodae: A w cosh / sinh.
      if (bernoulli && std::isfinite(depth))
        CHECK(u ==
              doctest::Approx(A * w.omega * std::cosh(k * (z + depth)) / std::sinh(k * depth)));
    }
  }
}

TEST_CASE("what each continuation gives at the crest") {
  const double k = 0.1, A = 1.2, depth = 15.0;
  const hull::Wave w = wave(k, depth, 0.0, A, 0.0);
  const auto p = [&](Stretching stretching, double z) {
    return at(hull::WaveField({rho, g, depth, stretching}, {w}, 40.0), 0.0, {0.0, 0.0, z}).p;
  };
  const auto f = [&](double s) { return std::cosh(k * (s + depth)) / std::cosh(k * depth); };
  CHECK(p(Stretching::vertical, 0.7) == doctest::Approx(rho * g * A));
  CHECK(p(Stretching::extrapolated, 0.7) == doctest::Approx(rho * g * A * f(0.7)));
  CHECK(p(Stretching::wheeler, A) == doctest::Approx(rho * g * A));
  CHECK(p(Stretching::wheeler, -depth) == doctest::Approx(rho * g * A * f(-depth)));
  CHECK(p(Stretching::wheeler, 0.0) == doctest::Approx(rho * g * A * f(-A * depth / (depth + A))));
}

TEST_CASE("a list of points is the points one by one, and gradients are those of the values") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (double depth : {12.0, double(INFINITY)})
    for (Stretching stretching :
         {Stretching::vertical, Stretching::wheeler, Stretching::extrapolated})
      for (bool bernoulli : {false, true}) {
        const hull::WaveField field({rho, g, depth, stretching, bernoulli}, sea(depth), 30.0);
        constexpr int n = 150;
        Eigen::ArrayXd x(n), y(n), z(n), p(n), alone(n);
        Eigen::ArrayX3d slope(n, 3);
        for (int i = 0; i < n; ++i) {
          x[i] = 20 * draw(random);
          y[i] = 20 * draw(random);
          z[i] = 3 * draw(random) - 2;
        }
        hull::WaveView view = field.make_view();
        field.look({11.0, 0.8}, {30.0, -20.0, -1.5}, view);
        const hull::PointLists points{n, x.data(), y.data(), z.data()};
        field.pressure(view, points, {alone.data()});
        field.pressure(view, points,
                       {p.data(), slope.col(0).data(), slope.col(1).data(), slope.col(2).data()});
        CHECK((p - alone).abs().maxCoeff() < 1e-9);
        const auto value = [&](Vector3 q) {
          double out = 0.0;
          field.pressure(view, {1, &q[0], &q[1], &q[2]}, {&out});
          return out;
        };
        for (int i = 0; i < n; ++i) {
          const Vector3 q(x[i], y[i], z[i]);
          CHECK(value(q) == doctest::Approx(p[i]).epsilon(1e-12).scale(1.0));
          for (int j = 0; j < 3; ++j) {
            constexpr double h = 1e-4;
            if (std::abs(z[i]) < h)
              continue;
            const Vector3 d = h * Vector3::Unit(j);
            const double difference = (value(q + d) - value(q - d)) / (2 * h);
            CHECK(slope(i, j) == doctest::Approx(difference).epsilon(1e-6).scale(10.0));
          }
        }
      }
}

TEST_CASE("few terms stand for many waves, of two directions and of many: elevation, pressure and "
          "gradient to 1e-12") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  constexpr double radius = 6.0;
  constexpr int n = 64;
  for (const auto& [depth, spread] :
       {std::pair{14.0, false}, std::pair{50.0, false}, std::pair{double(INFINITY), false},
        std::pair{14.0, true}, std::pair{double(INFINITY), true}}) {
    std::vector<hull::Wave> waves;
    double size = 0.0;
    for (int j = 0; j < 300; ++j) {
      const double w = 0.25 + 2.5 * draw(random), k = w * w / g; // any k is a solution of Laplace's
      const double heading = spread ? 6.0 * draw(random) : j < 200 ? 0.3 : -1.2;
      waves.push_back({w, k, heading, 0.1 * draw(random) * std::exp(-w), 6 * draw(random)});
      size += rho * g * waves.back().amplitude;
    }
    for (Stretching stretching :
         {Stretching::vertical, Stretching::wheeler, Stretching::extrapolated})
      for (double height : {0.5, -7.0}) {
        CAPTURE(depth);
        CAPTURE(spread);
        CAPTURE(int(stretching));
        CAPTURE(height);
        const hull::Water water{rho, g, depth, stretching, true};
        const hull::WaveField many(water, waves, 1e6), few(water, waves, radius);
        CHECK(many.terms() == 300);
        CHECK(few.terms() < (spread ? 800 : 100));
        Eigen::ArrayX3d x(n, 3);
        for (int i = 0; i < n; ++i) {
          const Vector3 from(draw(random) - 0.5, draw(random) - 0.5, draw(random) - 0.5);
          x.row(i) = (radius * from.normalized() + Vector3(0.0, 0.0, height)).transpose();
        }
        const hull::PointLists points{n, x.col(0).data(), x.col(1).data(), x.col(2).data()};
        std::array<Eigen::ArrayXXd, 2> found;
        for (std::size_t i = 0; i < 2; ++i) {
          const hull::WaveField& field = i == 0 ? many : few;
          hull::WaveView view = field.make_view();
          field.look({77.0}, {20.0, 10.0, height}, view);
          found[i].resize(n, 7);
          const auto column = [&](int j) { return found[i].col(j).data(); };
          field.pressure(view, points, {column(0), column(1), column(2), column(3)});
          field.elevation(view, points, {column(4), column(5), column(6), nullptr});
        }
        const Eigen::ArrayXXd error = (found[1] - found[0]).abs();
        CHECK(error.leftCols(4).maxCoeff() < 2e-13 * size);
        CHECK(error.rightCols(3).maxCoeff() < 2e-13 * size / (rho * g));
      }
  }
}

TEST_CASE("the bound of the elevation holds") {
  const hull::WaveField field({rho, g, INFINITY}, sea(INFINITY), 100.0);
  hull::WaveView view = field.make_view();
  for (double t : {0.0, 3.0, 8.0})
    for (double radius : {0.5, 5.0, 100.0}) {
      field.look({t}, {3.0, 4.0, 0.0}, view);
      const double highest = field.highest(view, radius);
      CHECK(highest <= 1.9 + 1e-12);
      for (int i = 0; i < 100; ++i) {
        const double x = radius * std::cos(i), y = radius * std::sin(i);
        double eta = 0.0, unused = 0.0;
        field.elevation(view, {1, &x, &y, nullptr}, {&eta, &unused, &unused, nullptr});
        CHECK(std::abs(eta) <= highest);
      }
    }
}

} // namespace hydrodae::test_hull_waves
