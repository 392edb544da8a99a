#pragma once
/// A load that is linear in the places and velocities of points:
///
///   f = -K (x - x0) - C x'        x: (3 n,) places of n points, f: the forces on them, earth axes

#include <algorithm>
#include <string>
#include <utility>

#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Law that is linear in the places and velocities of points.
class LinearPoints final : public Elements {
public:
  /// @param reference  x0 (3 n,) [m]
  /// @param stiffness  K (3 n, 3 n) [N/m]; need not be symmetric
  /// @param damping    C (3 n, 3 n) [N s/m]
  LinearPoints(std::string_view of_type, const std::string& name, VectorX reference,
               MatrixX stiffness, MatrixX damping)
      : x0_(std::move(reference)), K_(std::move(stiffness)), C_(std::move(damping)) {
    type = of_type;
    shape = {Port::points, static_cast<int>(x0_.size())};
    names = {name};
  }

  void evaluate(double, const double* in, const double*, double* out) const override {
    load(in, out);
  }
  void evaluate(double, const Dual* in, const double*, Dual* out) const override { load(in, out); }
  void jacobian(double, const double*, const double*, double* jacobian) const override {
    Eigen::Map<MatrixX> J(jacobian, size_of(), 2 * size_of());
    J << -K_, -C_;
  }
  /// Energy of the symmetric part of K, which alone has a potential.
  void energy(const double* in, const double*, double* joules) const override {
    const VectorX d = Eigen::Map<const VectorX>(in, size_of()) - x0_;
    *joules = 0.5 * d.dot(K_ * d);
  }
  void observe(double, const double*, const double*, const double*, double*) const override {}
  bool lost_at_rest(std::size_t) const override { return false; }

private:
  template <class S> void load(const S* in, S* out) const {
    std::fill_n(out, size_of(), S(0.0));
    for (Index j = 0; j < size_of(); ++j) {
      const S d = in[j] - S(x0_[j]), v = in[size_of() + j];
      for (Index i = 0; i < size_of(); ++i)
        out[i] -= S(K_(i, j)) * d + S(C_(i, j)) * v;
    }
  }
  Index size_of() const { return x0_.size(); }
  VectorX x0_;
  MatrixX K_, C_;
};

} // namespace hydrodae::element
