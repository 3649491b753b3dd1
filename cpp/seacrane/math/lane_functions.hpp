#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <numbers>
#include <type_traits>

namespace seacrane {

/// Largest |x| of sincos_lane: quadrant numbers below 2^20 keep every product of the reduction exact.
inline constexpr double sincos_limit = 1.6e6;

/// Sine and cosine of one |x| <= sincos_limit without branches, so that a loop over it becomes SIMD code.
/// x - q pi/2 with pi/2 in parts of 33, 33 and 53 bits (Cody and Waite), Taylor polynomials on [-pi/4, pi/4]
/// whose first omitted terms are (pi/4)^17/17! = 5e-17 and (pi/4)^18/18! = 2e-18, quadrant by bit selection.
/// Absolute error below 3e-16. `Bits` are unsigned integers of the size of T: one double, or a vector of
/// them.
template <class T, class Bits>
void sincos_lane(const T& x, T& sine, T& cosine) {
  constexpr double round_to_integer = 0x1.8p52;
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  constexpr double part1 = 0x1.921fb544p0, part2 = 0x1.0b4611a6p-34, part3 = 0x1.3198a2e037073p-69;
  const T shifted = x * two_over_pi + round_to_integer;
  const T q = shifted - round_to_integer;
  const T r = ((x - q * part1) - q * part2) - q * part3;
  const T z = r * r;
  const T s =
      r + r * z *
              (-1.0 / 6.0 +
               z * (1.0 / 120.0 +
                    z * (-1.0 / 5040.0 + z * (1.0 / 362880.0 +
                                              z * (-1.0 / 39916800.0 + z * (1.0 / 6227020800.0 -
                                                                            z * (1.0 / 1307674368000.0)))))));
  const T c =
      1.0 - 0.5 * z +
      z * z *
          (1.0 / 24.0 +
           z * (-1.0 / 720.0 +
                z * (1.0 / 40320.0 +
                     z * (-1.0 / 3628800.0 + z * (1.0 / 479001600.0 + z * (-1.0 / 87178291200.0 +
                                                                           z * (1.0 / 20922789888000.0)))))));
  const auto quadrant = std::bit_cast<Bits>(shifted);  // its two lowest bits
  const auto s_bits = std::bit_cast<Bits>(s), c_bits = std::bit_cast<Bits>(c);
  const Bits swap = (s_bits ^ c_bits) & (0u - (quadrant & 1u));
  const Bits sine_sign = (quadrant & 2u) << 62, cosine_sign = ((quadrant + 1u) & 2u) << 62;
  sine = std::bit_cast<T>((s_bits ^ swap) ^ sine_sign);
  cosine = std::bit_cast<T>((c_bits ^ swap) ^ cosine_sign);
}

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

/// sin x / x from y = x^2 <= pi^2, and its derivative in y: Taylor polynomial whose first omitted term is
/// pi^28 / 29! = 1e-17 with all terms, see sinc_terms for fewer. Without branches, so that a loop over it
/// becomes SIMD code.
template <class T, std::size_t count = 14>
void sinc_lane(const T& y, T& out, T& slope) {
  constexpr std::array<double, count> coefficient = [] {
    std::array<double, count> c{};
    double factorial = 1.0;
    for (std::size_t n = 0; n < count; ++n) {
      c[n] = (n % 2 == 0 ? 1.0 : -1.0) / factorial;
      factorial *= static_cast<double>((2 * n + 2) * (2 * n + 3));
    }
    return c;
  }();
  T sum = y * 0.0 + coefficient[count - 1], rise = y * 0.0;
  for (std::size_t n = count - 1; n-- > 0;) {
    rise = y * rise + sum;
    sum = y * sum + coefficient[n];
  }
  out = sum;
  slope = rise;
}
template <class T, std::size_t count = 14>
void sinc_lane(const T& y, T& out) {
  T slope;
  sinc_lane<T, count>(y, out, slope);
}
/// f(as many terms of it as leave out less than rounding up to a size of y), the number as a type.
template <class F>
inline void sinc_terms(double largest, F&& f) {
  if (largest < 0.06) return f(std::integral_constant<std::size_t, 6>());  // 0.06^6 / 13! = 8e-18
  if (largest < 1.8) return f(std::integral_constant<std::size_t, 10>());  // 1.8^10 / 21! = 7e-18
  f(std::integral_constant<std::size_t, 14>());
}

inline constexpr double sinc_end = std::numbers::pi * std::numbers::pi;  // of its main lobe, in x^2

}  // namespace seacrane
