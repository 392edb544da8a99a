#pragma once
/// Vectors of numbers as long as a register, and elementary functions of all their numbers at once:
/// for kernels that are compiled for several instruction sets, the widest of which is taken at run
/// time.

#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#define HYDRODAE_X86 1
#endif
// A function that becomes a part of one for each instruction set, so it must be inlined.
#define HYDRODAE_PART [[gnu::always_inline]] inline

// Definitions of a kernel for each instruction set: body(suffix, register, attribute).
#ifdef HYDRODAE_X86
#define HYDRODAE_FOR_EACH_SET(body)                                                                \
  body(plain, simd::Register16, ) body(avx2, simd::Register32, [[gnu::target("avx2,fma")]])        \
      body(avx512, simd::Register64, [[gnu::target("avx512f,fma")]])
#else
#define HYDRODAE_FOR_EACH_SET(body) body(plain, simd::Register16, )
#endif

namespace hydrodae::simd {

// Vectors of the language extension of GCC and Clang.
using Register16 [[gnu::vector_size(16)]] = double;
using Register32 [[gnu::vector_size(32)]] = double;
using Register64 [[gnu::vector_size(64)]] = double;

/// The widest of the functions of all instruction sets that the machine has.
template <class Function>
Function* widest([[maybe_unused]] Function* avx512, [[maybe_unused]] Function* avx2,
                 Function* plain) {
#ifdef HYDRODAE_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("fma"))
    return avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return avx2;
#endif
  return plain;
}

template <class R> constexpr int count = sizeof(R) / sizeof(double); ///< numbers of a register

template <class R> HYDRODAE_PART void load(const double* from, R& x) {
  std::memcpy(&x, from, sizeof(R));
}
template <class R> HYDRODAE_PART void store(const R& x, double* to) {
  std::memcpy(to, &x, sizeof(R));
}
template <class R> HYDRODAE_PART double sum(const R& x) {
  double total = 0.0;
  for (int k = 0; k < count<R>; ++k)
    total += x[k];
  return total;
}

inline constexpr double to_integer = 6755399441055744.0; ///< 1.5 2^52: a sum has no fraction

/// cos and sin of angles of at most 1e6 rad, with an absolute error below 4e-16.
///
/// The angle without whole quarters of a turn, in [-pi/4, pi/4], and the polynomials of fdlibm
/// (Sun Microsystems, k_sin.c and k_cos.c, 1993).
template <class R> HYDRODAE_PART void cos_sin(const R& angle, R& cosine, R& sine) {
  using Bits = decltype(angle < angle);
  // pi / 2 = high + low; 2^20 times `high` is still exact.
  constexpr double high = 6746518852.0 / 4294967296.0;
  constexpr double low = (1.57079632679489661923 - high) + 6.123233995736766e-17;
  const R shifted = angle * 0.63661977236758134308 + to_integer;
  const Bits quarters = (Bits)shifted; // in the lowest bits
  const R turns = shifted - to_integer;
  const R r = (angle - turns * high) - turns * low, q = r * r;
  const R s =
      r + r * q *
              (-1.66666666666666324348e-01 +
               q * (8.33333333332248946124e-03 +
                    q * (-1.98412698298579493134e-04 +
                         q * (2.75573137070700676789e-06 + q * (-2.50507602534068634195e-08 +
                                                                q * 1.58969099521155010221e-10)))));
  const R c = 1.0 - q * (0.5 - q * (4.16666666666666019037e-02 +
                                    q * (-1.38888888888741095749e-03 +
                                         q * (2.48015872894767294178e-05 +
                                              q * (-2.75573143513906633035e-07 +
                                                   q * (2.08757232129817482790e-09 +
                                                        q * -1.13596475577881948265e-11))))));
  const Bits odd = -(quarters & 1); // cosine and sine change places
  const Bits cos_bits = ((Bits)c & ~odd) | ((Bits)s & odd),
             sin_bits = ((Bits)s & ~odd) | ((Bits)c & odd);
  cosine = (R)(cos_bits ^ (((quarters + 1) & 2) << 62));
  sine = (R)(sin_bits ^ ((quarters & 2) << 62));
}

/// e^x with a relative error below 4e-16; beyond -708 and 709 the value of that place.
///
/// e^x = 2^n e^r with |r| <= ln 2 / 2: Taylor's series, exact to rounding there.
template <class R> HYDRODAE_PART void exp(const R& exponent, R& out) {
  using Bits = decltype(exponent < exponent);
  R x = exponent;
  x = x < -708.0 ? x - x - 708.0 : x;
  x = x > 709.0 ? x - x + 709.0 : x;
  const R shifted = x * 1.44269504088896340736 + to_integer;
  const R n = shifted - to_integer;
  const R r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  R p = r * (1.0 / 6227020800) + 1.0 / 479001600;
  p = p * r + 1.0 / 39916800;
  p = p * r + 1.0 / 3628800;
  p = p * r + 1.0 / 362880;
  p = p * r + 1.0 / 40320;
  p = p * r + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  out = (R)((Bits)p + ((Bits)shifted << 52));
}

} // namespace hydrodae::simd
