#pragma once
/// SUNDIALS IDA (variable-order BDF, Hindmarsh et al., ACM TOMS 31 (2005) 363) with KLU on the
/// stabilised index-2 equations.

#include <memory>

#include "hydrodae/solve/statistics.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::solve {

struct IdaOptions {
  double rtol = 1e-5;    ///< tolerance in units of System::scale
  double end_time = 0.0; ///< [s]; no step goes beyond
  double max_step = 0.0; ///< [s]; 0: no limit
  int max_order = 5;
};

/// One integration. The system and the pattern must outlive it.
class Ida {
public:
  /// Starts at time `t0` from consistent y, y'. Throws SolverError when SUNDIALS refuses.
  Ida(const system::System& system, const system::Pattern& pattern, const IdaOptions& options,
      double t0, const VectorX& y, const VectorX& yp);
  ~Ida();
  Ida(const Ida&) = delete;
  Ida& operator=(const Ida&) = delete;

  /// Makes one internal step and returns the time reached. Throws SolverError with the time, the
  /// reason, and the unknowns and equations that are worst.
  double step();

  /// y and y' at a time inside the last step (BDF interpolant).
  void interpolate(double t, VectorX& y, VectorX& yp) const;

  Statistics statistics() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace hydrodae::solve
