/// hydrodae-floor: what 100 s of the F3OF flap decay cost in a program that can do nothing else.
///
///   .venv/bin/python tests/benchmark/kernel_costs.py      builds it and writes its numbers
///   hydrodae-floor NUMBERS rk|gauss STEPS [SAMPLES]
///
/// The angles a of both hinges are the coordinates. Added mass and memory turn with the flaps, so
/// that they are constant in a; what they do beside that does no work on a hinge.
///
///   M a'' = Q(a) - Re(C z),   z' = p z + B a'
///   Q = d.(W - K xi),   xi = [x - x0, z - z0, a] of the centre of gravity,   d = dxi / da
///
/// rk: order 8 in fixed steps. gauss: collocation, with z exact for its polynomial of a'. SAMPLES
/// gets a and a' (binary) at the sampling times of the case.

#include <complex>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "costs.h"
#include "hydrodae/integrate/dormand_prince_8.h"

namespace {

using Eigen::Matrix;
using Eigen::Vector;
using Complex = std::complex<double>;
using Vector2 = Vector<double, 2>;
constexpr int pairs = 23, poles = 40; ///< complex ones, which come first; all
constexpr int states = poles + pairs; ///< real parts, then imaginary parts of the first
constexpr int stages = 6;             ///< of gauss
using States = Vector<double, states>;

struct Flap {
  double x0, z0, angle;   ///< centre of gravity from the hinge [m]; start [rad]
  Vector<double, 3> W;    ///< [N, N, N m]
  Matrix<double, 3, 3> K; ///< [N/m, N, N m]
  double load(double a) const {
    const double c = std::cos(a), s = std::sin(a), x = x0 * c + z0 * s, z = z0 * c - x0 * s;
    return Vector<double, 3>(z, -x, 1.0).dot(W - K * Vector<double, 3>(x - x0, z - z0, a));
  }
};

struct Device {
  double end = 0.0, step = 0.0; ///< of the run, of the samples [s]
  Matrix<double, 2, 2> mass, inverse;
  Flap flap[2];
  Vector<Complex, poles> p;
  Matrix<Complex, poles, 2> B, C;
  Matrix<double, states, 2> in;  ///< B by states
  Matrix<double, 2, states> out; ///< Re(C z) by states
  Vector2 start() const { return {flap[0].angle, flap[1].angle}; }
  Vector2 load(const Vector2& a) const { return {flap[0].load(a[0]), flap[1].load(a[1])}; }
};

template <class Column> States real(const Column& c) {
  States out;
  out << c.real(), c.imag().template head<pairs>();
  return out;
}

/// z <- f z, one factor a pole.
States times(const Vector<double, poles>& re, const Vector<double, pairs>& im, const States& z) {
  States out;
  out << re.cwiseProduct(z.head<poles>()), re.head<pairs>().cwiseProduct(z.tail<pairs>());
  out.head<pairs>() -= im.cwiseProduct(z.tail<pairs>());
  out.tail<pairs>() += im.cwiseProduct(z.head<pairs>());
  return out;
}

Device read(const char* path) {
  std::ifstream file(path);
  const auto number = [&] {
    double x = 0.0;
    file >> x;
    return x;
  };
  Device d;
  d.end = number(), d.step = number();
  for (double& m : d.mass.reshaped())
    m = number();
  d.inverse = d.mass.inverse();
  for (Flap& f : d.flap) {
    f.x0 = number(), f.z0 = number(), f.angle = number();
    for (double& w : f.W.reshaped())
      w = number();
    for (double& k : f.K.reshaped())
      k = number();
  }
  for (int k = 0; k < poles; ++k)
    for (Complex* c : {&d.p[k], &d.B(k, 0), &d.B(k, 1), &d.C(k, 0), &d.C(k, 1)}) {
      const double re = number();
      *c = {re, number()};
    }
  double left = 0.0;
  if (!file || file >> left || (d.p.tail<poles - pairs>().imag().array() != 0.0).any()) {
    std::cerr << path << ": expected 23 complex poles, then 17 real ones\n";
    std::exit(1);
  }
  for (int i = 0; i < 2; ++i) {
    d.in.col(i) = real(d.B.col(i));
    d.out.row(i) = real(d.C.col(i).conjugate());
  }
  return d;
}

/// Angles and their rates at the sampling times.
using Samples = std::vector<Vector<double, 4>>;

/// Fills the samples up to the time t + h; `inside` gives them at a part of the step.
template <class Inside>
void sample(const Device& d, double t, double h, Samples& out, Inside&& inside) {
  for (double at; (at = d.step * static_cast<double>(out.size())) <= t + h * (1.0 + 1e-9);)
    out.push_back(inside((at - t) / h));
}

void rk(const Device& d, int steps, Samples& samples) {
  using namespace hydrodae::integrate::tableaux;
  using State = Vector<double, 4 + states>; // angles, rates, memory
  const Vector<double, poles> re = d.p.real();
  const Vector<double, pairs> im = d.p.head<pairs>().imag();
  const auto rates = [&](const State& y) {
    State out;
    const Vector2 v = y.segment<2>(2);
    const States z = y.tail<states>();
    out << v, d.inverse * (d.load(y.head<2>()) - d.out * z), times(re, im, z) + d.in * v;
    return out;
  };
  State y = State::Zero();
  y.head<2>() = d.start();
  const double h = d.end / steps;
  State k[12];
  k[0] = rates(y);
  for (int n = 0; n < steps; ++n) {
    for (int i = 1; i < 12; ++i) {
      State sum = State::Zero();
      for (int j = 0; j < i; ++j)
        if (const double a = rk8_a[12 * i + j]; a != 0.0)
          sum += a * k[j];
      k[i] = rates(y + h * sum);
    }
    const State before = y, first = k[0];
    for (int j = 0; j < 12; ++j)
      if (rk8_b[j] != 0.0)
        y += h * rk8_b[j] * k[j];
    k[0] = rates(y);
    // Hermite's polynomial of degree 5: angles, rates and accelerations at both ends.
    const Vector2 v0 = h * before.segment<2>(2), v1 = h * y.segment<2>(2),
                  a0 = 0.5 * h * h * first.segment<2>(2), a1 = 0.5 * h * h * k[0].segment<2>(2);
    const Vector2 r = y.head<2>() - before.head<2>() - v0 - a0, s = v1 - v0 - 2.0 * a0, u = a1 - a0,
                  c3 = 10.0 * r - 4.0 * s + u, c4 = -15.0 * r + 7.0 * s - 2.0 * u,
                  c5 = 6.0 * r - 3.0 * s + u;
    sample(d, h * n, h, samples, [&](double x) {
      Vector<double, 4> out;
      out << before.head<2>() + x * (v0 + x * (a0 + x * (c3 + x * (c4 + x * c5)))),
          (v0 + x * (2.0 * a0 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))) / h;
      return out;
    });
  }
}

