#include "hydrodae/integrate/ida.h"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/integrate/ida_matrix.h"
#include "hydrodae/linalg/equations.h"

namespace hydrodae::integrate {

namespace {

/// Part of the requested tolerance. The accumulated error of the many BDF steps is then at most
/// that of one-step methods at equal rtol (measured on spinning and striking bodies).
constexpr double share = 0.5;

/// Name of a SUNDIALS flag; SUNDIALS allocates the string.
std::string flag_name(int flag) {
  const std::unique_ptr<char, decltype(&std::free)> name(IDAGetReturnFlagName(flag), &std::free);
  return name.get();
}

void check(int flag, const char* call) {
  if (flag < 0)
    throw SolverError(0.0, {Reason::solver, std::string(call) + " failed with " + flag_name(flag)});
}

template <class T> T* made(T* pointer, const char* call) {
  if (!pointer)
    throw SolverError(0.0, {Reason::solver, std::string(call) + " failed (out of memory?)"});
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

/// Context without an error handler: the messages here contain more.
SUNContext make_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR < 7
  const int failed = SUNContext_Create(nullptr, &context);
#else // one handler for all objects of a context; in version 6 each solver has its own
  const int failed =
      SUNContext_Create(SUN_COMM_NULL, &context) || SUNContext_ClearErrHandlers(context);
#endif
  if (failed)
    throw SolverError(0.0, {Reason::solver, "SUNContext_Create failed"});
  return context;
}

/// Norm in place of that of SUNDIALS over unknowns with positive `id`: `id` numbers the groups of
/// bodies, and the norm is the largest one of a group.
double norm_by_group(N_Vector x, N_Vector w, N_Vector id) {
  thread_local std::vector<double> sums, counts;
  sums.assign(sums.size(), 0.0);
  counts.assign(counts.size(), 0.0);
  const double *values = N_VGetArrayPointer(x), *weights = N_VGetArrayPointer(w),
               *groups = N_VGetArrayPointer(id);
  for (sunindextype i = 0; i < N_VGetLength(x); ++i) {
    if (groups[i] <= 0.0)
      continue;
    const auto group = static_cast<std::size_t>(groups[i]);
    if (group >= sums.size()) {
      sums.resize(group + 1, 0.0);
      counts.resize(group + 1, 0.0);
    }
    const double value = values[i] * weights[i];
    sums[group] += value * value;
    counts[group] += 1.0;
  }
  double largest = 0.0;
  for (std::size_t group = 0; group < sums.size(); ++group) {
    if (!std::isfinite(sums[group]))
      return sums[group];
    largest = std::max(largest, sums[group] / std::max(counts[group], 1.0));
  }
  return std::sqrt(largest);
}

class Ida : public Integrator {
public:
  Ida(const system::Regime& s, const system::Pattern& p, const SolverOptions& options, double t0,
      const VectorX& y0, const VectorX& yp0)
      : system(s), pattern(linalg::condensed(s, p)), rtol(share * options.rtol),
        equations(s, pattern, rtol), newton{{s, pattern}}, good(y0), good_rate(yp0), t_good(t0),
        now(y0), now_rate(yp0), out(s.n), lost(y0), lost_rate(yp0), t_(t0),
        end_time(options.end_time), time_scale(equations.time_scale()),
        guard(t0, end_time, time_scale) {
    start(options, y0, yp0);
  }
  double step(double end, double bound) override;
  bool restart(double t, const VectorX& y0, const VectorX& yp0) override;
  void interpolate(double t, VectorX& y, VectorX& yp) override;
  int degree() const override { return counts().last_order; }
  linalg::Statistics statistics() const override;
  Memory state() const override { return BdfState{rounding, restarts, guard.state()}; }
  void set(const Memory& state) override {
    const auto& from = memory_of<BdfState>(state);
    rounding = from.rounding;
    restarts = from.restarts;
    guard.set(from.guard);
  }

private:
  const system::Regime& system;
  const system::Pattern pattern; ///< pattern of Newton's matrix
  double rtol;
  linalg::Equations equations;
  IdaMatrix newton;
  VectorX good, good_rate; ///< y, y' at the last accepted step
  double t_good = 0.0;
  int restarts = 0;
  linalg::Statistics before;  ///< statistics of earlier starts
  VectorX now, now_rate, out; ///< copies for functions that take Eigen vectors
  VectorX lost, lost_rate;    ///< point where the residual last was not a number
  double lost_time = -INFINITY;
  double t_ = 0.0, end_time = 0.0;
  double first = 0.0;        ///< first step [s]
  double longest = INFINITY; ///< longest step [s]
  double time_scale = 0.0;   ///< longest time scale of the bodies [s]
  double rounding = 1e3;     ///< rounding of the multipliers, in units of the machine epsilon
  linalg::ProgressGuard guard;

