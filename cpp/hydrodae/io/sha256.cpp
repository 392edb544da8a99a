#include "hydrodae/io/sha256.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>
#include <vector>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

#include "hydrodae/core/error.h"

namespace hydrodae::io {

namespace {

/// FIPS 180-4, sections 4.2.2 and 5.3.3: parts of the cube and square roots of the first primes.
constexpr std::array<std::uint32_t, 64> rounds = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using State = std::array<std::uint32_t, 8>;

/// FIPS 180-4, section 6.2.2, for one block of 64 bytes.
void take_block(State& state, const unsigned char* block) {
  std::array<std::uint32_t, 64> w;
  for (std::size_t t = 0; t < 16; ++t)
    w[t] = std::uint32_t{block[4 * t]} << 24 | std::uint32_t{block[4 * t + 1]} << 16 |
           std::uint32_t{block[4 * t + 2]} << 8 | std::uint32_t{block[4 * t + 3]};
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t a = w[t - 15], b = w[t - 2];
    w[t] = w[t - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[t - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                ((e & f) ^ (~e & g)) + rounds[t] + w[t];
    const std::uint32_t second =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + first;
    d = c;
    c = b;
    b = a;
    a = first + second;
  }
  const State now = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i)
    state[i] += now[i];
}

#if defined(__x86_64__)
/// Takes one block with the SHA extensions of x86 (Intel 64 manual, vol. 2: SHA256RNDS2,
/// SHA256MSG1, SHA256MSG2): four rounds at a time, the state as the words (A, B, E, F) and
/// (C, D, G, H).
__attribute__((target("sha,sse4.1"))) void take_block_by_instructions(State& state,
                                                                      const unsigned char* block) {
  const auto load = [](const void* from) __attribute__((target("sha,sse4.1"))) {
    return _mm_loadu_si128(static_cast<const __m128i*>(from));
  };
  const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
  const __m128i cdab = _mm_shuffle_epi32(load(state.data()), 0xb1),
                efgh = _mm_shuffle_epi32(load(state.data() + 4), 0x1b);
  const __m128i start0 = _mm_alignr_epi8(cdab, efgh, 8), start1 = _mm_blend_epi16(efgh, cdab, 0xf0);
  __m128i s0 = start0, s1 = start1, w[4];
  for (std::size_t k = 0; k < 16; ++k) {
    __m128i& now = w[k % 4];
    const __m128i last = w[(k + 3) % 4];
    if (k < 4)
      now = _mm_shuffle_epi8(load(block + 16 * k), big_endian);
    else
      now = _mm_sha256msg2_epu32(_mm_add_epi32(_mm_sha256msg1_epu32(now, w[(k + 1) % 4]),
                                               _mm_alignr_epi8(last, w[(k + 2) % 4], 4)),
                                 last);
    const __m128i sum = _mm_add_epi32(now, load(rounds.data() + 4 * k));
    s1 = _mm_sha256rnds2_epu32(s1, s0, sum);
    s0 = _mm_sha256rnds2_epu32(s0, s1, _mm_shuffle_epi32(sum, 0x0e));
  }
  const __m128i feba = _mm_shuffle_epi32(_mm_add_epi32(s0, start0), 0x1b),
                dchg = _mm_shuffle_epi32(_mm_add_epi32(s1, start1), 0xb1);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data()), _mm_blend_epi16(feba, dchg, 0xf0));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(state.data() + 4), _mm_alignr_epi8(dchg, feba, 8));
}

/// Returns whether this machine has these instructions (CPUID leaf 7: bit 29 of EBX).
bool has_instructions() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b >> 29 & 1) != 0;
}
#endif

using TakeBlock = void (*)(State&, const unsigned char*);

TakeBlock best_take_block([[maybe_unused]] bool instructions) {
#if defined(__x86_64__)
  if (instructions && has_instructions())
    return take_block_by_instructions;
#endif
  return take_block;
}

class Sha256 {
public:
  explicit Sha256(bool instructions = true) : take_block_(best_take_block(instructions)) {}

  void add(std::span<const unsigned char> bytes) {
    length_ += bytes.size();
    for (const unsigned char* at = bytes.data(); !bytes.empty();) {
      const std::size_t taken = std::min(bytes.size(), block_.size() - filled_);
      std::memcpy(block_.data() + filled_, at, taken);
      filled_ += taken;
      at += taken;
      bytes = bytes.subspan(taken);
      if (filled_ == block_.size()) {
        take_block_(state_, block_.data());
        filled_ = 0;
      }
    }
  }

  /// 64 hexadecimal digits.
  std::string finish() {
    const std::uint64_t bits = 8 * length_;
    const unsigned char one = 0x80, zero = 0;
    add({&one, 1});
    while (filled_ != 56)
      add({&zero, 1});
    for (int shift = 56; shift >= 0; shift -= 8) {
      const auto byte = static_cast<unsigned char>(bits >> shift);
      add({&byte, 1});
    }
    std::string text;
    for (const std::uint32_t word : state_)
      for (int shift = 28; shift >= 0; shift -= 4)
        text += "0123456789abcdef"[(word >> shift) & 15];
    return text;
  }

private:
  TakeBlock take_block_;
  State state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                  0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::size_t filled_ = 0;
  std::uint64_t length_ = 0; ///< [bytes]
};

std::span<const unsigned char> bytes_of(const char* data, std::size_t count) {
  return {reinterpret_cast<const unsigned char*>(data), count};
}

} // namespace

std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 digest;
  std::vector<char> block(1 << 16);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    digest.add(bytes_of(block.data(), static_cast<std::size_t>(file.gcount())));
  }
  if (!file.eof())
    throw CaseError(path + ": cannot compute the SHA-256 of the file");
  return digest.finish();
}

std::string sha256_of_text(const std::string& text, bool instructions) {
  Sha256 digest(instructions);
  digest.add(bytes_of(text.data(), text.size()));
  return digest.finish();
}

} // namespace hydrodae::io
