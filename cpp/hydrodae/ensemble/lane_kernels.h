#pragma once
/// Sums over vectors of lanes, compiled for the plain processor, for AVX2 and for AVX-512; the
/// widest that the machine has is taken at run time.

#include "hydrodae/ensemble/lanes.h"

namespace hydrodae::ensemble {

struct LaneKernels {
  /// out = sum_k a_k b_k of n numbers
  void (*dot)(const Lanes* a, const Lanes* b, Index n, Lanes* out);
  /// out_j = sum_k a_k b_jk of four vectors b, which read `a` once
  void (*dots)(const Lanes* a, const Lanes* const* b, Index n, Lanes* out);
};

const LaneKernels& lane_kernels();

/// sum_k a_k b_k
inline Lanes dot(const Lanes* a, const Lanes* b, Index n) {
  Lanes out;
  lane_kernels().dot(a, b, n, &out);
  return out;
}

} // namespace hydrodae::ensemble
