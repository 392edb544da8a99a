#pragma once
/// The motion of a run against that of a second one, which is made with a smaller tolerance or
/// step.

#include <string>
#include <vector>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::solve {

/// Poses of the bodies that move and places of the nodes of lines, sample by sample, and how far
/// another run is from them.
class Verification {
public:
  explicit Verification(const system::Regime& system);

  /// Of the run that is to be verified: the next sample.
  void keep(double time, const std::vector<system::BodyState<double>>& bodies, const VectorX& y);

  /// Of the other run: the next sample. Displacements count over the levers of the bodies or the
  /// segments of lines, turns as angles; by group of bodies, and line by line.
  void compare(const std::vector<system::BodyState<double>>& bodies, const VectorX& y);

  struct Difference {
    double error = 0.0; ///< relative to the largest motion of the group [-]
    std::string block;  ///< a body or a line
    double time = 0.0;  ///< [s]
  };
  Difference largest() const;

private:
  struct Body {
    std::size_t index;
    int group;
    double lever;
    std::string name;
  };
  struct Pose {
    Vector3 r;
    Matrix3 R;
  };
  static double apart(const Body& body, const Pose& a, const Pose& b);
  double apart(const system::StateBlock& line, const VectorX& a, const VectorX& b) const;
  const system::StateBlock& states_of(const system::Block& line) const {
    return s_.states[static_cast<std::size_t>(line.states)];
  }
  VectorX states_of(const VectorX& y) const { return y.segment(s_.z0, s_.n_z); }

  const system::System& s_;
  std::vector<const system::Block*> lines_;
  std::vector<Body> bodies_;
  std::vector<double> times_;
  std::vector<Pose> poses_;             ///< all bodies of a sample after each other
  std::vector<VectorX> states_;         ///< z of a sample; none where there is no line
  std::size_t next_ = 0;                ///< sample to compare
  std::vector<double> motion_;          ///< by group
  std::vector<Difference> differences_; ///< by group, not relative yet
};

} // namespace hydrodae::solve
