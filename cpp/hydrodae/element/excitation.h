#pragma once
/// Wave excitation of all hydrodynamic bodies, by the tables of the database.
///
///   load = L f(t)       along the hydrodynamic axes of each body (hydro_axes.h)
///
/// f is a function of time; or, where the phase of the waves moves with the bodies, of time and the
/// horizontal displacement of each body as well.

#include "hydrodae/element/elements.h"
#include "hydrodae/element/hydro_axes.h"
#include "hydrodae/sea/drifting.h"
#include "hydrodae/sea/signals.h"

namespace hydrodae::element {

class Excitation final : public Elements {
public:
  struct Body {
    std::string name;
    HydroBody wet;
    Vector3 reference = Vector3::Zero(); ///< centre of gravity in the reference pose [m]
    double length = 1.0;                 ///< that tells noise of moments from that of forces [m]
  };

  /// The functions: n_moving loads on U, 6 n_bodies loads on all coordinates, where `split` as many
  /// of their Froude-Krylov parts, and the elevation at the origin [m].
  Excitation(HydroAxes axes, std::vector<Body> bodies, int n_moving, bool split);
  void set(sea::Signals functions) { fixed_ = std::move(functions); }
  void set(sea::DriftingSignals functions) { drifting_ = std::move(functions); }

  /// Takes the axes of the bodies, as they are turned now.
  void turn(const std::vector<HydroBody>& bodies);

  void evaluate(double t, const double* in, const double*, double* out) const override;
  void evaluate(double t, const Dual* in, const double*, Dual* out) const override;
  void jacobian(double t, const double* in, const double*, double* jacobian) const override;
  void energy(const double*, const double*, double* joules) const override;
  void observe(double, const double*, const double*, const double*, double*) const override {}
  void report(double t, const double* in, const double*, double* loads) const override;
  bool lost_at_rest(std::size_t) const override { return false; }
  WavesFelt waves() const override;
  double elevation(double t) const override;
  std::shared_ptr<const Elements> calm() const override;
  std::shared_ptr<const Elements> stirred(const std::function<double()>& draw) const override;

private:
  template <class S> void loads(double t, const S* in, S* out) const;
  template <class S> Vec6<S> force(double t, const Body& body, const S* in, const double* f) const;
  Index count() const { return fixed_.size() + drifting_.size(); }
  VectorX least(const VectorX& largest) const;

  HydroAxes axes_;
  std::vector<Body> bodies_;
  int n_moving_ = 0;
  sea::Signals fixed_; ///< one of the two is empty; both: still water
  sea::DriftingSignals drifting_;
};

} // namespace hydrodae::element
