#include "hydrodae/math/dense_cholesky.h"

#include <cmath>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#define HYDRODAE_X86 1
#endif

namespace hydrodae::dense {

namespace {

// The bodies below become part of a function of each instruction set, so they must be inlined.
#define HYDRODAE_PART [[gnu::always_inline]] inline

// Vectors of the language extension of GCC and Clang, one a register.
using Register16 [[gnu::vector_size(16)]] = double;
using Register32 [[gnu::vector_size(32)]] = double;
using Register64 [[gnu::vector_size(64)]] = double;

/// Eight numbers in the registers of one instruction set.
template <class Register> struct Lanes {
  static constexpr int count = lanes * sizeof(double) / sizeof(Register);
  static constexpr int each = lanes / count;
  Register part[count];

  HYDRODAE_PART void clear() {
    for (int k = 0; k < count; ++k)
      part[k] = Register{};
  }
  HYDRODAE_PART void load(const double* from) {
    for (int k = 0; k < count; ++k)
      std::memcpy(&part[k], from + k * each, sizeof(Register));
  }
  HYDRODAE_PART void store(double* to) const {
    for (int k = 0; k < count; ++k)
      std::memcpy(to + k * each, &part[k], sizeof(Register));
  }
  HYDRODAE_PART void add(double factor, const Lanes& v) {
    for (int k = 0; k < count; ++k)
      part[k] += factor * v.part[k];
  }
  HYDRODAE_PART void subtract(double factor, const Lanes& v) {
    for (int k = 0; k < count; ++k)
      part[k] -= factor * v.part[k];
  }
  HYDRODAE_PART void add_product(const Lanes& a, const Lanes& b) {
    for (int k = 0; k < count; ++k)
      part[k] += a.part[k] * b.part[k];
  }
  HYDRODAE_PART void scale(double factor) {
    for (int k = 0; k < count; ++k)
      part[k] *= factor;
  }
  HYDRODAE_PART double sum() const {
    double total = 0.0;
    for (int i = 0; i < each; ++i)
      for (int k = 0; k < count; ++k)
        total += part[k][i];
    return total;
  }
};

/// C -= P^T Q (or +=) for P (k, 8), Q (k, 8), C (8, 8), by `rows` rows of C in registers.
template <class R, int rows, bool plus>
HYDRODAE_PART void tile(Index k, const double* p, Index p_stride, const double* q, Index q_stride,
                        double* c, Index c_stride) {
  for (Index first = 0; first < lanes; first += rows) {
    Lanes<R> sum[rows], right;
    for (int i = 0; i < rows; ++i)
      sum[i].load(c + (first + i) * c_stride);
    const double *left = p + first, *from = q;
    for (Index n = 0; n < k; ++n, left += p_stride, from += q_stride) {
      right.load(from);
      for (int i = 0; i < rows; ++i)
        if constexpr (plus)
          sum[i].add(left[i], right);
        else
          sum[i].subtract(left[i], right);
    }
    for (int i = 0; i < rows; ++i)
      sum[i].store(c + (first + i) * c_stride);
  }
}

/// U and then its inverse, in the upper triangle of a block (8, 8) on the diagonal.
/// @param entry diagonal of M
template <class R>
HYDRODAE_PART bool factorise_block(double* u, Index stride, const double* entry, double least) {
  double reciprocal[lanes];
  Lanes<R> row, other;
  for (Index i = 0; i < lanes; ++i) {
    const double pivot = u[i * stride + i];
    if (!(pivot > least * entry[i]))
      return false;
    reciprocal[i] = 1.0 / std::sqrt(pivot);
    row.load(u + i * stride);
    row.scale(reciprocal[i]);
    row.store(u + i * stride);
    for (Index k = i + 1; k < lanes; ++k) {
      other.load(u + k * stride);
      other.subtract(u[i * stride + k], row);
      other.store(u + k * stride);
    }
  }
  for (Index i = lanes - 1; i >= 0; --i) { // row i of U^-1, from those below it
    row.clear();
    for (Index k = i + 1; k < lanes; ++k) {
      other.load(u + k * stride);
      row.subtract(u[i * stride + k], other);
    }
    row.scale(reciprocal[i]);
    row.store(u + i * stride);
    u[i * stride + i] = reciprocal[i];
  }
  return true;
}

/// W := T^T W for the inverse T (8, 8) of a block of the diagonal and W (8, 8).
template <class R>
HYDRODAE_PART void solve_block(const double* t, Index t_stride, double* w, Index w_stride) {
  Lanes<R> sum, row;
  for (Index i = lanes - 1; i >= 0; --i) {
    sum.clear();
    for (Index k = 0; k <= i; ++k) {
      row.load(w + k * w_stride);
      sum.add(t[k * t_stride + i], row);
    }
    sum.store(w + i * w_stride);
  }
}

template <class R, int rows> HYDRODAE_PART bool factorise_part(Index n, double* a, double least) {
  for (Index b = 0; b < n; b += lanes) {
    double* const block = a + b * n + b;
    double entry[lanes];
    for (Index i = 0; i < lanes; ++i)
      entry[i] = block[i * n + i];
    for (Index c = b; c < n; c += lanes)
      tile<R, rows, false>(b, a + b, n, a + c, n, a + b * n + c, n);
    if (!factorise_block<R>(block, n, entry, least))
      return false;
    for (Index c = b + lanes; c < n; c += lanes)
      solve_block<R>(block, n, a + b * n + c, n);
  }
  return true;
}

template <class R, int rows>
HYDRODAE_PART void solve_left_part(Index n, const double* u, Index m, double* w) {
  for (Index b = 0; b < n; b += lanes)
    for (Index c = 0; c < m; c += lanes) {
      tile<R, rows, false>(b, u + b, n, w + c, m, w + b * m + c, m);
      solve_block<R>(u + b * n + b, n, w + b * m + c, m);
    }
}

template <class R, int rows>
HYDRODAE_PART void add_gram_part(Index n, Index m, const double* w, double* s) {
  for (Index b = 0; b < m; b += lanes)
    for (Index c = b; c < m; c += lanes)
      tile<R, rows, true>(n, w + b, m, w + c, m, s + b * m + c, m);
}

template <class R, int rows>
HYDRODAE_PART void add_product_part(Index k, Index n, const double* p, Index m, const double* q,
                                    double* c) {
  for (Index i = 0; i < n; i += lanes)
    for (Index j = 0; j < m; j += lanes)
      tile<R, rows, true>(k, p + i, n, q + j, m, c + i * m + j, m);
}

template <class R>
HYDRODAE_PART void add_transposed_part(Index n, Index m, const double* w, const double* x,
                                       double* y) {
  Lanes<R> sum, row;
  for (Index c = 0; c < m; c += lanes) {
    sum.load(y + c);
    for (Index i = 0; i < n; ++i) {
      row.load(w + i * m + c);
      sum.add(x[i], row);
    }
    sum.store(y + c);
  }
}

template <class R>
HYDRODAE_PART void subtract_product_part(Index n, Index m, const double* w, const double* y,
                                         double* x) {
  Lanes<R> sum, row, right;
  for (Index i = 0; i < n; ++i) {
    sum.clear();
    for (Index c = 0; c < m; c += lanes) {
      row.load(w + i * m + c);
      right.load(y + c);
      sum.add_product(row, right);
    }
    x[i] -= sum.sum();
  }
}

template <class R> HYDRODAE_PART void solve_forward_part(Index n, const double* u, double* x) {
  Lanes<R> sum, row;
  for (Index b = 0; b < n; b += lanes) {
    sum.clear();
    for (Index i = b; i < b + lanes; ++i) {
      row.load(u + i * n + b);
      sum.add(x[i], row);
    }
    sum.store(x + b);
    for (Index c = b + lanes; c < n; c += lanes) {
      sum.load(x + c);
      for (Index i = b; i < b + lanes; ++i) {
        row.load(u + i * n + c);
        sum.subtract(x[i], row);
      }
      sum.store(x + c);
    }
  }
}

template <class R> HYDRODAE_PART void solve_backward_part(Index n, const double* u, double* x) {
  Lanes<R> sum, row, right;
  for (Index b = n - lanes; b >= 0; b -= lanes) {
    for (Index i = b; b + lanes < n && i < b + lanes; ++i) {
      sum.clear();
      for (Index c = b + lanes; c < n; c += lanes) {
        row.load(u + i * n + c);
        right.load(x + c);
        sum.add_product(row, right);
      }
      x[i] -= sum.sum();
    }
    right.load(x + b);
    for (Index i = b; i < b + lanes; ++i) {
      row.load(u + i * n + b);
      sum.clear();
      sum.add_product(row, right);
      x[i] = sum.sum();
    }
  }
}

// The kernels of one instruction set; so many rows that the sums stay in its registers.
#define HYDRODAE_KERNELS(set, R, rows, target)                                                     \
  target bool factorise_##set(Index n, double* a, double least) {                                  \
    return factorise_part<R, rows>(n, a, least);                                                   \
  }                                                                                                \
  target void solve_left_##set(Index n, const double* u, Index m, double* w) {                     \
    solve_left_part<R, rows>(n, u, m, w);                                                          \
  }                                                                                                \
  target void add_gram_##set(Index n, Index m, const double* w, double* s) {                       \
    add_gram_part<R, rows>(n, m, w, s);                                                            \
  }                                                                                                \
  target void add_product_##set(Index k, Index n, const double* p, Index m, const double* q,       \
                                double* c) {                                                       \
    add_product_part<R, rows>(k, n, p, m, q, c);                                                   \
  }                                                                                                \
  target void solve_forward_##set(Index n, const double* u, double* x) {                           \
    solve_forward_part<R>(n, u, x);                                                                \
  }                                                                                                \
  target void solve_backward_##set(Index n, const double* u, double* x) {                          \
    solve_backward_part<R>(n, u, x);                                                               \
  }                                                                                                \
  target void add_transposed_##set(Index n, Index m, const double* w, const double* x,             \
                                   double* y) {                                                    \
    add_transposed_part<R>(n, m, w, x, y);                                                         \
  }                                                                                                \
  target void subtract_product_##set(Index n, Index m, const double* w, const double* y,           \
                                     double* x) {                                                  \
    subtract_product_part<R>(n, m, w, y, x);                                                       \
  }

HYDRODAE_KERNELS(plain, Register16, 2, )
#ifdef HYDRODAE_X86
HYDRODAE_KERNELS(avx2, Register32, 4, [[gnu::target("avx2,fma")]])
HYDRODAE_KERNELS(avx512, Register64, 8, [[gnu::target("avx512f,fma")]])
#endif

#define HYDRODAE_ROW(set)                                                                          \
  Kernels {                                                                                        \
    #set, factorise_##set, solve_left_##set, add_gram_##set, add_product_##set,                    \
        solve_forward_##set, solve_backward_##set, add_transposed_##set, subtract_product_##set    \
  }

const Kernels table[] = {HYDRODAE_ROW(plain),
#ifdef HYDRODAE_X86
                         HYDRODAE_ROW(avx2), HYDRODAE_ROW(avx512)
#endif
};

std::size_t usable() {
#ifdef HYDRODAE_X86
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return 1;
  return __builtin_cpu_supports("avx512f") ? 3 : 2;
#else
  return 1;
#endif
}

} // namespace

std::span<const Kernels> all_kernels() {
  static const std::size_t count = usable();
  return {table, count};
}

} // namespace hydrodae::dense
