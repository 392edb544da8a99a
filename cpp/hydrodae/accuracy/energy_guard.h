#pragma once
/// The energy that the equations keep is a witness that the integrator does not look at: what is
/// missing shows a branch lost in a singular pose, or of a tolerance too loose.

#include <functional>

#include "hydrodae/measure/measure.h"
#include "hydrodae/core/solver_options.h"

namespace hydrodae::accuracy {

class EnergyGuard {
public:
  EnergyGuard(const system::Regime& system, const SolverOptions& options);

  /// Is less allowed at singular poses of closed loops than elsewhere?
  bool minds_singular_poses() const { return at_singular_ < part_; }

  /// Throws SolverError when the balance of the scene, or of one of its mechanisms, is off by more
  /// than is allowed.
  /// @param at_singular_pose asked only where it matters: was the last step next to such a pose?
  /// @param reactions the largest ones, for the message
  void check(double t, const measure::Measure& measure,
             const std::function<bool()>& at_singular_pose,
             const std::function<std::string()>& reactions) const;

  /// Energy below which an exchange is not judged: that of errors within the tolerance [J].
  double counts() const { return least(-1); }

  /// The same at the end of the run, with next to no energy too little to judge.
  void finish(double t, const measure::Measure& measure) const;

private:
  [[noreturn]] void fail(double t, double error, double part, double exchanged,
                         const std::string& of, const std::string& where, const std::string& advice,
                         const std::string& details) const;
  double least(int mechanism) const;
  double allowed(int mechanism) const;
  std::string members(std::size_t mechanism) const;

  const system::Regime& s_;
  double rtol_, part_, at_singular_;
  std::vector<bool> guided_; ///< by mechanism: joints and drives leave it no motion of its own
};

} // namespace hydrodae::accuracy
