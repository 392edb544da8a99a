/// Chambers of air as laws: flows against their formulas, stored energy, networks.

#include <array>
#include <cmath>

#include "hydrodae/air/network.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::air;

namespace {

Chamber chamber(const std::string& name, double volume, double exponent = 1.4) {
  Chamber out;
  out.name = name;
  out.volume = volume;
  out.exponent = exponent;
  return out;
}

Piston piston(const std::string& name, double area) {
  Piston out;
  out.name = out.chamber = name;
  out.joint = "column";
  out.area = area;
  return out;
}

Orifice orifice(const std::string& from) {
  Orifice out;
  out.name = "hole";
  out.chamber = from;
  out.coefficient = 0.6;
  out.area = 0.5;
  return out;
}

/// Flow of an outlet at a drop of pressure out of air of 1.2 kg/m3.
template <class O> double flow(const O& outlet, double drop, double pressure = 101325.0) {
  return outlet.flow(drop, Inlet<double>{pressure, 1.2, 100.0}, Held{});
}

} // namespace

TEST_CASE("an orifice goes with the root of the drop, and chokes") {
  const Orifice hole = orifice("air");
  CHECK(flow(hole, 400.0) == doctest::Approx(0.3 * std::sqrt(2.4 * 400.0)).epsilon(1e-5));
  CHECK(flow(hole, -400.0) == -flow(hole, 400.0));
  CHECK(flow(hole, 1e-3) == doctest::Approx(0.3 * std::sqrt(2.4) * 1e-3).epsilon(1e-6));
  const double inside = 3e5, limit = inside * (1.0 - std::pow(1.2, -3.5));
  CHECK(flow(hole, 2e5, inside) == flow(hole, 2.5e5, inside));
  CHECK(flow(hole, 2e5, inside) == doctest::Approx(flow(hole, limit, inside)).epsilon(1e-12));
  CHECK(hole.kink(limit, Inlet<double>{inside, 1.2}, Held{}) ==
        doctest::Approx(0.0).epsilon(1e-12));
}

TEST_CASE("a Wells turbine is linear until it stalls") {
  Wells turbine;
  turbine.diameter = 0.75;
  turbine.speed = 100.0;
  turbine.flow_slope = 0.775;
  CHECK(flow(turbine, 1000.0) == doctest::Approx(0.775 * 0.75 * 1000.0 / 100.0));
  turbine.stall = 0.1;
  turbine.stall_slope = 1.5;
  const double unit = 1.2 * 1e4 * 0.5625, psi = 0.25;
  const double phi = 0.775 * 0.1 + 1.5 * (psi - 0.1);
  CHECK(flow(turbine, psi * unit) == doctest::Approx(phi * 1.2 * 100.0 * 0.421875));
  CHECK(flow(turbine, -psi * unit) == doctest::Approx(-phi * 1.2 * 100.0 * 0.421875));
  CHECK(flow(turbine, 0.1 * unit * (1.0 + 1e-12)) ==
        doctest::Approx(flow(turbine, 0.1 * unit * (1.0 - 1e-12))));
}

TEST_CASE("stored energy is the integral of the pressure over the volume") {
  for (const double n : {1.0, 1.2, 1.4}) {
    CAPTURE(n);
    const Network air({{}, {chamber("air", 90.0, n)}, {piston("air", 10.0)}, {}});
    const double mass = 1.225 * 90.0;
    const auto at = [&](double s) {
      const std::array<double, 3> in = {s, 0.0, mass};
      std::array<double, 2> out{};
      double energy = 0.0;
      air.evaluate(0.0, in.data(), nullptr, out.data());
      air.energy(in.data(), nullptr, &energy);
      return std::pair{-out[0], energy};
    };
    const int steps = 4000; // Simpson
    double work = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double h = 3.0 / steps;
      work += h / 6.0 * (at(k * h).first + 4.0 * at((k + 0.5) * h).first + at((k + 1) * h).first);
    }
    CHECK(at(3.0).second == doctest::Approx(work).epsilon(1e-10));
    CHECK(at(0.0).second == 0.0);
  }
}

TEST_CASE("ducts join chambers to networks, and keep the air") {
  Orifice duct = orifice("b");
  duct.to = "c";
  const Parts all{
      {}, {chamber("a", 5.0), chamber("b", 6.0), chamber("c", 7.0)}, {piston("b", 1.0)}, {duct}};
  const std::vector<Parts> found = networks(all);
  REQUIRE(found.size() == 2);
  CHECK(found[0].chambers.size() == 1);
  REQUIRE(found[1].chambers.size() == 2);
  const Network joined(found[1]);
  const std::array<double, 4> in = {0.3, 0.0, 7.0, 9.0};
  std::array<double, 3> out{};
  joined.evaluate(0.0, in.data(), nullptr, out.data());
  CHECK(out[1] == -out[2]);
  CHECK(out[1] != 0.0);
}

TEST_CASE("air that is shut in is kept at rest, open air has the pressure outside") {
  const std::array<double, 2> at_start = {0.0, 0.0}, moved = {2.0, 0.0};
  double load = 0.0;
  const Network shut({{}, {chamber("air", 90.0)}, {piston("air", 10.0)}, {}});
  shut.started(at_start.data())->statics()->evaluate(0.0, moved.data(), nullptr, &load);
  CHECK(load ==
        doctest::Approx(-10.0 * 101325.0 * (std::pow(90.0 / 70.0, 1.4) - 1.0)).epsilon(1e-12));
  const Network open({{}, {chamber("air", 90.0)}, {piston("air", 10.0)}, {orifice("air")}});
  open.started(at_start.data())->statics()->evaluate(0.0, moved.data(), nullptr, &load);
  CHECK(load == 0.0);
}
