#pragma once
/// The tables of the database between their points.

#include <optional>
#include <vector>

#include "hydrodae/hydro/database.h"
#include "hydrodae/math/spline.h"

namespace hydrodae::hydro {

/// The heading as an angle within the headings of the database (turned by full turns), or nothing
/// if it lies more than 1e-4 rad outside. A database of one heading covers that one only.
std::optional<double> covered_heading(const Database& database, double heading);

/// Does the database reach to this frequency [rad/s]?
bool covers_frequency(const Database& database, double omega);

/// Excitation of some coordinates at any frequency and heading inside the tables. The phase at the
/// body's reference point is taken off, real and imaginary part are interpolated by natural cubic
/// splines in frequency, then in heading, and the phase is put back: without it the coefficients
/// are smooth functions of both.
class Excitation {
public:
  /// `labels` "<body>.<dof>"; those that are no coordinates of the database get no load. `table`:
  /// the excitation of the database or its Froude-Krylov part.
  Excitation(const Database& database, const std::vector<Eigen::MatrixXcd>& table,
             const std::vector<std::string>& labels);

  /// Per metre of amplitude [N/m, N m/m], phase zero at the origin of the world; (n_labels,).
  /// The frequency must be covered, the heading come from `covered_heading`.
  Eigen::VectorXcd operator()(double omega, double heading) const;

private:
  const Database& db_;
  struct Row {
    bool known = false;
    Vector3 point = Vector3::Zero();
    std::vector<CubicSpline> real, imaginary; ///< one a heading
  };
  std::vector<Row> rows_;
};

/// A table over frequency at one frequency, by natural cubic splines; (n, n).
MatrixX at_frequency(const Database& database, const std::vector<MatrixX>& table, double omega);

} // namespace hydrodae::hydro
