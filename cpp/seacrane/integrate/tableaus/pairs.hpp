#pragma once

#include <tuple>

#include "seacrane/integrate/tableaus/bogacki_shampine32.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54.hpp"
#include "seacrane/integrate/tableaus/dormand_prince853.hpp"
#include "seacrane/integrate/tableaus/tsitouras54.hpp"
#include "seacrane/integrate/tableaus/verner65.hpp"
#include "seacrane/integrate/tableaus/verner76.hpp"

namespace seacrane::tableaus {

/// The explicit pairs, in the order of documents and tables. A new one is added here and nowhere else.
using Pairs =
    std::tuple<BogackiShampine32, DormandPrince54, Tsitouras54, Verner65, Verner76, DormandPrince853>;

}  // namespace seacrane::tableaus
