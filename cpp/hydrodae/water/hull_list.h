#pragma once
/// Water pressure on the wetted part of meshes at each instant: hydrostatics, and with waves the
/// Froude-Krylov load (hull/loads.h).

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hydrodae/element/elements.h"
#include "hydrodae/hull/loads.h"

namespace hydrodae::water {

/// Bodies with meshes in still water or in the same waves; inputs are those of Port::in_water, of
/// which only the pose is used. Evaluations allocate nothing once each thread has a workspace.
/// Thread-safe.
///
/// In still water the loads have a potential, zero in the reference pose. In waves they exchange
/// energy with the body.
class HullList final : public element::Elements {
public:
  /// @param water      density, gravity, depth, and the pressure above z = 0
  /// @param waves      empty: still water
  /// @param ramp_time  duration of the growth of the waves [s]
  HullList(const hull::Water& water, std::vector<hull::Wave> waves, double ramp_time);

  /// @param reference  centre of gravity, the origin of the mesh, in the reference pose [m]
  /// @param moves      true: the body can move; false: its load is only reported
  void add(const std::string& name, std::shared_ptr<const hull::Mesh> mesh,
           const Vector3& reference, bool moves);

  void evaluate(double t, const double* in, const double*, double* out) const override;
  void evaluate(double t, const Dual* in, const double*, Dual* out) const override;
  void jacobian(double t, const double* in, const double*, double* jacobian) const override;
  void energy(const double* in, const double*, double* joules) const override;
  void observe(double, const double*, const double*, const double*, double*) const override {}
  void report(double t, const double* in, const double*, double* out) const override;
  bool lost_at_rest(std::size_t) const override { return false; }
  element::WavesFelt waves() const override;
  double elevation(double t) const override;
  std::shared_ptr<const element::Elements> calm() const override;
  std::shared_ptr<const element::Elements>
  stirred(const std::function<double()>& draw) const override;

private:
  /// Workspace of an evaluation, and the last loads without gradient, which a sample reads several
  /// times.
  struct Scratch {
    hull::Workspace work;
    bool known = false;
    hull::Pose pose;
    hull::Instant instant;
    hull::Loads loads;
  };
  /// Unused scratches.
  struct Pool {
    std::mutex guard;
    std::vector<std::unique_ptr<Scratch>> idle;
  };
  struct Body {
    std::string name;
    std::shared_ptr<const hull::Mesh> mesh;
    Vector3 reference;
    bool moves;
    hull::WaveField field;
    std::shared_ptr<Pool> pool;
    double energy_of_reference; ///< energy in the reference pose [J]
  };
  class Borrowed;

  std::shared_ptr<HullList> with(std::vector<hull::Wave> waves, double ramp_time) const;
  hull::Instant instant(double t) const;
  hull::Loads loads(const Body& body, double t, const hull::Pose& pose,
                    Matrix6* by_pose = nullptr) const;
  double potential(const Body& body, const hull::Pose& pose) const;

  hull::Water water_;
  std::vector<hull::Wave> waves_;
  double ramp_time_;
  std::vector<Body> bodies_;
};

} // namespace hydrodae::water
