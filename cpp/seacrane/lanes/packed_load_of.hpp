#pragma once

#include "seacrane/lanes/packed_load.hpp"

namespace seacrane {

template <int L, class Load>
const PackedLoad<L>& packed_load() {
  using T = Pack<L>;
  static const PackedLoad<L> out{
      .kind = Load::kind,
      .apply =
          [](const LoadList& list, const LoadInput<T>& in, LoadSum<T>& sum) {
            if constexpr (TakesPacks<Load>) {
              for (const Load& load : static_cast<const LoadsOf<Load>&>(list).items) {
                load.template apply<T>(in, sum);
              }
            }
          },
      .force = [](const LoadList& list, std::size_t i, const LoadInput<T>& in, const T& value,
                  const T& rate) -> T {
        if constexpr (TakesPacks<Load> && requires(const Load& load) { load.force(in, value, rate); }) {
          return static_cast<const LoadsOf<Load>&>(list).items[i].template force<T>(in, value, rate);
        }
        return T(0.0);
      },
  };
  return out;
}

}  // namespace seacrane
