#pragma once
/// Excitation of one body as a sum over functions of its yaw.

#include <vector>

#include "hydrodae/hull/wet_surface.h"
#include "hydrodae/hydro/frequency.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/sea/component.h"
#include "hydrodae/system/system.h"
#include "hydrodae/water/excitation.h"

namespace hydrodae::build {

/// Pose in which a body meets the waves: at its start (or, if the phase moves with it, in the
/// reference pose), turned by its mean yaw or, if `yaws`, by any yaw.
struct Meeting {
  double yaw = 0.0; ///< [rad]
  bool yaws = false;
  /// Reference points of the phases [m]
  Vector3 point = Vector3::Zero(), database_point = Vector3::Zero();
};

/// How each hydrodynamic body meets the waves (sea.cpp).
std::vector<Meeting> meetings(const model::Scene& scene, const system::System& system);

/// Does the excitation of a body follow a yaw that changes: by itself, or by roll and pitch?
inline bool follows_yaw(const system::System& s, const system::HydroBody& hb) {
  return s.hydro.axes == system::HydroAxes::yaw &&
         (hb.moving[5] >= 0 || (hb.moving[3] >= 0 && hb.moving[4] >= 0));
}

/// Tables of the excitation. In axes that follow the yaw they include the headings that a symmetry
/// adds; `symmetry` describes it (empty: none).
hydro::Database wave_tables(const model::Scene& scene, const system::System& system,
                            std::string& symmetry);

/// Yaws at which the tables are evaluated, and the transform to coefficients of the yaw functions:
/// the discrete Fourier transform for all headings, the Chebyshev transform at its nodes for an
/// interval.
struct YawSamples {
  water::YawFunctions functions;
  VectorX yaws;      ///< (n,) [rad]
  MatrixX transform; ///< (functions.count, n)
};

/// Yaw samples. Tables with all headings allow any yaw, others the yaws that keep all components
/// within the table. The table must cover all components at the mean yaw.
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

/// Coefficients of the linear Froude-Krylov load on the mesh of a body in a pose. Subtracting it
/// from the excitation of a database leaves the diffraction, so that loads in small waves equal
/// those of the database (hulls.cpp).
Eigen::MatrixXcd mesh_coefficients(const model::Scene& scene, const hull::Mesh& mesh,
                                   const hull::Pose& body, const Meeting& meeting,
                                   const YawSamples& samples,
                                   const std::vector<sea::Component>& components);

/// Rows of `yaw_coefficients` above a tenth of the tables' noise for a symmetric body
/// (water/excitation.cpp); all rows if the yaw does not matter. `length`: ratio of moments to
/// forces [m].
std::vector<water::Excitation::Term> terms_that_matter(const Eigen::MatrixXcd& coefficients,
                                                       const water::YawFunctions& functions,
                                                       double length);

} // namespace hydrodae::build
