#pragma once
/// The excitation of one body as a sum over functions of its yaw.

#include <vector>

#include "hydrodae/hull/wet_surface.h"
#include "hydrodae/hydro/frequency.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/sea/component.h"
#include "hydrodae/system/system.h"
#include "hydrodae/water/excitation.h"

namespace hydrodae::build {

/// How a body meets the waves: where it is at the start (or, when the phase moves with it, where it
/// is in the reference pose), turned by its mean yaw or, if `yaws`, by whatever its yaw is.
struct Meeting {
  double yaw = 0.0; ///< [rad]
  bool yaws = false;
  Vector3 point = Vector3::Zero(), database_point = Vector3::Zero(); ///< phases are about these [m]
};

/// How each hydrodynamic body meets the waves (sea.cpp).
std::vector<Meeting> meetings(const model::Scene& scene, const system::System& system);

/// Does the excitation of a body follow a yaw that changes: by itself, or by roll and pitch?
inline bool follows_yaw(const system::System& s, const system::HydroBody& hb) {
  return s.hydro.axes == system::HydroAxes::yaw &&
         (hb.moving[5] >= 0 || (hb.moving[3] >= 0 && hb.moving[4] >= 0));
}

/// The tables of the excitation: in axes that follow the yaw with headings that a symmetry adds. It
/// stands in `symmetry`, in words; empty: none.
hydro::Database wave_tables(const model::Scene& scene, const system::System& system,
                            std::string& symmetry);

/// Yaws at which the excitation is taken from the tables, and what makes of it the coefficients of
/// the functions of yaw: on the circle the discrete Fourier transform, for an interval that of
/// Chebyshev, at its nodes.
struct YawSamples {
  water::YawFunctions functions;
  VectorX yaws;      ///< (n,) [rad]
  MatrixX transform; ///< (functions.count, n)
};

/// Headings all round allow any yaw, others those which keep all components within the table. All
/// components must be covered at the mean yaw.
YawSamples yaw_samples(const hydro::Excitation& table, std::size_t first_label, const Meeting& body,
                       const std::vector<sea::Component>& components);

/// The same for any tables with these headings, whose phases turn with a lever [m] of the body.
YawSamples yaw_samples(const hydro::Headings& headings, double lever, const Meeting& body,
                       const std::vector<sea::Component>& components);

/// Coefficients of the functions of time that load a body: functions.count successive rows for each
/// of its six coordinates, (6 count, n_components), phase zero at the origin.
Eigen::MatrixXcd yaw_coefficients(const hydro::Excitation& table, std::size_t first_label,
                                  const Meeting& body, const YawSamples& samples,
                                  const std::vector<sea::Component>& components);

/// The same for the linear Froude-Krylov load on the mesh of a body in a pose: what leaves the
/// diffraction when it is taken from the excitation of a database, so that in small waves the loads
/// are those of the database (hulls.cpp).
Eigen::MatrixXcd mesh_coefficients(const model::Scene& scene, const hull::Mesh& mesh,
                                   const hull::Pose& body, const Meeting& meeting,
                                   const YawSamples& samples,
                                   const std::vector<sea::Component>& components);

/// Which rows of `yaw_coefficients` are more than a tenth of the noise that the tables have from
/// the symmetry of a body (water/excitation.cpp); all where the yaw does not matter. `length`:
/// what compares moments with forces [m].
std::vector<water::Excitation::Term> terms_that_matter(const Eigen::MatrixXcd& coefficients,
                                                       const water::YawFunctions& functions,
                                                       double length);

} // namespace hydrodae::build
