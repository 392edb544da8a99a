#pragma once
/// Loads of the Morison elements: the sum over their segments, each by the water at its centre.

#include "hydrodae/element/morison.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// The water at the segments of an element, into `fluid` (and `gradients`).
template <class S>
void morison_fluid(const sea::WaveField& water, const MorisonData& m, const BodyState<S>& body,
                   double t, std::vector<sea::FluidPoint<S>>& fluid,
                   sea::FluidGradient* gradients = nullptr) {
  const Vec3<S> first = body.r + body.R * m.first.cast<S>();
  const Vec3<S> step = body.R * m.step.cast<S>();
  sea::fluid_on_line<S>(water, t, first, step, m.segments, fluid.data(), gradients);
}

/// World force [N] and body-axes moment about the centre of gravity [N m].
template <class S>
Vec6<S> morison_load(const sea::WaveField& water, const MorisonData& m, const BodyState<S>& body,
                     double t, std::vector<sea::FluidPoint<S>>& fluid) {
  morison_fluid<S>(water, m, body, t, fluid);
  const Vec3<S> axis = body.R * m.axis.cast<S>();
  Vec6<S> load = Vec6<S>::Zero();
  for (int k = 0; k < m.segments; ++k) {
    const sea::FluidPoint<S>& f = fluid[static_cast<std::size_t>(k)];
    const Vec3<S> arm = (m.first + k * m.step).template cast<S>();
    const Vec3<S> spin = cross<S>(body.w, arm);
    const Vec3<S> velocity = body.v + body.R * spin;
    const Vec3<S> acceleration =
        body.v_dot + body.R * Vec3<S>(cross<S>(body.w_dot, arm) + cross<S>(body.w, spin));
    S height = body.r[2] + (body.R * arm)[2];
    if (m.instantaneous)
      height -= f.elevation;
    const Vec3<S> u = f.velocity - velocity;
    const Vec3<S> force = element::wet_part<S>(m.law, height, axis[2]) *
                          element::morison_force<S>(m.law, axis, u, f.acceleration, acceleration);
    load.template head<3>() += force;
    load.template tail<3>() += cross<S>(arm, Vec3<S>(body.R.transpose() * force));
  }
  return load;
}

/// Adds the elements of all bodies that move to `ws.loads`.
template <class S> void add_morison(const System& s, Workspace<S>& ws, double t) {
  for (const MorisonData& m : s.morison)
    if (s.bodies[m.body].n_active > 0)
      ws.loads[m.body] += morison_load<S>(s.water, m, ws.bodies[m.body], t, ws.fluid);
}

} // namespace hydrodae::system
