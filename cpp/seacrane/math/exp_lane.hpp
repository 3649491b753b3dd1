#pragma once

#include <bit>

namespace seacrane {

/// Exponential of one x <= 700 without branches, so that a loop over it becomes SIMD code; below -700 that of
/// -700. x - n ln 2 with ln 2 in parts of 32 and 53 bits, Taylor polynomial on [-ln 2 / 2, ln 2 / 2] whose
/// first omitted term is (ln 2 / 2)^14 / 14! = 4e-18, the power of two by its bits. Relative error below
/// 4e-16. `Bits` are unsigned integers of the size of T: one double, or a vector of them.
template <class T, class Bits>
void exp_lane(const T& x, T& out) {
  constexpr double round_to_integer = 0x1.8p52, log2_e = 0x1.71547652b82fep0;
  constexpr double part1 = 0x1.62e42feep-1, part2 = 0x1.a39ef35793c76p-33;
  // A comparison would be a branch, as it may trap: the sign of x - least chooses.
  const T least = T{} - 700.0;
  const auto below = Bits{} - (std::bit_cast<Bits>(T(x - least)) >> 63);
  const T above = std::bit_cast<T>((std::bit_cast<Bits>(least) & below) | (std::bit_cast<Bits>(x) & ~below));
  const T shifted = above * log2_e + round_to_integer;
  const T n = shifted - round_to_integer;
  const T r = (above - n * part1) - n * part2;
  // Two chains of even and odd powers, half as long.
  const T z = r * r;
  const T even =
      1.0 +
      z * (1.0 / 2.0 +
           z * (1.0 / 24.0 +
                z * (1.0 / 720.0 + z * (1.0 / 40320.0 + z * (1.0 / 3628800.0 + z * (1.0 / 479001600.0))))));
  const T odd =
      1.0 +
      z * (1.0 / 6.0 +
           z * (1.0 / 120.0 + z * (1.0 / 5040.0 + z * (1.0 / 362880.0 +
                                                       z * (1.0 / 39916800.0 + z * (1.0 / 6227020800.0))))));
  const Bits power = (std::bit_cast<Bits>(shifted) + 1023u) << 52;
  out = (even + r * odd) * std::bit_cast<T>(power);
}

}  // namespace seacrane
