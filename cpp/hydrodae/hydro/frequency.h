#pragma once
/// Interpolation of the database's tables.

#include <vector>

#include "hydrodae/hydro/database.h"
#include "hydrodae/hydro/headings.h"
#include "hydrodae/math/spline.h"

namespace hydrodae::hydro {

/// Returns whether the database covers this frequency [rad/s].
bool covers_frequency(const Database& database, double omega);

/// Reference point of the wave phase in the interpolation of forces on a body: its centre of
/// buoyancy or, if that is unknown, the reference point, which may be far away.
Vector3 phase_point(const DatabaseBody& body);

/// Excitation of some coordinates at any frequency and heading inside the tables. The phase at the
/// body is taken off, real and imaginary part are interpolated by natural cubic splines in
/// frequency, then over the headings (headings.h), and the phase is put back: without it the
/// coefficients are smooth functions of both.
class Excitation {
public:
  /// `labels` "<body>.<dof>"; those that are no coordinates of the database get no load. `table`:
  /// the excitation of the database or its Froude-Krylov part.
  Excitation(const Database& database, const std::vector<Eigen::MatrixXcd>& table,
             const std::vector<std::string>& labels);

  /// Per metre of amplitude [N/m, N m/m], phase zero at the origin of the world; (n_labels,).
  /// The frequency must be covered, the heading come from `headings().covered`.
  Eigen::VectorXcd operator()(double omega, double heading) const;

  /// Excitation without the phase, at the headings of the table, (nh, n_labels).
  Eigen::MatrixXcd smooth(double omega) const { return smooth(omega, 0, std::ssize(rows_)); }

  /// Excitation without the phase for successive labels, (nh, count).
  Eigen::MatrixXcd smooth(double omega, Eigen::Index first, Eigen::Index count) const;

  /// Reference point of the phase of a label [m].
  const Vector3& point(std::size_t label) const { return rows_[label].point; }

  const Headings& headings() const { return headings_; }

private:
  const Database& db_;
  Headings headings_;
  struct Row {
    bool known = false;
    Vector3 point = Vector3::Zero();
    std::vector<CubicSpline> real, imaginary; ///< splines, one for each heading
  };
  std::vector<Row> rows_;
};

/// A table over frequency at one frequency, by natural cubic splines; (n, n).
MatrixX at_frequency(const Database& database, const std::vector<MatrixX>& table, double omega);

} // namespace hydrodae::hydro
