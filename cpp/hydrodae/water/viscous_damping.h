#pragma once
#include <cmath>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::water {

/// Viscous damping of one body, linear and quadratic, about its centre of gravity.
///
///   W = -C v - Q (v |v|)      v = [velocity; angular velocity] [m/s; rad/s], world axes
///
/// v |v| is taken component by component. W holds force [N] and moment [N m]. The first derivative
/// is continuous; the second one jumps where a component changes sign.
struct ViscousDamping {
  static constexpr std::string_view type = "viscous_damping";
  static constexpr element::Port port = element::Port::on_body;
  static constexpr std::string_view lost =
      "quadratic viscous_damping is zero in the linear model (it has no slope at rest)";
  static constexpr std::string_view doc =
      "Damping of one body about its centre of gravity, linear and quadratic: W = -C v - Q (v "
      "|v|).";
  std::string name;
  std::string body;
  Matrix6 linear = Matrix6::Zero();
  Matrix6 quadratic = Matrix6::Zero();

  /// Law with derived numbers.
  struct Law {
    Matrix6 linear, quadratic;

    template <class S> void operator()(const element::In<S>& in, const element::Out<S>& out) const {
      using std::abs;
      const Eigen::Map<const Vec6<S>> twist(in.v);
      Vec6<S> square;
      for (int k = 0; k < 6; ++k)
        square[k] = twist[k] * abs(twist[k]);
      Eigen::Map<Vec6<S>> load(out.load);
      load = -(linear.cast<S>() * twist) - quadratic.cast<S>() * square;
    }

    template <class J> void jacobian(const element::In<double>& in, J& j) const {
      const Eigen::Map<const Vector6> twist(in.v);
      j.template leftCols<6>().setZero();
      j.template rightCols<6>() = -linear - quadratic * (2.0 * twist.cwiseAbs()).asDiagonal();
    }

    bool lost_at_rest() const { return !quadratic.isZero(0.0); }
  };
  Law law() const { return {linear, quadratic}; }

  template <class V = ViscousDamping> static Fields<V> fields() {
    return {
        {"name", &V::name, "-", "Name of this force in the results.", true},
        {"body", &V::body, "-", "Body that is damped.", true},
        {"linear", &V::linear, "N s/m, N s, N m s",
         "C: six numbers (diagonal: surge, sway, heave, roll, pitch, yaw) or a 6x6 matrix."},
        {"quadratic", &V::quadratic, "N s2/m2, N s2, N m s2",
         "Q: six numbers (diagonal) or a 6x6 matrix."},
    };
  }
};

} // namespace hydrodae::water
