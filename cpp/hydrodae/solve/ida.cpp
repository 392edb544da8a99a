#include "hydrodae/solve/ida.h"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::solve {

namespace {

constexpr int amd_ordering = 0; ///< of KLU; SUNDIALS' default COLAMD fills more on these patterns

void check(int flag, const char* call) {
  if (flag < 0)
    throw SolverError(0.0, std::string(call) + " failed with " + IDAGetReturnFlagName(flag));
}

template <class T> T* made(T* pointer, const char* call) {
  if (!pointer)
    throw SolverError(0.0, std::string(call) + " failed (out of memory?)");
  return pointer;
}

struct ContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct VectorDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct MatrixDeleter {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
struct SolverDeleter {
  void operator()(SUNLinearSolver l) const { SUNLinSolFree(l); }
};
struct IdaDeleter {
  void operator()(void* memory) const { IDAFree(&memory); }
};
template <class Handle, class Deleter>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Deleter>;

SUNContext make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) < 0)
    throw SolverError(0.0, "SUNContext_Create failed");
  return context;
}

/// "a (2.1), b (0.4)": the three largest entries of `values` by name.
std::string worst(const VectorX& values, const std::vector<std::string>& names) {
  std::vector<Index> order(names.size());
  std::iota(order.begin(), order.end(), Index{0});
  const std::size_t count = std::min<std::size_t>(3, order.size());
  auto size = [&](Index i) { return std::isfinite(values[i]) ? std::abs(values[i]) : HUGE_VAL; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](Index a, Index b) { return size(a) > size(b); });
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < count; ++k)
    parts.push_back(names[order[k]] + " (" + number_text(values[order[k]]) + ")");
  return joined(parts);
}

/// First step [s]: short enough for order 1 to meet the tolerance, sqrt(tolerance) of the shortest
/// time in which a body moves, or speeds up by, its own scale; long enough for multipliers, whose
/// rounding error grows as 1 / step. (IDA's own guess takes uniform motion for an error.)
double first_step(const system::System& s, double rtol, const VectorX& y, const VectorX& yp) {
  double time = INFINITY;
  for (const system::BodyData& b : s.bodies)
    for (int k = 0; k < b.n_active; ++k) {
      const Index u = b.u0 + k;
      const double size = b.active[k] < 3 ? b.length_scale : b.length_scale / b.lever;
      time = std::min({time, b.time_scale, size / std::max(std::abs(y[u]), 1e-300),
                       std::sqrt(size / std::max(std::abs(yp[u]), 1e-300))});
    }
  return 0.3 * std::sqrt(rtol) * time;
}

} // namespace

struct Ida::Impl {
  const system::System& system;
  const system::Pattern& pattern;
  double rtol;
  system::Workspace<double> workspace;
  system::JacobianWorkspace jacobian_workspace;
  system::JacobianParts parts;
  long residual_calls = 0, jacobian_calls = 0;
  double t = 0.0, end_time = 0.0;
  double first = 0.0;      ///< first step [s]
  double time_scale = 0.0; ///< longest of the bodies [s]
  long steps = 0;          ///< since `t_checked`
  double t_checked = 0;    ///< [s]

  Owned<SUNContext, ContextDeleter> context{make_context()};
  Owned<N_Vector, VectorDeleter> y, yp, id, scratch;
  Owned<SUNMatrix, MatrixDeleter> matrix;
  Owned<SUNLinearSolver, SolverDeleter> linear_solver;
  std::unique_ptr<void, IdaDeleter> memory; // freed before what it refers to

  Impl(const system::System& s, const system::Pattern& p, double tolerance)
      : system(s), pattern(p), rtol(tolerance), workspace(s), jacobian_workspace(s), parts(p) {}

  N_Vector new_vector() const {
    return made(N_VNew_Serial(system.n, context.get()), "N_VNew_Serial");
  }
  void start(const IdaOptions& options, double t0, const VectorX& y0, const VectorX& yp0);
  std::string diagnosis(int flag);
  void accept();
  void check_progress();

  static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* user);
  static int jacobian(double t, double alpha, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix j,
                      void* user, N_Vector, N_Vector, N_Vector);
  static int weights(N_Vector y, N_Vector w, void* user);
};

int Ida::Impl::residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* user) {
  Impl& self = *static_cast<Impl*>(user);
  ++self.residual_calls;
  double* out = N_VGetArrayPointer(r);
  system::residual<double>(self.system, self.workspace, t, N_VGetArrayPointer(y),
                           N_VGetArrayPointer(yp), out);
  // A value that is not finite is recoverable: IDA tries a shorter step.
  return std::isfinite(Eigen::Map<const VectorX>(out, self.system.n).sum()) ? 0 : 1;
}

