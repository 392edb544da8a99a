#pragma once
/// Random numbers that are the same on every machine, compiler and version: xoshiro256** 1.0
/// (Blackman and Vigna, ACM Trans. Math. Softw. 47 (2021) 36), its state filled by splitmix64, and
/// the 53 high bits of each output as a number in [0, 1). No distribution of the standard library.

#include <array>
#include <bit>
#include <cstdint>

namespace hydrodae::sea {

class Random {
public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) { // splitmix64
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }

  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1): a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

private:
  std::array<std::uint64_t, 4> state_{};
};

} // namespace hydrodae::sea
