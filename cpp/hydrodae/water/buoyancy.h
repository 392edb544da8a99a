#pragma once
#include <string>
#include <string_view>

#include "hydrodae/element/elements.h"

namespace hydrodae::water {

/// Buoyancy of a body under water that no database covers: rho g V upwards at a point of the body.
struct Buoyancy {
  static constexpr std::string_view type = "buoyancy";
  static constexpr bool buoyant = true;
  static constexpr element::Port port = element::Port::points;
  static constexpr int n_points = 1;
  static constexpr element::Work work = element::Work::lent;
  std::string name;
  double lift = 0.0; ///< rho g V [N]

  struct Law {
    double lift;
    template <class S> void operator()(const element::In<S>&, const element::Out<S>& out) const {
      out.load[0] = out.load[1] = S(0);
      out.load[2] = S(lift);
    }
    template <class J> void jacobian(const element::In<double>&, J& j) const { j.setZero(); }
    double energy(const element::In<double>& in) const { return -lift * in.x[2]; }
  };
  Law law() const { return {lift}; }
};

} // namespace hydrodae::water
