#pragma once
/// Bound waves of second order at the sums and differences of the frequencies of linear waves.
///
/// The boundary conditions at z = 0, to the second order in the amplitudes:
///
///   phi2_tt + g phi2_z = -eta (phi_tt + g phi_z)_z - (|grad phi|^2)_t
///   g eta2 = -(phi2_t + 1/2 |grad phi|^2 + eta phi_tz)
///
/// Two components of a = 1 m have th_i = w_i t - k_i.x + phase_i and t_i = tanh k_i d. With s = 1
/// for the sum, s = -1 for the difference, W = w_1 + s w_2 and K = |k_1 + s k_2| they make
///
///   phi2 = P cosh K(z+d) / cosh Kd sin(th_1 + s th_2),   eta2 = E cos(th_1 + s th_2)
///   P = (W Q - (F_1 + s F_2) / 2) / (g K tanh Kd - W^2)
///   E = -(W P + Q / 2 - (w_1^2 + w_2^2) / 2) / g
///   Q = g^2 (k_1.k_2 - s k_1 k_2 t_1 t_2) / (w_1 w_2),   F_i = -g^2 k_i^2 (1 - t_i^2) / w_i
///
/// as Longuet-Higgins (J. Fluid Mech. 12 (1962) 321) and, in water of finite depth, Sharma and Dean
/// (Soc. Petrol. Eng. J. 21 (1981) 129). One component makes half of its pair with itself: 2 w, and
/// the set-down -a^2 k / (2 sinh 2kd), with the Bernoulli constant zero and no return flow.

#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/sea/kinematics.h"

namespace hydrodae::sea {

/// Bound wave of two components of 1 m.
struct BoundWave {
  double omega = 0.0;     ///< W [rad/s]
  double kx = 0.0;        ///< of k_1 + s k_2 [rad/m]
  double ky = 0.0;        ///< of k_1 + s k_2 [rad/m]
  double elevation = 0.0; ///< E [1/m]
  double potential = 0.0; ///< P [1/s]
};

/// @param sign 1: sum, -1: difference
BoundWave bound_wave(const Component& first, const Component& second, int sign, double depth,
                     double gravity);

/// The largest bound waves, and what the others would have added.
struct BoundWaves {
  std::vector<WaveField::Term> terms;
  std::size_t all = 0;                 ///< number of bound waves
  double elevation = 1.0, speed = 1.0; ///< kept part of the rms of the elevation, of the velocity
};

/// @param most largest number of bound waves that are kept, the set-down apart
BoundWaves bound_waves(const std::vector<Component>& components, double depth, double gravity,
                       std::size_t most);

/// Second-order elevation of all pairs as a quadratic form in the cosines c_i and sines s_i of the
/// phases: eta2 = c^T A c + s^T B s, without a cosine of its own for each pair.
class SecondOrder {
public:
  SecondOrder(std::vector<Component> components, double depth, double gravity);

  double elevation(double t, double x, double y) const; ///< without the ramp [m]

private:
  std::vector<Component> components_;
  MatrixX cosines_, sines_; ///< A, B (n, n) [m]
};

} // namespace hydrodae::sea
