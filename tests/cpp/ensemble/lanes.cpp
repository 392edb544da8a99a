#include <doctest/doctest.h>

#include <array>
#include <random>

#include <Eigen/Cholesky>

#include "hydrodae/ensemble/lane_kernels.h"
#include "hydrodae/ensemble/lane_model.h"

namespace hydrodae::ensemble {
namespace {

constexpr Index n = 11;

Lanes draw(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Lanes out;
  for (double& x : out.lane)
    x = uniform(random);
  return out;
}

TEST_CASE("sums of lanes are those of each lane") {
  std::mt19937 random(1);
  std::array<std::vector<Lanes>, 5> vectors;
  for (std::vector<Lanes>& v : vectors)
    for (Index k = 0; k < n; ++k)
      v.push_back(draw(random));
  const Lanes* const four[4] = {vectors[1].data(), vectors[2].data(), vectors[3].data(),
                                vectors[4].data()};
  Lanes one, all[4];
  lane_kernels().dot(vectors[0].data(), four[0], n, &one);
  lane_kernels().dots(vectors[0].data(), four, n, all);
  for (int k = 0; k < width; ++k)
    for (std::size_t j = 0; j < 4; ++j) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i)
        sum += vectors[0][i][k] * vectors[j + 1][i][k];
      CHECK(all[j][k] == doctest::Approx(sum).epsilon(1e-14));
      if (j == 0)
        CHECK(one[k] == doctest::Approx(sum).epsilon(1e-14));
    }
}

TEST_CASE("the factor of a matrix in lanes solves the equations of each lane") {
  std::mt19937 random(2);
  std::array<MatrixX, width> matrices;
  LaneCholesky factor;
  factor.resize(n);
  for (MatrixX& m : matrices) {
    MatrixX half(n, n);
    for (Index i = 0; i < n * n; ++i)
      half.data()[i] = draw(random)[0];
    m = half * half.transpose() + 0.1 * MatrixX::Identity(n, n);
  }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j <= i; ++j)
      for (int k = 0; k < width; ++k)
        factor.at(i, j)[k] = matrices[static_cast<std::size_t>(k)](i, j);
  std::array<bool, width> sound;
  sound.fill(true);
  factor.factorise(1e-12, sound);
  CHECK(std::count(sound.begin(), sound.end(), true) == width);
  std::vector<Lanes> x;
  for (Index i = 0; i < n; ++i)
    x.push_back(draw(random));
  const std::vector<Lanes> right = x;
  factor.solve_forward(x.data());
  factor.solve_backward(x.data());
  for (int k = 0; k < width; ++k) {
    VectorX b(n), found(n);
    for (Index i = 0; i < n; ++i) {
      b[i] = right[static_cast<std::size_t>(i)][k];
      found[i] = x[static_cast<std::size_t>(i)][k];
    }
    CHECK((matrices[static_cast<std::size_t>(k)] * found - b).norm() < 1e-12);
  }
}

TEST_CASE("a singular lane is told, and the others are not spoilt") {
  LaneCholesky factor;
  factor.resize(2);
  factor.at(0, 0) = Lanes(1.0);
  factor.at(1, 0) = Lanes(1.0);
  factor.at(1, 1) = Lanes(2.0);
  factor.at(1, 1)[3] = 1.0;
  std::array<bool, width> sound;
  sound.fill(true);
  factor.factorise(1e-12, sound);
  for (int k = 0; k < width; ++k)
    CHECK(sound[static_cast<std::size_t>(k)] == (k != 3));
}

} // namespace
} // namespace hydrodae::ensemble
