#pragma once
#include <algorithm>
#include <string>
#include <string_view>

#include "hydrodae/element/elements.h"
#include "hydrodae/water/morison.h"

namespace hydrodae::water {

/// Buoyancy of a body in water without a database: rho g V upwards at a point of the body. The
/// buoyancy of a sphere ends at the surface, z = 0.
struct Buoyancy {
  static constexpr std::string_view type = "buoyancy";
  static constexpr bool buoyant = true;
  static constexpr element::Port port = element::Port::points;
  static constexpr int n_points = 1;
  static constexpr element::Work work = element::Work::lent;
  std::string name;
  double lift = 0.0;   ///< rho g V [N]
  double radius = 0.0; ///< radius of a sphere [m]; 0: always under water

  struct Law {
    double lift;
    MorisonSegment sphere;
    template <class S> S wet(const S& z, S* by_z = nullptr) const {
      return sphere.radius > 0.0 ? wet_part<S>(sphere, z, S(0), by_z) : S(1);
    }
    template <class S> void operator()(const element::In<S>& in, const element::Out<S>& out) const {
      out.load[0] = out.load[1] = S(0);
      out.load[2] = lift * wet<S>(in.x[2]);
    }
    template <class J> void jacobian(const element::In<double>& in, J& j) const {
      double by_z = 0.0;
      wet<double>(in.x[2], &by_z);
      j.setZero();
      j(2, 2) = lift * by_z;
    }
    /// Energy of a sphere: zero at the surface, - lift z deep in the water.
    double energy(const element::In<double>& in) const {
      const double z = in.x[2], d = 2.0 * sphere.radius;
      if (d == 0.0 || z < -sphere.radius)
        return -lift * z;
      const double x = std::max(0.5 - z / d, 0.0);
      return lift * d * (1.0 - 0.5 * x) * x * x * x;
    }
  };
  Law law() const { return {lift, {.radius = radius}}; }
};

} // namespace hydrodae::water
