#pragma once
/// Wave excitation of all hydrodynamic bodies, from the tables of the database.
///
///   load = L sum_m b_m(psi) w_m(s) f_m(t)      along the hydrodynamic axes of each body
///                                              (hydro_axes.h)
/// f_m are functions of time; if the phase of the waves moves with the bodies, they depend on the
/// horizontal displacement of each body, too. b_m are functions of the body's yaw
/// (yaw_functions.h): in axes that follow the yaw, waves act with the force of their heading
/// relative to the body; in other axes b is 1. Pose and yaw of a mode are those of its carrier. w_m
/// are weights of tables for several poses s (pose_table.h); of a body with one table w is 1.

#include "hydrodae/element/elements.h"
#include "hydrodae/sea/drifting.h"
#include "hydrodae/sea/signals.h"
#include "hydrodae/water/hydro_axes.h"
#include "hydrodae/water/pose_table.h"
#include "hydrodae/water/yaw_functions.h"

namespace hydrodae::water {

class Excitation final : public element::Elements {
public:
  /// Function of time that acts along a coordinate (0..5) with the factor b_m and the weight of its
  /// pose.
  struct Term {
    int coordinate = 0, m = 0, pose = 0;
  };
  /// Successive functions of time, beginning with `first`.
  struct Terms {
    Index first = 0;
    std::vector<Term> list;
    Index count() const { return static_cast<Index>(list.size()); }
  };
  struct Body {
    std::string name;
    HydroBody wet;
    Vector3 reference = Vector3::Zero(); ///< centre of gravity in the reference pose [m]
    double length = 1.0;                 ///< ratio of the noise of moments to that of forces [m]
    bool mode = false; ///< true: a mode, loaded along its amplitude; its pose is its carrier's
    YawFunctions yaw;
    PoseAxis poses;
    Terms moving;        ///< terms of loads along coordinates that move
    Terms still;         ///< terms of loads along fixed coordinates, for reports
    Terms froude_krylov; ///< Froude-Krylov part of all terms; empty if only the sum is known
  };

  /// Functions of time: `moving` of all bodies, then the other terms, last the elevation at the
  /// origin [m].
  Excitation(HydroAxes axes, std::vector<Body> bodies, bool split);
  void set(sea::Signals functions) { fixed_ = std::move(functions); }
  void set(sea::DriftingSignals functions) { drifting_ = std::move(functions); }

  /// Takes the present axes of the bodies.
  void turn(const std::vector<HydroBody>& bodies);

  void evaluate(double t, const double* in, const double*, double* out) const override;
  void evaluate(double t, const Dual* in, const double*, Dual* out) const override;
  void jacobian(double t, const double* in, const double*, double* jacobian) const override;
  void energy(const double*, const double*, double* joules) const override;
  void observe(double, const double*, const double*, const double*, double*) const override {}
  /// Throws SolverError if the yaw of a body leaves the headings of the database.
  void report(double t, const double* in, const double*, double* loads) const override;
  bool lost_at_rest(std::size_t) const override { return false; }
  element::WavesFelt waves() const override;
  double elevation(double t) const override;
  std::shared_ptr<const element::Elements> unreported() const override;
  std::shared_ptr<const element::Elements> calm() const override;
  std::shared_ptr<const element::Elements>
  stirred(const std::function<double()>& draw) const override;

private:
  template <class S> void loads(double t, const S* in, S* out) const;
  /// Factors of the terms of a body.
  template <class S> struct Factors {
    YawFunctions::Values<S> yaw;
    std::array<S, PoseAxis::most> pose, pose_slopes;
    S operator()(const Term& term) const {
      return yaw[static_cast<std::size_t>(term.m)] * pose[static_cast<std::size_t>(term.pose)];
    }
  };
  template <class S>
  Vec6<S> force(double t, const Body& body, const Terms& terms, const S* in, const Factors<S>& b,
                const double* f) const;
  template <class S> void factors(const Body& body, const S* in, Factors<S>& b) const;
  Eigen::Matrix<double, 6, 2> by_place(double t, const Body& body, const double* in,
                                       const Factors<double>& b) const;
  void check_yaw(double t, const Body& body, const double* in) const;
  Index count() const { return fixed_.size() + drifting_.size(); }
  VectorX least(const VectorX& largest) const;

  HydroAxes axes_;
  std::vector<Body> bodies_;
  Index n_moving_ = 0; ///< number of functions of time on coordinates that move
  sea::Signals fixed_; ///< fixed signals; one of the two is empty; both empty: still water
  sea::DriftingSignals drifting_;
};

} // namespace hydrodae::water
