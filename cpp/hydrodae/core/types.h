#pragma once
/// Scalars, vectors and matrices. `S` is double in the kernel and a dual number in the tests that
/// check the Jacobian.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace hydrodae {

using Index = std::int64_t; ///< index type of SUNDIALS and of the long version of KLU

template <class S> using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S> using Vec4 = Eigen::Matrix<S, 4, 1>;
template <class S> using Vec6 = Eigen::Matrix<S, 6, 1>;
template <class S> using Mat3 = Eigen::Matrix<S, 3, 3>;
template <class S> using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;

using Vector3 = Vec3<double>;
using Vector4 = Vec4<double>;
using Vector6 = Vec6<double>;
using VectorX = VecX<double>;
using Matrix3 = Mat3<double>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using MatrixX = Eigen::MatrixXd;

inline constexpr double pi = 3.14159265358979323846;

} // namespace hydrodae
