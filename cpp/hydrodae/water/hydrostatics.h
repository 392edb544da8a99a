#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::water {

/// Linear hydrostatics of a body from the database: buoyancy and its stiffness about the pose of
/// the database, in axes turned by the mean yaw.
struct Hydrostatics {
  static constexpr std::string_view type = "hydrostatic";
  static constexpr bool buoyant = true;
  static constexpr element::Port port = element::Port::on_body;
  static constexpr element::Work work = element::Work::lent;
  std::string name;
  element::LinearWrench wrench;

  const element::LinearWrench& law() const { return wrench; }
};

/// Linear hydrostatics of bodies at any yaw. Only height and tilt of a pose matter in still water:
///
///   E = 1/2 x.K x - W0.x,   x = (z - z_ref, tau_x, tau_y)
///
/// tau = f (g_y, -g_x) is the shortest rotation vector that tilts the upright body, along axes that
/// follow its yaw [rad]; g = R^T e_z, f = beta / sin beta, cos beta = g_z. The load is
/// F_z = -dE/dz, and the moment g x dE/dg in body axes. Gradient and energy are exact at any pose
/// but the capsized one, beta = pi.
class YawHydrostatics final : public element::Elements {
public:
  YawHydrostatics();
  /// @param wrench  load in the axes of the database; only heave, roll and pitch are used
  /// @param height  z_ref [m]
  void add(const std::string& name, const element::LinearWrench& wrench, double height);

  void evaluate(double, const double* in, const double*, double* out) const override;
  void evaluate(double, const Dual* in, const double*, Dual* out) const override;
  void jacobian(double, const double* in, const double*, double* jacobian) const override;
  void energy(const double* in, const double*, double* joules) const override;
  void observe(double, const double*, const double*, const double*, double*) const override {}
  bool lost_at_rest(std::size_t) const override { return false; }

private:
  struct Law {
    Matrix3 stiffness; ///< K
    Vector3 constant;  ///< W0
    double height;     ///< z_ref
  };
  template <class S> static Vec6<S> load(const Law& law, const S& z, const Vec3<S>& g);
  template <class S> void each(const S* in, S* out) const;

  std::vector<Law> laws_;
};

} // namespace hydrodae::water
