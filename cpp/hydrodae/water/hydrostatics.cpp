#include "hydrodae/water/hydrostatics.h"

#include "hydrodae/element/body_state.h"

namespace hydrodae::water {

namespace {

/// Tilt factor f = beta / sin beta and df / dg_z, from the vertical g in body axes. Near upright
/// the series f = sum t_k e^k is used, e = sin^2(beta / 2), t_k = t_(k-1) k / (k + 1/2): there e <
/// 2.6e-3, and the omitted terms are below rounding.
template <class S> struct Tilt {
  S factor{1}, slope{0};
  explicit Tilt(const Vec3<S>& g) {
    using std::atan2;
    using std::sqrt;
    const S square = g[0] * g[0] + g[1] * g[1];
    if (!(g[2] > S(0)) || square > S(0.01)) {
      const S sine = sqrt(square);
      factor = atan2(sine, g[2]) / sine;
      slope = (g[2] * factor - S(1)) / square;
      return;
    }
    const S e = square / (S(2) * (S(1) + g[2]));
    S term(1); // term t_k e^(k-1)
    for (int k = 1; k < 8; ++k) {
      term *= S(k / (k + 0.5));
      slope -= S(0.5 * k) * term;
      term *= e;
      factor += term;
    }
  }
};

template <class S> Vec3<S> coordinates(const Tilt<S>& tilt, const S& rise, const Vec3<S>& g) {
  return {rise, tilt.factor * g[1], -(tilt.factor * g[0])};
}

} // namespace

YawHydrostatics::YawHydrostatics() {
  type = Hydrostatics::type;
  buoyant = true;
  shape.port = element::Port::in_water;
  shape.feels_rates = false;
  work = element::Work::lent;
}

void YawHydrostatics::add(const std::string& name, const element::LinearWrench& wrench,
                          double height) {
  const Matrix3 K = wrench.stiffness.block<3, 3>(2, 2);
  names.push_back(name);
  laws_.push_back({0.5 * (K + K.transpose()), wrench.constant.segment<3>(2), height});
}

template <class S> Vec6<S> YawHydrostatics::load(const Law& law, const S& z, const Vec3<S>& g) {
  const Tilt<S> tilt(g);
  const Vec3<S> by_x = law.stiffness.cast<S>() * coordinates<S>(tilt, z - S(law.height), g) -
                       law.constant.cast<S>(); // derivative dE/dx
  const Vec3<S> by_g(-(tilt.factor * by_x[2]), tilt.factor * by_x[1],
                     tilt.slope * (by_x[1] * g[1] - by_x[2] * g[0]));
  Vec6<S> out;
  out << S(0), S(0), -by_x[0], cross<S>(g, by_g);
  return out;
}

template <class S> void YawHydrostatics::each(const S* in, S* out) const {
  for (const Law& law : laws_) {
    const element::BodyState<S> b = element::read_body(in);
    Eigen::Map<Vec6<S>> load_of_law(out);
    load_of_law = load<S>(law, b.r[2], b.R.row(2).transpose());
    in += element::body_numbers;
    out += 6;
  }
}

void YawHydrostatics::evaluate(double, const double* in, const double*, double* out) const {
  each(in, out);
}
void YawHydrostatics::evaluate(double, const Dual* in, const double*, Dual* out) const {
  each(in, out);
}

void YawHydrostatics::jacobian(double, const double* in, const double*, double* jacobian) const {
  for (const Law& law : laws_) {
    Eigen::Map<Eigen::Matrix<double, 6, 18>> J(jacobian);
    J.setZero();
    const element::BodyState<double> b = element::read_body(in);
    const Vector3 g = b.R.row(2).transpose();
    const Matrix3 turn = skew<double>(g); // derivative dg = g x dphi
    for (int column = 2; column < 6; ++column) {
      Vec3<Dual> turned = g.cast<Dual>();
      if (column > 2)
        for (int c = 0; c < 3; ++c)
          turned[c].b = turn(c, column - 3);
      const Vec6<Dual> by = load<Dual>(law, {b.r[2], column == 2 ? 1.0 : 0.0}, turned);
      for (int row = 0; row < 6; ++row)
        J(row, column) = by[row].b;
    }
    in += element::body_numbers;
    jacobian += J.size();
  }
}

void YawHydrostatics::energy(const double* in, const double*, double* joules) const {
  for (const Law& law : laws_) {
    const element::BodyState<double> b = element::read_body(in);
    const Vector3 g = b.R.row(2).transpose();
    const Vector3 x = coordinates<double>(Tilt<double>(g), b.r[2] - law.height, g);
    *joules++ = 0.5 * x.dot(law.stiffness * x) - law.constant.dot(x);
    in += element::body_numbers;
  }
}

} // namespace hydrodae::water
