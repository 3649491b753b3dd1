#include "seacrane/sea/knot_table.hpp"

#include "seacrane/math/clones.hpp"

namespace seacrane {

SEACRANE_CLONES("avx2")
void interpolate(double s, const TableKnot* const (&knots)[4], double (&out)[TableKnot::lanes]) {
  const HermiteWeights w(s);
  double sum[TableKnot::lanes] = {};
  for (int k = 0; k < 4; ++k) {
    const TableKnot& knot = *knots[k];
    for (std::size_t j = 0; j < TableKnot::lanes; ++j) {
      sum[j] +=
          w.value[k] * knot.value[j] + w.rate[k] * knot.rate[j] + w.acceleration[k] * knot.acceleration[j];
    }
  }
  std::copy_n(sum, TableKnot::lanes, out);
}

}  // namespace seacrane
