#pragma once
/// Morison elements of a scene, and the water around them.

#include "hydrodae/element/elements.h"
#include "hydrodae/sea/kinematics.h"
#include "hydrodae/water/morison.h"

namespace hydrodae::water {

/// Equal segments at equal distances on a straight line of a body.
struct MorisonMember {
  MorisonSegment law;
  int segments = 1;
  /// Centre of the first segment relative to the centre of gravity, body axes [m]
  Vector3 first = Vector3::Zero();
  Vector3 step = Vector3::Zero(); ///< vector from centre to centre [m]
  Vector3 axis = Vector3::Zero(); ///< axis in body axes; zero: a point element
  bool instantaneous = false;     ///< true: wet up to the elevation; false: up to z = 0
  bool moves = true;              ///< true: the body can move; false: its load is only reported
};

/// Sum over the segments, each with the water at its centre. Allocates nothing after a first call;
/// thread-safe.
class MorisonList final : public element::Elements {
public:
  explicit MorisonList(sea::WaveField sea);
  void add(const std::string& name, const MorisonMember& member);

  void evaluate(double t, const double* in, const double*, double* out) const override;
  void evaluate(double t, const Dual* in, const double*, Dual* out) const override;
  void jacobian(double t, const double* in, const double*, double* jacobian) const override;
  void energy(const double*, const double*, double* joules) const override;
  void observe(double, const double*, const double*, const double*, double*) const override {}
  void report(double t, const double* in, const double* out, double* loads) const override;
  bool lost_at_rest(std::size_t law) const override;
  element::WavesFelt waves() const override;
  double elevation(double t) const override;
  std::vector<element::WaterLoad> by_water(std::size_t law, const double* in) const override;
  std::shared_ptr<const element::Elements> calm() const override;
  std::shared_ptr<const element::Elements>
  stirred(const std::function<double()>& draw) const override;

private:
  template <class S> void loads(double t, const S* in, S* out) const;

  sea::WaveField water_;
  std::vector<MorisonMember> members_;
};

} // namespace hydrodae::water
