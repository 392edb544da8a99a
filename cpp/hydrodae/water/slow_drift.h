#pragma once
/// Loads of pairs of waves on hydrodynamic bodies, by tables of second order.
///
///   load = L sum_m b_m(psi) F_m(t)      along the hydrodynamic axes of each body (hydro_axes.h)
///
/// F_m are quadratic in the wave components (sea/quadratic.h), b_m functions of the yaw of the body
/// (yaw_functions.h). Where the phase of the waves moves with the bodies, F_m depend on the
/// horizontal displacement of each body as well.

#include "hydrodae/element/elements.h"
#include "hydrodae/sea/quadratic.h"
#include "hydrodae/water/hydro_axes.h"
#include "hydrodae/water/yaw_functions.h"

namespace hydrodae::water {

class SlowDrift final : public element::Elements {
public:
  /// A function of time that acts along a coordinate (0..5) as often as b_m, and to which of the
  /// loads of the case it belongs.
  struct Term {
    int coordinate = 0, m = 0, load = 0;
  };
  /// Successive functions of time, from `first` on.
  struct Terms {
    Index first = 0;
    std::vector<Term> list;
    Index count() const { return static_cast<Index>(list.size()); }
  };
  struct Body {
    std::string name;
    HydroBody wet;
    Vector3 reference = Vector3::Zero(); ///< centre of gravity in the reference pose [m]
    YawFunctions yaw;
    Terms moving; ///< loads along the coordinates that move
    Terms still;  ///< along the others, which are reported
  };
  /// The functions of time: by fixed places of the bodies, or by places that move. At most one of
  /// the two; both empty: still water.
  struct Functions {
    sea::QuadraticSignals fixed;
    sea::DriftingQuadratic drifting;
    bool empty() const { return fixed.empty() && drifting.empty(); }
  };

  /// @param loads words of the case, of which each is reported beside their sum if there are two
  SlowDrift(HydroAxes axes, std::vector<Body> bodies, const std::vector<std::string>& loads);
  void set(Functions moving, Functions still);

  void evaluate(double t, const double* in, const double*, double* out) const override;
  void evaluate(double t, const Dual* in, const double*, Dual* out) const override;
  void jacobian(double t, const double* in, const double*, double* jacobian) const override;
  void energy(const double*, const double*, double* joules) const override;
  void observe(double, const double*, const double*, const double*, double*) const override {}
  /// Throws SolverError where the yaw of a body leaves what the headings of the table cover.
  void report(double t, const double* in, const double*, double* loads) const override;
  bool lost_at_rest(std::size_t) const override { return false; }
  std::shared_ptr<const element::Elements> unreported() const override;
  std::shared_ptr<const element::Elements> calm() const override;

private:
  template <class S> void loads(double t, const S* in, S* out) const;
  template <class S>
  Vec6<S> force(double t, const Body& body, const Terms& terms, const Functions& functions,
                const double* fixed, const S* in, const YawFunctions::Values<S>& b,
                int load = -1) const;
  void check_yaw(double t, const Body& body, const double* in) const;

  HydroAxes axes_;
  std::vector<Body> bodies_;
  Functions moving_, still_;
};

} // namespace hydrodae::water
