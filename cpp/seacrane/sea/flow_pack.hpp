#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "seacrane/sea/sea_field.hpp"

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
