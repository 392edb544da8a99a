/// Names of unknowns and equations, as a person reads them in messages.

#include "hydrodae/system/build_parts.h"

namespace hydrodae::system {

void set_names(System& s) {
  static const std::array<std::string, 6> position = {"position x", "position y",  "position z",
                                                      "roll angle", "pitch angle", "yaw angle"};
  static const std::array<std::string, 6> velocity = {"velocity x",         "velocity y",
                                                      "velocity z",         "angular velocity x",
                                                      "angular velocity y", "angular velocity z"};
  static const std::array<std::string, 6> load = {"force x",  "force y",  "force z",
                                                  "moment x", "moment y", "moment z"};
  static const std::array<std::string, 4> quaternion = {"quaternion w", "quaternion x",
                                                        "quaternion y", "quaternion z"};
  static const std::array<std::string, 3> axis = {"x", "y", "z"};
  s.names.assign(s.n, "");
  s.row_names.assign(s.n, "");
  for (const BodyData& b : s.bodies) {
    const std::string head = "bodies/" + b.name + " ";
    for (int k = 0; k < b.n_active; ++k) {
      s.names[b.u0 + k] = head + velocity[b.active[k]];
      s.row_names[b.u0 + k] = head + load[b.active[k]] + " balance";
    }
    for (int k = 0; k < b.n_position; ++k) {
      const bool quaternions = k >= b.n_translations && b.rotation == BodyData::Rotation::free;
      s.names[b.q0 + k] =
          head + (quaternions ? quaternion[k - b.n_translations] : position[b.active[k]]);
      s.row_names[b.q0 + k] = s.names[b.q0 + k] + " rate";
    }
    if (b.sigma >= 0) {
      s.names[b.sigma] = head + "quaternion norm multiplier";
      s.row_names[b.sigma] = head + "quaternion norm";
    }
  }
  for (const JointData& j : s.joints)
    for (const RowData& row : j.rows) {
      const bool turns = row.kind.kind == joint::BasicRow::Kind::perp;
      const std::string kind = turns ? "axes " + axis[row.kind.i] + "-" + axis[row.kind.j]
                                     : "gap along " + axis[row.kind.i];
      const std::string head = "joints/" + j.name + " ";
      s.names[row.lambda] = head + "reaction (" + kind + ")";
      s.names[row.mu] = head + "position multiplier (" + kind + ")";
      s.row_names[row.lambda] = head + kind + ", velocity";
      s.row_names[row.mu] = head + kind;
    }
  for (Index k = 0; k < s.n_z; ++k) {
    s.names[s.z0 + k] = "radiation memory state " + std::to_string(k);
    s.row_names[s.z0 + k] = s.names[s.z0 + k] + " rate";
  }
}

} // namespace hydrodae::system