int Ida::Impl::jacobian(double t, double alpha, N_Vector y, N_Vector yp, N_Vector, SUNMatrix j,
                        void* user, N_Vector, N_Vector, N_Vector) {
  Impl& self = *static_cast<Impl*>(user);
  ++self.jacobian_calls;
  system::jacobian(self.system, self.pattern, self.jacobian_workspace, t, N_VGetArrayPointer(y),
                   N_VGetArrayPointer(yp), self.parts);
  // IDA clears the indices together with the values before each call.
  const system::Pattern& p = self.pattern;
  std::copy(p.column_start.begin(), p.column_start.end(), SUNSparseMatrix_IndexPointers(j));
  std::copy(p.row.begin(), p.row.end(), SUNSparseMatrix_IndexValues(j));
  double* values = SUNSparseMatrix_Data(j);
  for (std::size_t k = 0; k < p.row.size(); ++k)
    values[k] = self.parts.by_y[k] + alpha * self.parts.by_yp[k];
  return 0;
}

// w_i = 1 / (rtol (scale_i + |y_i|)), without |y_i| for positions, whose origin means nothing. A
// multiplier is known no better than the velocities, whose rounding it feels divided by the step.
int Ida::Impl::weights(N_Vector y, N_Vector w, void* user) {
  Impl& self = *static_cast<Impl*>(user);
  const Eigen::Map<const VectorX> state(N_VGetArrayPointer(y), self.system.n);
  Eigen::Map<VectorX>(N_VGetArrayPointer(w), self.system.n) =
      (self.rtol * (self.system.scale.array() + self.system.relative.array() * state.array().abs()))
          .inverse();
  double step = 0.0;
  IDAGetCurrentStep(self.memory.get(), &step);
  if (step <= 0.0)
    step = self.first;
  const Index n = self.system.n - self.system.lambda0;
  const double rounding = 1e3 * std::numeric_limits<double>::epsilon() * self.time_scale / step;
  Eigen::Map<VectorX> all(N_VGetArrayPointer(w), self.system.n);
  all.tail(n) = all.tail(n).cwiseMin((rounding * self.system.scale.tail(n)).cwiseInverse());
  return 0;
}

