#include "hydrodae/ensemble/lane_kernels.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define HYDRODAE_X86 1
#endif

namespace hydrodae::ensemble {

namespace {

/// All lanes as one vector of the language extension of GCC and Clang: the compiler splits it into
/// the registers of each instruction set.
using Register [[gnu::vector_size(sizeof(double) * width), gnu::may_alias]] = double;

const Register* registers(const Lanes* x) { return reinterpret_cast<const Register*>(x); }

#define HYDRODAE_LANE_KERNELS(set, target)                                                         \
  target void dot_##set(const Lanes* x, const Lanes* y, Index n, Lanes* out) {                     \
    const Register *a = registers(x), *b = registers(y);                                           \
    Register s0{}, s1{};                                                                           \
    Index k = 0;                                                                                   \
    for (; k + 2 <= n; k += 2) {                                                                   \
      s0 += a[k] * b[k];                                                                           \
      s1 += a[k + 1] * b[k + 1];                                                                   \
    }                                                                                              \
    if (k < n)                                                                                     \
      s0 += a[k] * b[k];                                                                           \
    *reinterpret_cast<Register*>(out) = s0 + s1;                                                   \
  }                                                                                                \
  target void dots_##set(const Lanes* x, const Lanes* const* y, Index n, Lanes* out) {             \
    const Register *a = registers(x), *b0 = registers(y[0]), *b1 = registers(y[1]),                \
                   *b2 = registers(y[2]), *b3 = registers(y[3]);                                   \
    Register s0{}, s1{}, s2{}, s3{};                                                               \
    for (Index k = 0; k < n; ++k) {                                                                \
      const Register by = a[k];                                                                    \
      s0 += by * b0[k];                                                                            \
      s1 += by * b1[k];                                                                            \
      s2 += by * b2[k];                                                                            \
      s3 += by * b3[k];                                                                            \
    }                                                                                              \
    Register* to = reinterpret_cast<Register*>(out);                                               \
    to[0] = s0;                                                                                    \
    to[1] = s1;                                                                                    \
    to[2] = s2;                                                                                    \
    to[3] = s3;                                                                                    \
  }

HYDRODAE_LANE_KERNELS(plain, )
#ifdef HYDRODAE_X86
HYDRODAE_LANE_KERNELS(avx2, [[gnu::target("avx2,fma")]])
HYDRODAE_LANE_KERNELS(avx512, [[gnu::target("avx512f,fma")]])
#endif

LaneKernels widest() {
#ifdef HYDRODAE_X86
  if (__builtin_cpu_supports("avx512f"))
    return {dot_avx512, dots_avx512};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return {dot_avx2, dots_avx2};
#endif
  return {dot_plain, dots_plain};
}

} // namespace

const LaneKernels& lane_kernels() {
  static const LaneKernels kernels = widest();
  return kernels;
}

} // namespace hydrodae::ensemble
