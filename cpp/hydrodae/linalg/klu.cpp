#include "hydrodae/linalg/klu.h"

#include <klu.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "hydrodae/core/error.h"

namespace hydrodae::linalg {

namespace {

constexpr double bad_pivots = 1e-8; ///< reciprocal pivot growth below which new pivots are chosen
// Operations of a factorisation, in total and for each unknown, above which another order is tried.
constexpr double many = 1e5, many_each = 1e3;
/// Reciprocal condition below which `careful` chooses new pivots
constexpr double ill_conditioned = 3.7e-11;

template <class Scalar> constexpr bool is_real = std::is_same_v<Scalar, double>;

double* raw(std::vector<double>& v) { return v.data(); }
double* raw(std::vector<std::complex<double>>& v) { return reinterpret_cast<double*>(v.data()); }

} // namespace

template <class Scalar> struct SparseLu<Scalar>::Impl {
  klu_l_common common{};
  std::vector<SuiteSparse_long> start, row;
  std::vector<Scalar> values;
  std::vector<Scalar> scaled; ///< values times `factor`, row by row
  std::vector<double> factor; ///< row factors, powers of two without rounding errors
  klu_l_symbolic* symbolic = nullptr;
  klu_l_numeric* numeric = nullptr;

  bool chosen = false; ///< true: the order of the unknowns is final
  ~Impl() {
    drop();
    klu_l_free_symbolic(&symbolic, &common);
  }
  SuiteSparse_long size() const { return static_cast<SuiteSparse_long>(start.size()) - 1; }
  void drop() {
    if constexpr (is_real<Scalar>)
      klu_l_free_numeric(&numeric, &common);
    else
      klu_zl_free_numeric(&numeric, &common);
  }
  double growth() {
    const int ok = is_real<Scalar>
                       ? static_cast<int>(klu_l_rgrowth(start.data(), row.data(), raw(scaled),
                                                        symbolic, numeric, &common))
                       : static_cast<int>(klu_zl_rgrowth(start.data(), row.data(), raw(scaled),
                                                         symbolic, numeric, &common));
    return ok ? common.rgrowth : 0.0;
  }
  /// Returns whether the matrix is ill-conditioned: by a cheap bound, and if that is low by a
  /// better estimate.
  bool ill() {
    if constexpr (is_real<Scalar>) {
      klu_l_rcond(symbolic, numeric, &common);
      if (common.rcond >= ill_conditioned)
        return false;
      klu_l_condest(start.data(), raw(scaled), symbolic, numeric, &common);
      return !(common.condest <= 1.0 / ill_conditioned);
    }
    return false;
  }
  /// Scales rows by their largest entry at the last choice of pivots. A division by the largest
  /// entry of each new matrix would take most of the time besides the factorisation.
  void find_scale() {
    std::vector<double> largest(static_cast<std::size_t>(size()), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k) {
      double& of_row = largest[static_cast<std::size_t>(row[k])];
      of_row = std::max(of_row, std::abs(values[k]));
    }
    factor.resize(largest.size());
    for (std::size_t i = 0; i < largest.size(); ++i)
      factor[i] = largest[i] > 0.0 ? std::exp2(-std::round(std::log2(largest[i]))) : 1.0;
  }
  /// Scales the values; returns false if one is not finite.
  bool scale() {
    constexpr double largest = std::numeric_limits<double>::max();
    int bad = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      scaled[k] = factor[static_cast<std::size_t>(row[k])] * values[k];
      bad |= static_cast<int>(!(std::abs(std::real(values[k])) <= largest)) |
             static_cast<int>(!(std::abs(std::imag(values[k])) <= largest));
    }
    return bad == 0;
  }
  bool refactorise() {
    if (!scale())
      return false;
    return is_real<Scalar>
               ? klu_l_refactor(start.data(), row.data(), raw(scaled), symbolic, numeric, &common)
               : klu_zl_refactor(start.data(), row.data(), raw(scaled), symbolic, numeric, &common);
  }
  bool factorise(bool careful) {
    if (numeric) {
      if (careful)
        find_scale();
      if (refactorise() && growth() > bad_pivots && !(careful && ill()))
        return true;
    }
    drop();
    find_scale();
    if (!scale() || !find_pivots())
      return false;
    choose_order();
    return true;
  }
  bool find_pivots() {
    numeric = is_real<Scalar>
                  ? klu_l_factor(start.data(), row.data(), raw(scaled), symbolic, &common)
                  : klu_zl_factor(start.data(), row.data(), raw(scaled), symbolic, &common);
    return numeric && common.status == KLU_OK;
  }
  double flops() {
    if constexpr (is_real<Scalar>)
      klu_l_flops(symbolic, numeric, &common);
    else
      klu_zl_flops(symbolic, numeric, &common);
    return common.flops;
  }
  /// Chooses the order. The first one is that of a matrix with rows matched to columns, which suits
  /// chains. If it has much fill-in, the order of the unmatched matrix is tried, which suits bodies
  /// coupled by the water.
  void choose_order() {
    if (chosen)
      return;
    chosen = true;
    const double first = flops();
    // chains have little fill-in
    if (first < std::max(many, many_each * static_cast<double>(size())))
      return;
    const klu_l_common usual = common;
    klu_l_symbolic* const old_symbolic = symbolic;
    klu_l_numeric* const old_numeric = numeric;
    common.btf = 0;
    common.tol = 0.1; // rejects small diagonal entries without a match
    symbolic = klu_l_analyze(size(), start.data(), row.data(), &common);
    numeric = nullptr;
    const bool better = symbolic && find_pivots() && flops() < 0.9 * first;
    klu_l_symbolic* symbolic_left = better ? old_symbolic : symbolic;
    klu_l_numeric* numeric_left = better ? old_numeric : numeric;
    if (numeric_left) {
      if constexpr (is_real<Scalar>)
        klu_l_free_numeric(&numeric_left, &common);
      else
        klu_zl_free_numeric(&numeric_left, &common);
    }
    klu_l_free_symbolic(&symbolic_left, &common);
    if (!better) {
      symbolic = old_symbolic;
      numeric = old_numeric;
      common = usual;
    }
  }
};