/// phi_0 to phi_n of x: phi_0 = e^x, phi_m = x phi_(m + 1) + 1 / m!.
template <int n> Vector<Complex, n + 1> phi(Complex x) {
  Vector<Complex, n + 1> out;
  double factorial = std::tgamma(n + 1.0);
  Complex term = 1.0 / factorial, sum = term;
  for (int k = 1; std::norm(term) > 1e-36 * std::norm(sum); ++k)
    sum += term *= x / static_cast<double>(n + k);
  out[n] = sum;
  for (int m = n - 1; m >= 0; --m) {
    factorial /= m + 1.0;
    out[m] = x * out[m + 1] + 1.0 / factorial;
  }
  return out;
}

/// Roots of Legendre's polynomial, on [0, 1].
Vector<double, stages> nodes() {
  Vector<double, stages> out;
  for (int i = 0; i < stages; ++i) {
    double x = std::cos(M_PI * (i + 0.75) / (stages + 0.5));
    for (int k = 0; k < 6; ++k) {
      double p = 1.0, before = 0.0;
      for (int j = 0; j < stages; ++j)
        before = std::exchange(p, ((2 * j + 1) * x * p - j * before) / (j + 1));
      x -= p * (x * x - 1.0) / (stages * (x * p - before));
    }
    out[i] = 0.5 - 0.5 * x;
  }
  return out;
}

