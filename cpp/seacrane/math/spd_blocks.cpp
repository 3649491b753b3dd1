#include "seacrane/math/spd_blocks.hpp"

#include "seacrane/math/clones.hpp"

namespace seacrane {

template <>
SEACRANE_CLONES("avx2")
void SpdBlocks<double>::factor_numbers() {
  factor_all();
}

}  // namespace seacrane
