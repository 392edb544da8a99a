/// Names of unknowns and equations in messages.

#include "hydrodae/system/names.h"

namespace hydrodae::system {

void set_names(Regime& s) {
  static const std::array<std::string, 6> position = {"position x", "position y",  "position z",
                                                      "roll angle", "pitch angle", "yaw angle"};
  static const std::array<std::string, 6> velocity = {"velocity x",         "velocity y",
                                                      "velocity z",         "angular velocity x",
                                                      "angular velocity y", "angular velocity z"};
  static const std::array<std::string, 6> load = {"force x",  "force y",  "force z",
                                                  "moment x", "moment y", "moment z"};
  static const std::array<std::string, 4> quaternion = {"quaternion w", "quaternion x",
                                                        "quaternion y", "quaternion z"};
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
    if (s.sigma(b) >= 0) {
      s.names[s.sigma(b)] = head + "quaternion norm multiplier";
      s.row_names[s.sigma(b)] = head + "quaternion norm";
    }
  }
  for (const JointData& j : s.joints)
    for (const RowData& row : j.rows) {
      if (!s.holds(row))
        continue;
      const std::string head = "joints/" + j.name + " ", kind = joint::row_name(row.kind);
      s.names[s.lambda(row)] = head + "reaction (" + kind + ")";
      s.names[s.mu(row)] = head + "position multiplier (" + kind + ")";
      s.row_names[s.lambda(row)] = head + kind + ", velocity";
      s.row_names[s.mu(row)] = head + kind;
    }
  for (const CouplerData& c : s.couplers) {
    if (!s.holds(c))
      continue;
    const std::string head = "constraints/" + c.name;
    s.names[s.lambda(c)] = head + " reaction";
    s.row_names[s.lambda(c)] = head + ", velocity";
    if (c.velocity_level)
      continue;
    s.names[s.mu(c)] = head + " position multiplier";
    s.row_names[s.mu(c)] = head;
  }
  for (const StateBlock& block : s.states) {
    Index z = block.first;
    for (const element::Unknown& u : block.unknowns) {
      s.names[z] = block.path + " " + u.name;
      s.row_names[z] = s.names[z] + " rate";
      ++z;
    }
  }
}

} // namespace hydrodae::system
