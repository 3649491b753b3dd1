#pragma once

#include <type_traits>

#include "seacrane/elements/loads/load_list.hpp"
#include "seacrane/math/pack.hpp"

namespace seacrane {

/// Loads of one kind on packs.
template <int L>
struct PackedLoad {
  using T = Pack<L>;
  const char* kind;
  void (*apply)(const LoadList& list, const LoadInput<T>& in, LoadSum<T>& sum);
  T (*force)(const LoadList& list, std::size_t i, const LoadInput<T>& in, const T& value, const T& rate);
};

/// Made in the object of that load, in a module of lanes.
template <int L, class Load>
const PackedLoad<L>& packed_load();

}  // namespace seacrane
