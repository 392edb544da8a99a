#pragma once
/// Places of the bodies and lines of a scene at one sample, for the comparison of two runs.

#include <string>
#include <vector>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::accuracy {

/// Distance of a body or line between two states [m]: displacement of the centre of gravity, or the
/// largest of a node; and rotation of a body times its lever, the distance of its farthest joint or
/// the radius of gyration.
struct Apart {
  double moved = 0.0, turned = 0.0;
  double both() const { return std::max(moved, turned); }
  void widen(const Apart& other) {
    moved = std::max(moved, other.moved);
    turned = std::max(turned, other.turned);
  }
};

/// Moving parts of a scene: bodies, and lines with the places of their nodes.
class Movers {
public:
  explicit Movers(const system::Regime& system);

  std::size_t size() const { return all_.size(); }
  Index width() const { return n_places_; } ///< numbers of a sample
  const std::string& name(std::size_t mover) const { return all_[mover].name; }

  /// Group of a mover. Bodies connected by joints or loads, and each line, form a group: errors
  /// count relative to the largest motion of the group.
  std::size_t group(std::size_t mover) const { return all_[mover].group; }
  std::size_t n_groups() const { return n_groups_; }
  double lever(std::size_t mover) const { return all_[mover].lever; } ///< lever [m]; 0 for lines

  /// Writes the poses of the bodies (r, then R column by column) and places of the nodes at y
  /// (n_places,).
  void places(const VectorX& y, VectorX& out);

  Apart apart(std::size_t mover, const VectorX& a, const VectorX& b) const;

  /// Widens the motion of each group by its largest rotation about its joints, times the lever [m]:
  /// it counts full turns, which poses do not show.
  /// @param turns, start  coordinates of all motions now and at the start
  /// @param motion  (n_groups,) updated
  void widen(const std::vector<double>& turns, const std::vector<double>& start,
             std::vector<Apart>& motion) const;

private:
  struct Mover {
    std::string name;
    std::size_t group = 0;
    std::size_t body = 0;     ///< index in System::bodies, for movers without nodes
    double lever = 0.0;       ///< [m]
    Index first = 0;          ///< offset in `places`
    std::vector<Index> nodes; ///< offsets in y of the nodes of a line, from z0 on
  };
  struct Turning { ///< coordinate that is an angle
    std::size_t motion = 0, group = 0;
    double lever = 0.0;
  };
  const system::System& s_;
  std::vector<system::BodyState<double>> bodies_; ///< scratch
  std::vector<Mover> all_;
  std::vector<Turning> turning_;
  Index n_places_ = 0;
  std::size_t n_groups_ = 0;
};

} // namespace hydrodae::accuracy