  Owned<SUNContext, ContextDeleter> context{make_context()};
  Owned<N_Vector, VectorDeleter> y, yp, id, scratch;
  Owned<SUNMatrix, MatrixDeleter> matrix;
  Owned<SUNLinearSolver, SolverDeleter> linear_solver;
  std::unique_ptr<void, IdaDeleter> memory; // freed before the objects it refers to

  N_Vector new_vector() const {
    N_Vector v = made(N_VNew_Serial(system.n, context.get()), "N_VNew_Serial");
    if (system.n_error_groups() != 1)
      v->ops->nvwrmsnormmask = norm_by_group; // clones inherit it
    // nothing can move: the norm of SUNDIALS would be 0 / 0
    if (system.n == 0)
      v->ops->nvwrmsnorm = [](N_Vector, N_Vector) { return 0.0; };
    return v;
  }
  void start(const SolverOptions& options, const VectorX& y0, const VectorX& yp0);
  std::string diagnosis(int flag);
  void accept();
  bool try_again();
  void begin_anew(const VectorX& y0, const VectorX& yp0);
  linalg::Statistics counts() const;

  static int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* user);
  static int jacobian(double t, double alpha, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix j,
                      void* user, N_Vector, N_Vector, N_Vector);
  static int weights(N_Vector y, N_Vector w, void* user);
};

Eigen::Map<const VectorX> view(N_Vector v, Index n) { return {N_VGetArrayPointer(v), n}; }

int Ida::residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* user) {
  Ida& self = *static_cast<Ida*>(user);
  self.now = view(y, self.system.n);
  self.now_rate = view(yp, self.system.n);
  const bool finite = self.equations.residual(t, self.now, self.now_rate, self.out);
  if (!finite) {
    self.lost = self.now;
    self.lost_rate = self.now_rate;
    self.lost_time = t;
  }
  std::copy(self.out.begin(), self.out.end(), N_VGetArrayPointer(r));
  return finite ? 0 : 1; // recoverable: IDA tries a shorter step
}

int Ida::jacobian(double t, double alpha, N_Vector y, N_Vector yp, N_Vector, SUNMatrix, void* user,
                  N_Vector, N_Vector, N_Vector) {
  Ida& self = *static_cast<Ida*>(user);
  self.now = view(y, self.system.n);
  self.now_rate = view(yp, self.system.n);
  self.equations.jacobian(t, self.now, self.now_rate);
  self.newton.parts = &self.equations.parts;
  self.newton.alpha = alpha;
  return 0;
}

// Weights w_i = 1 / (rtol (scale_i + |y_i|)), without |y_i| for positions, whose origin is
// arbitrary. A multiplier is no more exact than the rounding of the velocities divided by the step.
int Ida::weights(N_Vector y, N_Vector w, void* user) {
  Ida& self = *static_cast<Ida*>(user);
  const Eigen::Map<const VectorX> state(N_VGetArrayPointer(y), self.system.n);
  Eigen::Map<VectorX>(N_VGetArrayPointer(w), self.system.n) =
      (self.rtol * (self.system.scale.array() + self.system.relative.array() * state.array().abs()))
          .inverse();
  double step = 0.0;
  IDAGetCurrentStep(self.memory.get(), &step);
  if (step <= 0.0)
    step = self.first;
  const Index n = self.system.n - self.system.lambda0;
  const double rounding =
      self.rounding * std::numeric_limits<double>::epsilon() * self.time_scale / step;
  Eigen::Map<VectorX> all(N_VGetArrayPointer(w), self.system.n);
  all.tail(n) = all.tail(n).cwiseMin((rounding * self.system.scale.tail(n)).cwiseInverse());
  return 0;
}