template <class Scalar>
SparseLu<Scalar>::SparseLu(const std::vector<Index>& column_start, const std::vector<Index>& row)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  klu_l_defaults(&m.common);
  m.common.ordering = 0; // AMD: COLAMD has more fill-in on these patterns
  m.common.scale = -1;   // see Impl::find_scale
  m.start.assign(column_start.begin(), column_start.end());
  m.row.assign(row.begin(), row.end());
  m.values.resize(row.size());
  m.scaled.resize(row.size());
  const SuiteSparse_long n = m.size();
  if (n == 0) // nothing can move
    return;
  m.symbolic = klu_l_analyze(n, m.start.data(), m.row.data(), &m.common);
  if (!m.symbolic)
    throw SolverError(0.0, {Reason::jacobian,
                            "KLU cannot order the unknowns: the equations are structurally "
                            "singular or too large for the memory"});
}

template <class Scalar> SparseLu<Scalar>::~SparseLu() = default;
template <class Scalar> SparseLu<Scalar>::SparseLu(SparseLu&&) noexcept = default;

template <class Scalar> std::vector<Scalar>& SparseLu<Scalar>::values() { return impl_->values; }

template <class Scalar> bool SparseLu<Scalar>::factorise(bool careful) {
  return impl_->size() == 0 || impl_->factorise(careful);
}

template <class Scalar> bool SparseLu<Scalar>::refactorise() {
  return impl_->numeric && impl_->refactorise();
}

template <class Scalar> void SparseLu<Scalar>::solve(Scalar* b) {
  Impl& m = *impl_;
  if (m.size() == 0)
    return;
  for (std::size_t i = 0; i < m.factor.size(); ++i)
    b[i] *= m.factor[i];
  if constexpr (is_real<Scalar>)
    klu_l_solve(m.symbolic, m.numeric, m.size(), 1, b, &m.common);
  else
    klu_zl_solve(m.symbolic, m.numeric, m.size(), 1, reinterpret_cast<double*>(b), &m.common);
}

template <class Scalar> typename SparseLu<Scalar>::Work SparseLu<Scalar>::work() const {
  Impl& m = *impl_;
  if (!m.numeric)
    return {};
  return {m.flops(), 2.0 * static_cast<double>(m.numeric->lnz + m.numeric->unz)};
}

template class SparseLu<double>;
template class SparseLu<std::complex<double>>;

} // namespace hydrodae::linalg
