/// Runs a case and prints the mean power of each take-off:  energy CASE.toml RESULTS.h5

#include <exception>
#include <iostream>

#include "hydrodae/simulation.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: energy CASE.toml RESULTS.h5\n";
    return 2;
  }
  try {
    const hydrodae::model::Scene scene = hydrodae::io::read_case(argv[1]);
    const hydrodae::RunStatistics statistics = hydrodae::simulate(scene, argv[2]);
    std::cout << "hydrodae " << hydrodae::version << ", " << statistics.end_time << " s\n";
    for (const auto& [name, power] : statistics.mean_power)
      std::cout << name << ": " << power << " W\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
