#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "seacrane/sea/sea_field.hpp"

// GCC compiles these loops again for registers of four and of eight doubles, and chooses when the program
// starts. No form fuses products and sums (cpp/CMakeLists.txt), so that all give the same bits. All that they
// call is within them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEACRANE_FLOW_LOOP __attribute__((target_clones("avx512f", "avx2", "default"), flatten))
#else
#define SEACRANE_FLOW_LOOP
#endif

/// Components side by side, for the files of the sums over them alone.
namespace seacrane::sea {
namespace {

constexpr std::size_t wide = SeaField::lanes;
typedef double FlowPack __attribute__((vector_size(8 * wide)));

inline void get(const double* from, std::size_t i, FlowPack& to) {
  std::memcpy(&to, from + i, sizeof(FlowPack));
}
inline void put(const FlowPack& from, std::size_t i, double* to) {
  std::memcpy(to + i, &from, sizeof(FlowPack));
}
inline double total(const FlowPack& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// `value` where `test` is below zero, else zero; a comparison would be a branch, as it may trap.
inline double where_negative(double test, double value) {
  const std::uint64_t negative = 0u - (std::bit_cast<std::uint64_t>(test) >> 63);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & negative);
}

using Read = const double* __restrict;
using Write = double* __restrict;

}  // namespace
}  // namespace seacrane::sea
