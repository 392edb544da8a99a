#pragma once
/// Adapter of NewtonMatrix for IDA: a custom matrix and a direct solver.

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "hydrodae/linalg/newton_matrix.h"

namespace hydrodae::integrate {

/// Matrix whose Jacobian callback sets the parts and alpha; the solver factorises and solves.
struct IdaMatrix {
  linalg::NewtonMatrix<double> newton;
  const system::JacobianParts* parts = nullptr;
  double alpha = 0.0;
};

/// Null if memory is exhausted.
SUNMatrix make_ida_matrix(SUNContext context);
SUNLinearSolver make_ida_solver(IdaMatrix& matrix, SUNContext context);

} // namespace hydrodae::integrate
