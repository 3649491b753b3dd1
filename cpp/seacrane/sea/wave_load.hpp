#pragma once

#include "seacrane/sea/drift_load.hpp"
#include "seacrane/sea/exact_wave_load.hpp"
#include "seacrane/sea/knot_table.hpp"
#include "seacrane/sea/positioned_wave_load.hpp"

namespace seacrane {

/// First-order wave load at the mean position. The default bound of 1e-9 is about 1e-8 of a load's standard
/// deviation with 200 components: a hundred times below what an integrator at relative tolerance 1e-6
/// resolves.
using WaveTable = KnotTable<ExactWaveLoad>;
using WaveTableBlock = KnotBlock<ExactWaveLoad>;

using DriftTable = KnotTable<DriftLoad>;
using DriftTableBlock = KnotBlock<DriftLoad>;

}  // namespace seacrane