void Ida::start(const SolverOptions& options, const VectorX& y0, const VectorX& yp0) {
  y.reset(new_vector());
  yp.reset(new_vector());
  id.reset(new_vector());
  scratch.reset(new_vector());
  std::copy(y0.begin(), y0.end(), N_VGetArrayPointer(y.get()));
  std::copy(yp0.begin(), yp0.end(), N_VGetArrayPointer(yp.get()));
  accept();
  for (Index i = 0; i < system.n; ++i)
    N_VGetArrayPointer(id.get())[i] =
        system.is_algebraic(i) || (system.formulation == system::Formulation::index_3 &&
                                   i >= system.u0 && i < system.z0)
            ? 0.0 // in index 3 the velocities behave like multipliers
            : 1.0 + system.error_group[static_cast<std::size_t>(i)];
  memory.reset(made(IDACreate(context.get()), "IDACreate"));
  void* ida = memory.get();
#if SUNDIALS_VERSION_MAJOR < 7
  const auto silent = [](int, const char*, const char*, char*, void*) {};
  check(IDASetErrHandlerFn(ida, silent, nullptr), "IDASetErrHandlerFn");
#endif
  check(IDAInit(ida, residual, t_, y.get(), yp.get()), "IDAInit");
  check(IDASetUserData(ida, this), "IDASetUserData");
  check(IDAWFtolerances(ida, weights), "IDAWFtolerances");
  check(IDASetId(ida, id.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, 1), "IDASetSuppressAlg");
  check(IDASetMaxOrd(ida, options.max_order), "IDASetMaxOrd");
  check(IDASetStopTime(ida, options.end_time), "IDASetStopTime");
  if (options.max_step > 0.0)
    check(IDASetMaxStep(ida, options.max_step), "IDASetMaxStep");
  if (options.max_step > 0.0)
    longest = options.max_step;
  first = std::min(
      {linalg::first_step(equations.system, equations.rtol, y0, yp0), end_time - t_, longest});
  check(IDASetInitStep(ida, first), "IDASetInitStep");
  matrix.reset(made(make_ida_matrix(context.get()), "SUNMatNewEmpty"));
  linear_solver.reset(made(make_ida_solver(newton, context.get()), "SUNLinSolNewEmpty"));
  check(IDASetLinearSolver(ida, linear_solver.get(), matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(ida, jacobian), "IDASetJacFn");
}

/// Updates the data of accepted steps.
void Ida::accept() {
  now = view(y.get(), system.n);
  now_rate = view(yp.get(), system.n);
  equations.accept(t_, now, now_rate);
}

/// Message with the unknowns that failed the error test, and the equations that Newton could not
/// solve, at the last point that IDA tried.
std::string Ida::diagnosis(int flag) {
  void* ida = memory.get();
  std::string text;
  VectorX values(system.n);
  if (flag == IDA_ERR_FAIL && IDAGetEstLocalErrors(ida, scratch.get()) == IDA_SUCCESS) {
    const Eigen::Map<const VectorX> error(N_VGetArrayPointer(scratch.get()), system.n);
    values = error.cwiseQuotient(rtol * system.scale);
    for (Index i = system.lambda0; i < system.n; ++i)
      values[i] = 0.0;
    text += "\n  largest local errors, in units of the tolerance: " +
            linalg::worst(values, system.names);
  }
  N_Vector y_now = nullptr, yp_now = nullptr;
  if (IDAGetCurrentY(ida, &y_now) == IDA_SUCCESS && IDAGetCurrentYp(ida, &yp_now) == IDA_SUCCESS) {
    now = view(y_now, system.n);
    now_rate = view(yp_now, system.n);
    now.segment(system.lambda0, system.n_lambda) =
        view(y.get(), system.n).segment(system.lambda0, system.n_lambda);
    if (lost_time >= t_ - 1e-6 * time_scale) // the diagnosis uses the last evaluated point
      equations.residual(lost_time, lost, lost_rate, out);
    text += equations.diagnosis(t_, now, now_rate);
  }
  return text;
}

/// Restarts from the last good point with weaker weights of the multipliers, by factors of 10 up to
/// 1e6 epsilon. In ill-conditioned loops their rounding is larger than expected, and Newton cannot
/// reach the weights. The motion keeps its tolerance.
bool Ida::try_again() {
  constexpr double most = 1e6;
  if (rounding >= most)
    return false;
  rounding *= 10.0;
  ++restarts;
  t_ = t_good;
  begin_anew(good, good_rate);
  return true;
}

/// Restarts at order 1 from t_.
void Ida::begin_anew(const VectorX& y0, const VectorX& yp0) {
  std::copy(y0.begin(), y0.end(), N_VGetArrayPointer(y.get()));
  std::copy(yp0.begin(), yp0.end(), N_VGetArrayPointer(yp.get()));
  before += counts();
  first = std::min(
      {linalg::first_step(equations.system, equations.rtol, y0, yp0), end_time - t_, longest});
  check(IDAReInit(memory.get(), t_, y.get(), yp.get()), "IDAReInit");
  check(IDASetInitStep(memory.get(), first), "IDASetInitStep");
}

bool Ida::restart(double t, const VectorX& y0, const VectorX& yp0) {
  t_ = t_good = t;
  good = y0;
  good_rate = yp0;
  begin_anew(good, good_rate);
  accept();
  return true;
}

double Ida::step(double end, double bound) {
  check(IDASetStopTime(memory.get(), std::min(bound, end)), "IDASetStopTime");
  int flag = IDASolve(memory.get(), end_time, &t_, y.get(), yp.get(), IDA_ONE_STEP);
  while (flag == IDA_CONV_FAIL && try_again())
    flag = IDASolve(memory.get(), end_time, &t_, y.get(), yp.get(), IDA_ONE_STEP);
  if (flag >= 0) {
    good = view(y.get(), system.n);
    good_rate = view(yp.get(), system.n);
    t_good = t_;
    accept();
    guard.after_step(t_, [&] { return diagnosis(IDA_SUCCESS); });
    return t_;
  }
  double h = 0.0;
  IDAGetCurrentStep(memory.get(), &h);
  static const std::tuple<int, Reason, const char*> reasons[] = {
      {IDA_ERR_FAIL, Reason::step, "the local error stays too large however short the step"},
      {IDA_CONV_FAIL, Reason::step, "Newton's iteration does not converge however short the step"},
      {IDA_LSETUP_FAIL, Reason::jacobian, "the Jacobian is singular"},
      {IDA_REP_RES_ERR, Reason::not_finite, "the equations give values that are not finite"},
      {IDA_TOO_MUCH_ACC, Reason::step, "the tolerance is below what double precision can give"},
  };
  Halt halt{Reason::solver, flag_name(flag), "", {{"step", h}}, "", diagnosis(flag)};
  for (const auto& [code, reason, words] : reasons)
    if (code == flag) {
      halt.reason = reason;
      halt.what = std::string(words) + " (" + halt.what + ")";
    }
  halt.what += ", last step " + number_text(h) + " s";
  throw SolverError(t_, std::move(halt));
}

void Ida::interpolate(double t, VectorX& y_out, VectorX& yp_out) {
  if (t == t_good && t_ == t_good) {
    y_out = good;
    yp_out = good_rate;
    return;
  }
  for (int derivative = 0; derivative < 2; ++derivative) {
    check(IDAGetDky(memory.get(), t, derivative, scratch.get()), "IDAGetDky");
    (derivative == 0 ? y_out : yp_out) = view(scratch.get(), system.n);
  }
}

/// Statistics since the last start.
linalg::Statistics Ida::counts() const {
  void* ida = memory.get();
  linalg::Statistics s;
  long unused_residuals = 0, setups = 0;
  int next_order = 0;
  double first_step = 0.0, next_step = 0.0, time = 0.0;
  check(IDAGetIntegratorStats(ida, &s.steps, &unused_residuals, &setups, &s.error_test_failures,
                              &s.last_order, &next_order, &first_step, &s.last_step, &next_step,
                              &time),
        "IDAGetIntegratorStats");
  check(IDAGetNonlinSolvStats(ida, &s.newton_iterations, &s.convergence_failures),
        "IDAGetNonlinSolvStats");
  return s;
}

linalg::Statistics Ida::statistics() const {
  linalg::Statistics s = counts();
  s += before;
  s.residual_calls = equations.statistics.residual_calls;
  s.jacobian_calls = equations.statistics.jacobian_calls;
  return s;
}

} // namespace

std::unique_ptr<Integrator> make_ida(const system::Regime& system, const system::Pattern& pattern,
                                     const SolverOptions& options, double t0, const VectorX& y,
                                     const VectorX& yp) {
  return std::make_unique<Ida>(system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::integrate