void gauss(const Device& d, int steps, Samples& samples) {
  constexpr int unknowns = 2 * stages; // accelerations of both flaps, stage by stage
  using Unknowns = Vector<double, unknowns>;
  using Square = Matrix<double, stages, stages>;
  const double h = d.end / steps;
  const Vector<double, stages> c = nodes();
  Square powers, angles, ahead; // at the nodes: of a'', of a / h^2, of a'' one step further on
  for (int i = 0; i < stages; ++i)
    for (int m = 0; m < stages; ++m) {
      powers(i, m) = std::pow(c[i], m);
      angles(i, m) = std::pow(c[i], m + 2) / ((m + 1) * (m + 2));
      ahead(i, m) = std::pow(1.0 + c[i], m);
    }
  const Square coefficients = powers.inverse(); // of a'' = sum of alpha_m s^m
  angles *= h * h * coefficients;
  ahead *= coefficients;
  // z = e^(p h s) z0 + B (h s phi_1 a'0 + h^2 sum of m! s^(m + 2) phi_(m + 2) alpha_m)
  Matrix<double, unknowns, states> by_memory; // of Re(C z) at the nodes
  Matrix<double, unknowns, 2> by_rate;
  Matrix<double, unknowns, unknowns> own;      // M + dRe(C z)/da'', then with the stiffness
  Matrix<double, states, 2 + unknowns> driven; // of z at the end
  Vector<Complex, poles> decay;
  for (int i = 0; i <= stages; ++i) {
    const double s = i < stages ? c[i] : 1.0;
    Matrix<Complex, poles, 1 + stages> g;
    for (int k = 0; k < poles; ++k) {
      const Vector<Complex, stages + 2> f = phi<stages + 1>(d.p[k] * h * s);
      decay[k] = f[0];
      g(k, 0) = h * s * f[1];
      double factor = h * h * s * s;
      for (int m = 0; m < stages; factor *= s * ++m)
        g(k, m + 1) = factor * f[m + 2];
    }
    g.rightCols<stages>() *= coefficients;
    for (int a = 0; a < 2; ++a)
      for (int j = 0; j <= stages; ++j)
        for (int b = 0; b < 2; ++b) {
          const Vector<Complex, poles> z = g.col(j).cwiseProduct(d.B.col(b));
          if (i == stages)
            driven.col(2 * j + b) = real(z);
          else
            (j == 0 ? by_rate(2 * i + a, b) : own(2 * i + a, 2 * (j - 1) + b)) =
                d.C.col(a).cwiseProduct(z).sum().real();
        }
    for (int a = 0; a < 2 && i < stages; ++a)
      by_memory.row(2 * i + a) = real(d.C.col(a).cwiseProduct(decay).conjugate());
  }
  Matrix<double, unknowns, unknowns> newton;
  for (int i = 0; i < stages; ++i)
    own.block<2, 2>(2 * i, 2 * i) += d.mass;
  newton = own;
  for (int b = 0; b < 2; ++b) {
    const double stiffness = (d.flap[b].load(-1e-4) - d.flap[b].load(1e-4)) / 2e-4;
    for (int i = 0; i < stages; ++i)
      for (int j = 0; j < stages; ++j)
        newton(2 * i + b, 2 * j + b) += stiffness * angles(i, j);
  }
  newton = newton.inverse().eval();
  const Vector<double, poles> re = decay.real();
  const Vector<double, pairs> im = decay.head<pairs>().imag();

  Vector2 angle = d.start(), rate = Vector2::Zero();
  States z = States::Zero();
  Unknowns x = Unknowns::Zero();
  for (int n = 0; n < steps; ++n) {
    using Columns = Matrix<double, 2, stages>; // of what both flaps have at the nodes
    Eigen::Map<Columns> a(x.data());
    if (n > 0)
      a = (a * ahead.transpose()).eval();
    const Unknowns known = by_memory * z + by_rate * rate;
    for (int k = 0; k < 20; ++k) {
      const Columns at = (h * rate * c.transpose() + a * angles.transpose()).colwise() + angle;
      Unknowns gap = -known - own * x;
      for (int i = 0; i < stages; ++i)
        gap.segment<2>(2 * i) += d.load(at.col(i));
      const Unknowns change = newton * gap;
      x += change;
      if (change.cwiseAbs().maxCoeff() < 1e-10) // rad/s2
        break;
    }
    const Matrix<double, 2, stages> alpha = a * coefficients.transpose();
    const auto inside = [&](double s) {
      Vector2 v = Vector2::Zero(), w = v;
      for (int m = stages - 1; m >= 0; --m) {
        v = s * v + alpha.col(m) / (m + 1.0);
        w = s * w + alpha.col(m) / ((m + 1.0) * (m + 2.0));
      }
      Vector<double, 4> out;
      out << angle + h * s * (rate + h * s * w), rate + h * s * v;
      return out;
    };
    sample(d, h * n, h, samples, inside);
    Vector<double, 2 + unknowns> drive;
    drive << rate, x;
    z = times(re, im, z) + driven * drive;
    const Vector<double, 4> last = inside(1.0);
    angle = last.head<2>();
    rate = last.tail<2>();
  }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: hydrodae-floor NUMBERS rk|gauss STEPS [SAMPLES]\n";
    return 2;
  }
  const Device device = read(argv[1]);
  const auto method = std::string(argv[2]) == "rk" ? rk : gauss;
  const int steps = std::atoi(argv[3]);
  Samples samples;
  const double seconds = costs::of("floor", [&] {
    samples.clear();
    method(device, steps, samples);
  });
  if (argc > 4)
    std::ofstream(argv[4], std::ios::binary)
        .write(reinterpret_cast<const char*>(samples.data()),
               static_cast<std::streamsize>(samples.size() * sizeof samples[0]));
  std::printf("{\"seconds\": %.9g, \"samples\": %zu}\n", seconds, samples.size());
  return 0;
}
