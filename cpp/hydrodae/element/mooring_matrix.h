#pragma once
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::element {

/// Mooring as a linear matrix about the reference pose of one body.
///
///   F = F0 - K xi - C [v; w]      xi = [r - r_ref; rotation vector of R R_ref^T], earth axes
///
/// F holds the force [N] and the moment about the centre of gravity [N m]. Beyond half a turn the
/// rotation vector continues about its present axis; a rotation without a fixed axis ends the run
/// there.
struct MooringMatrix {
  static constexpr std::string_view type = "mooring_matrix";
  static constexpr Port port = Port::on_body;
  static constexpr bool moors = true;
  static constexpr std::string_view doc =
      "Mooring as a linear matrix about the reference pose of a body: F = F0 - K xi - C v.";
  std::string name;
  std::string body;
  Matrix6 stiffness = Matrix6::Zero();
  Matrix6 damping = Matrix6::Zero();
  Vector6 pretension = Vector6::Zero();

  /// Law to evaluate.
  LinearWrench law() const { return {pretension, stiffness, damping}; }

  template <class M = MooringMatrix> static Fields<M> fields() {
    return {
        {"name", &M::name, "-", "Name of this force in the results.", true},
        {"body", &M::body, "-", "Body that is moored.", true},
        {"stiffness", &M::stiffness, "N/m, N, N m",
         "K: six numbers (diagonal: surge, sway, heave, roll, pitch, yaw) or a 6x6 matrix.", true},
        {"damping", &M::damping, "N s/m, N s, N m s", "C: six numbers (diagonal) or a 6x6 matrix."},
        {"pretension", &M::pretension, "N, N m", "F0: force and moment in the reference pose."},
    };
  }
};

} // namespace hydrodae::element
