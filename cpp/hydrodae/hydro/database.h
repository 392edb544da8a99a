#pragma once
/// The prepared hydrodynamic database as the simulation needs it: plain data read from `hydro.h5`.
/// Phasors are x(t) = Re(X e^{+i w t}); rows are forces, columns are motions; SI units.

#include <array>
#include <complex>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/hydro/second_order.h"

namespace hydrodae::hydro {

/// Names of the rigid motions of a body in labels "<body>.<dof>"; other names are modes.
inline constexpr std::array<std::string_view, 6> rigid_dofs = {"surge", "sway",  "heave",
                                                               "roll",  "pitch", "yaw"};

/// Linear hydrostatics of one body about its reference point, buoyancy only.
struct Hydrostatics {
  double displaced_volume = 0.0;                ///< V [m3]
  Vector3 center_of_buoyancy = Vector3::Zero(); ///< world, in the reference pose [m]
  Matrix6 stiffness = Matrix6::Zero();          ///< C_hs [N/m, N, N m]
};

struct DatabaseBody {
  std::string name;
  Vector3 reference_point = Vector3::Zero(); ///< world point about which A, B and F are given [m]
  std::optional<Hydrostatics> hydrostatics;  ///< absent when the source does not hold it
  bool column = false;            ///< true: a piston of water inside a hull, no hull itself
  std::vector<std::string> modes; ///< names of its coordinates beyond the rigid six
  /// Hydrostatic stiffness of the six and the modes (6 + n, 6 + n), with the block of the six as
  /// above.
  MatrixX mode_stiffness;
};

/// Exponential radiation memory: z' = p z + B U, f_rad = -Re(C z); the complex poles have Im > 0
/// and stand for the conjugate pair (the factor 2 is inside C), the real ones have Im = 0.
struct MemoryFit {
  std::string name;
  std::vector<std::string> inputs;  ///< coordinates that move, "<body>.<dof>"
  std::vector<std::string> outputs; ///< coordinates that are loaded, includes the inputs
  Eigen::VectorXcd poles;           ///< (n_blocks,) [1/s]
  Eigen::MatrixXcd input_matrix;    ///< B (n_blocks, n_inputs)
  Eigen::MatrixXcd output_matrix;   ///< C (n_outputs, n_blocks)
  MatrixX added_mass_inf;           ///< (n_outputs, n_inputs), the one fitted together with B, C
  int states = 0;                   ///< one for a real pole, two for a pair
  bool passive = false;
};

/// Radiation kernel on a uniform grid: f_rad(t) = -int_0^T K(tau) U(t - tau) dtau.
struct RadiationKernel {
  double step = 0.0;                ///< step of the grid, which begins at 0 [s]
  std::vector<std::string> inputs;  ///< coordinates that move, "<body>.<dof>"
  std::vector<std::string> outputs; ///< coordinates that are loaded, includes the inputs
  std::vector<MatrixX> values;      ///< per time K (n_outputs, n_inputs) [N/m, N, N m]
  MatrixX added_mass_inf;           ///< (n_outputs, n_inputs), the one that belongs to K

  double length() const { return step * static_cast<double>(values.size() - 1); } ///< T [s]
};

struct Database {
  std::string path;
  double rho = 0.0;                     ///< [kg/m3]
  double gravity = 0.0;                 ///< [m/s2]
  double water_depth = 0.0;             ///< [m], may be infinite
  std::vector<std::string> coordinates; ///< labels "<body>.<dof>" of the rows and columns
  std::vector<DatabaseBody> bodies;
  MatrixX added_mass_inf; ///< (n, n), estimate from the frequency data, used without memory
  std::vector<MemoryFit> fits;

  // Tables over frequency; each is read only for a scene that uses it.
  VectorX omega;                               ///< (nw,) ascending [rad/s]
  VectorX heading;                             ///< (nh,) ascending directions of travel [rad]
  std::vector<Eigen::MatrixXcd> excitation;    ///< per heading (nw, n), per metre of amplitude
  std::vector<Eigen::MatrixXcd> froude_krylov; ///< its part; empty where only the sum is known
  std::vector<MatrixX> added_mass, damping;    ///< A(w), B(w): per frequency (n, n)
  std::optional<RadiationKernel> kernel;       ///< likewise, and where the file holds one
  std::vector<SecondOrderTable> second_order;  ///< likewise; at most one of a kind
};

} // namespace hydrodae::hydro