void Ida::Impl::start(const IdaOptions& options, double t0, const VectorX& y0, const VectorX& yp0) {
  t = t_checked = t0;
  end_time = options.end_time;
  y.reset(new_vector());
  yp.reset(new_vector());
  id.reset(new_vector());
  scratch.reset(new_vector());
  std::copy(y0.begin(), y0.end(), N_VGetArrayPointer(y.get()));
  std::copy(yp0.begin(), yp0.end(), N_VGetArrayPointer(yp.get()));
  accept();
  for (Index i = 0; i < system.n; ++i)
    N_VGetArrayPointer(id.get())[i] = system.is_algebraic(i) ? 0.0 : 1.0;
  memory.reset(made(IDACreate(context.get()), "IDACreate"));
  void* ida = memory.get();
  check(IDASetErrHandlerFn(
            ida, [](int, const char*, const char*, char*, void*) {}, nullptr),
        "IDASetErrHandlerFn"); // our own messages say more
  check(IDAInit(ida, residual, t0, y.get(), yp.get()), "IDAInit");
  check(IDASetUserData(ida, this), "IDASetUserData");
  check(IDAWFtolerances(ida, weights), "IDAWFtolerances");
  check(IDASetId(ida, id.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, 1), "IDASetSuppressAlg");
  check(IDASetMaxOrd(ida, options.max_order), "IDASetMaxOrd");
  check(IDASetStopTime(ida, options.end_time), "IDASetStopTime");
  if (options.max_step > 0.0)
    check(IDASetMaxStep(ida, options.max_step), "IDASetMaxStep");
  const double longest = options.max_step > 0.0 ? options.max_step : options.end_time - t0;
  first = std::min(first_step(system, rtol, y0, yp0), longest);
  for (const system::BodyData& b : system.bodies)
    time_scale = std::max(time_scale, b.time_scale);
  check(IDASetInitStep(ida, first), "IDASetInitStep");
  matrix.reset(made(SUNSparseMatrix(system.n, system.n, pattern.nonzeros(), CSC_MAT, context.get()),
                    "SUNSparseMatrix"));
  linear_solver.reset(made(SUNLinSol_KLU(y.get(), matrix.get(), context.get()), "SUNLinSol_KLU"));
  check(SUNLinSol_KLUSetOrdering(linear_solver.get(), amd_ordering), "SUNLinSol_KLUSetOrdering");
  check(IDASetLinearSolver(ida, linear_solver.get(), matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(ida, jacobian), "IDASetJacFn");
}

/// What belongs to accepted steps moves on.
void Ida::Impl::accept() {
  if (system.motions.empty())
    return;
  system::accept_turns(system, N_VGetArrayPointer(y.get()), N_VGetArrayPointer(yp.get()),
                       workspace);
  jacobian_workspace.state.turns = workspace.turns;
}

/// Which unknowns failed the error test, and which equations Newton could not satisfy, at the point
/// that IDA tried last.
std::string Ida::Impl::diagnosis(int flag) {
  void* ida = memory.get();
  std::string text;
  VectorX values(system.n);
  if (flag == IDA_ERR_FAIL && IDAGetEstLocalErrors(ida, scratch.get()) == IDA_SUCCESS) {
    const Eigen::Map<const VectorX> error(N_VGetArrayPointer(scratch.get()), system.n);
    values = error.cwiseQuotient(rtol * system.scale);
    for (Index i = system.lambda0; i < system.n; ++i)
      values[i] = 0.0;
    text += "\n  largest local errors, in units of the tolerance: " + worst(values, system.names);
  }
  N_Vector y_now = nullptr, yp_now = nullptr;
  if (IDAGetCurrentY(ida, &y_now) == IDA_SUCCESS && IDAGetCurrentYp(ida, &yp_now) == IDA_SUCCESS) {
    system::residual<double>(system, workspace, t, N_VGetArrayPointer(y_now),
                             N_VGetArrayPointer(yp_now), values.data());
    text += "\n  worst equations, relative to their scale: " +
            worst(values.cwiseQuotient(system.row_scale), system.row_names);
    // A loop that locks shows in reactions that grow without bound.
    values.setZero();
    const Eigen::Map<const VectorX> state(N_VGetArrayPointer(y.get()), system.n);
    values.segment(system.lambda0, system.n_lambda) =
        state.segment(system.lambda0, system.n_lambda)
            .cwiseQuotient(system.scale.segment(system.lambda0, system.n_lambda));
    if (system.n_lambda > 0)
      text += "\n  largest reactions at the last good step, relative to the weights: " +
              worst(values, system.names);
  }
  return text;
}

/// Near a singular pose the steps can shrink without ever failing: a run that would take for ever
/// ends with that reason.
void Ida::Impl::check_progress() {
  constexpr long watch = 5000;
  constexpr double least = 1e-6; // of the whole run in so many steps, of a body's time in one
  if (++steps < watch)
    return;
  const double gained = t - t_checked;
  if (gained < least * end_time && gained < watch * least * time_scale && t < end_time)
    throw SolverError(t, "stopped at t = " + number_text(t) + " s: no progress, " +
                             std::to_string(watch) + " steps brought only " + number_text(gained) +
                             " s (a singular pose?)" + diagnosis(IDA_SUCCESS));
  steps = 0;
  t_checked = t;
}

Ida::Ida(const system::System& system, const system::Pattern& pattern, const IdaOptions& options,
         double t0, const VectorX& y, const VectorX& yp)
    : impl_(std::make_unique<Impl>(system, pattern, options.rtol)) {
  impl_->start(options, t0, y, yp);
}

Ida::~Ida() = default;

double Ida::step() {
  Impl& m = *impl_;
  const int flag = IDASolve(m.memory.get(), m.end_time, &m.t, m.y.get(), m.yp.get(), IDA_ONE_STEP);
  if (flag >= 0) {
    m.accept();
    m.check_progress();
    return m.t;
  }
  double h = 0.0;
  IDAGetCurrentStep(m.memory.get(), &h);
  static const std::pair<int, const char*> reasons[] = {
      {IDA_ERR_FAIL, "the local error stays too large however short the step"},
      {IDA_CONV_FAIL, "Newton's iteration does not converge however short the step"},
      {IDA_LSETUP_FAIL, "the Jacobian is singular"},
      {IDA_REP_RES_ERR, "the equations give values that are not finite"},
      {IDA_TOO_MUCH_ACC, "the tolerance is below what double precision can give"},
  };
  std::string reason = IDAGetReturnFlagName(flag);
  for (const auto& [code, words] : reasons)
    if (code == flag)
      reason = std::string(words) + " (" + reason + ")";
  throw SolverError(m.t, "stopped at t = " + number_text(m.t) + " s: " + reason + ", last step " +
                             number_text(h) + " s" + m.diagnosis(flag));
}

void Ida::interpolate(double t, VectorX& y, VectorX& yp) const {
  const Impl& m = *impl_;
  for (int derivative = 0; derivative < 2; ++derivative) {
    check(IDAGetDky(m.memory.get(), t, derivative, m.scratch.get()), "IDAGetDky");
    (derivative == 0 ? y : yp) =
        Eigen::Map<const VectorX>(N_VGetArrayPointer(m.scratch.get()), m.system.n);
  }
}

Statistics Ida::statistics() const {
  void* ida = impl_->memory.get();
  Statistics s;
  long unused_residuals = 0, setups = 0;
  int next_order = 0;
  double first_step = 0.0, next_step = 0.0, now = 0.0;
  check(IDAGetIntegratorStats(ida, &s.steps, &unused_residuals, &setups, &s.error_test_failures,
                              &s.last_order, &next_order, &first_step, &s.last_step, &next_step,
                              &now),
        "IDAGetIntegratorStats");
  check(IDAGetNonlinSolvStats(ida, &s.newton_iterations, &s.convergence_failures),
        "IDAGetNonlinSolvStats");
  s.residual_calls = impl_->residual_calls;
  s.jacobian_calls = impl_->jacobian_calls;
  return s;
}

} // namespace hydrodae::solve
