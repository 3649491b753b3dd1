#pragma once

#include <array>
#include <cstdint>

namespace seacrane {

/// Philox4x32-10, a counter-based generator: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel
/// random numbers: as easy as 1, 2, 3", SC11 (2011). A pure function of counter and key in unsigned integer
/// arithmetic: exactly the same bits on every platform.
class Philox {
 public:
  using Counter = std::array<std::uint32_t, 4>;
  using Key = std::array<std::uint32_t, 2>;

  static constexpr Counter bits(Counter counter, Key key) {
    for (int round = 0; round < 10; ++round) {
      counter = mix(counter, key);
      key[0] += 0x9E3779B9u;  // Weyl sequences of the golden ratio and of sqrt(3) - 1 (table 2)
      key[1] += 0xBB67AE85u;
    }
    return counter;
  }

  /// Uniform on the open interval (0, 1): an odd multiple of 2^-53, hence never 0 or 1 and exactly
  /// representable. `seed` is the key; `index` the lower and `stream` the upper half of the counter.
  static constexpr double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
    const Counter out = bits({low(index), high(index), low(stream), high(stream)}, {low(seed), high(seed)});
    const std::uint64_t word = (static_cast<std::uint64_t>(out[1]) << 32) | out[0];
    return static_cast<double>((word >> 11) | 1u) * 0x1p-53;
  }

 private:
  static constexpr std::uint32_t low(std::uint64_t a) { return static_cast<std::uint32_t>(a); }
  static constexpr std::uint32_t high(std::uint64_t a) { return static_cast<std::uint32_t>(a >> 32); }

  static constexpr Counter mix(const Counter& c, const Key& key) {
    const std::uint64_t a = std::uint64_t{0xD2511F53u} * c[0], b = std::uint64_t{0xCD9E8D57u} * c[2];
    return {high(b) ^ c[1] ^ key[0], low(b), high(a) ^ c[3] ^ key[1], low(a)};
  }
};

}  // namespace seacrane
