#include "hydrodae/integrate/ida_matrix.h"

#include <nvector/nvector_serial.h>

#include <algorithm>

namespace hydrodae::integrate {

namespace {

SUNMatrix_ID custom_matrix(SUNMatrix) { return SUNMATRIX_CUSTOM; }
int keep_matrix(SUNMatrix) { return 0; }

SUNLinearSolver_Type direct(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }

int factorise_matrix(SUNLinearSolver solver, SUNMatrix) {
  IdaMatrix& m = *static_cast<IdaMatrix*>(solver->content);
  constexpr bool careful = true; // one matrix serves many steps
  return m.newton.factorise(*m.parts, m.alpha, careful) ? 0 : SUNLS_LUFACT_FAIL;
}

int solve_matrix(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, double) {
  const double* given = N_VGetArrayPointer(b);
  std::copy(given, given + N_VGetLength(b), N_VGetArrayPointer(x));
  static_cast<IdaMatrix*>(solver->content)->newton.solve(N_VGetArrayPointer(x));
  return 0;
}

} // namespace

SUNMatrix make_ida_matrix(SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  if (!matrix)
    return nullptr;
  matrix->ops->getid = custom_matrix;
  matrix->ops->zero = keep_matrix; // the callback overwrites all entries
  matrix->ops->destroy = SUNMatFreeEmpty;
  return matrix;
}

SUNLinearSolver make_ida_solver(IdaMatrix& matrix, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  if (!solver)
    return nullptr;
  solver->content = &matrix;
  solver->ops->gettype = direct;
  solver->ops->setup = factorise_matrix;
  solver->ops->solve = solve_matrix;
  solver->ops->free = [](SUNLinearSolver s) -> int {
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  return solver;
}

} // namespace hydrodae::integrate
