#pragma once
/// Vectors as three plain numbers, or in three arrays: the compiler can vectorise loops over them,
/// but not over Eigen's vectors.

// Part of a function for each instruction set: it must be inlined.
#define HYDRODAE_PART [[gnu::always_inline]] inline

namespace hydrodae::line {

template <class S> struct Triple {
  S x, y, z;
  HYDRODAE_PART friend Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  HYDRODAE_PART friend Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  HYDRODAE_PART friend Triple operator*(const S& a, const Triple& b) {
    return {a * b.x, a * b.y, a * b.z};
  }
  HYDRODAE_PART friend S dot(const Triple& a, const Triple& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
};

/// Vectors stored in three arrays.
template <class S> struct Triples {
  S *x, *y, *z;
  HYDRODAE_PART Triple<S> operator[](int i) const { return {x[i], y[i], z[i]}; }
  HYDRODAE_PART void put(int i, const Triple<S>& v) const {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  HYDRODAE_PART void clear(int i) const { x[i] = y[i] = z[i] = S(0); }
};

} // namespace hydrodae::line
