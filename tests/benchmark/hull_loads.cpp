/// Time of one evaluation of the loads of a clipped mesh, and of the loads with their gradient:
/// 2880 triangles, sphere of 5 m, half in the water; still water, 1, 20 and 200 waves of one
/// direction, and 200 waves of as many directions. Prints the fastest of some repetitions [us].

#include <cstdio>
#include <ctime>

#include "hull/meshes.h"
#include "hydrodae/hull/loads.h"

using namespace hydrodae;

namespace {

template <class Call> double microseconds(int n, const Call& call) {
  double best = INFINITY;
  for (int repetition = 0; repetition < 6; ++repetition) { // the first one warms up
    const std::clock_t start = std::clock();
    for (int i = 0; i < n; ++i)
      call(i);
    best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC / n * 1e6);
  }
  return best;
}

hull::Pose pose(int i) {
  return {{0.1, 0.2, 0.5 * std::sin(0.1 * i)},
          rotation_about_axis<double>(1, 0.1 * std::sin(0.17 * i))};
}

} // namespace

int main() {
  std::vector<std::array<double, 2>> line;
  for (int i = 0; i <= 31; ++i)
    line.push_back({5 * std::sin(pi * i / 31), -5 * std::cos(pi * i / 31)});
  const hull::Mesh mesh = tests::turned(line, 48).mesh();
  double sum = 0.0; // so that no call is dropped
  for (auto [n, spread] : {std::pair{0, 0.0}, {1, 0.0}, {20, 0.0}, {200, 0.0}, {200, 2.0}})
    for (auto [name, stretching] : {std::pair{"vertical", hull::Stretching::vertical},
                                    std::pair{"wheeler", hull::Stretching::wheeler},
                                    std::pair{"extrapolated", hull::Stretching::extrapolated}}) {
      std::vector<hull::Wave> waves;
      for (int j = 0; j < n; ++j) {
        const double w = 0.4 + 1.6 * (j + 0.5) / n;
        waves.push_back({w, w * w / 9.81, 0.3 + spread * std::sin(5.0 * j),
                         0.5 * std::sqrt(2.0 / n), 2.4 * j * j});
      }
      const hull::WaveField field({1025.0, 9.81, INFINITY, stretching}, waves, mesh.radius);
      hull::Workspace work(mesh, field);
      Matrix6 gradient;
      const int calls = n > 1 ? 100 : 1000;
      const double plain = microseconds(calls, [&](int i) {
        sum += hull::loads(mesh, field, pose(i), {0.05 * i}, work).hydrostatic[2];
      });
      const double both = microseconds(calls, [&](int i) {
        sum += hull::loads(mesh, field, pose(i), {0.05 * i}, work, &gradient).hydrostatic[2];
      });
      std::printf("%3d waves%s (%3d terms), %-12s: %7.1f us, with gradient %7.1f us\n", n,
                  spread > 0.0 ? ", spread" : "", field.terms(), name, plain, both);
    }
  return sum == 0.0;
}
