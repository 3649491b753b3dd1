#pragma once

#include "seacrane/sea/drift_load.hpp"
#include "seacrane/sea/exact_wave_load.hpp"
#include "seacrane/sea/positioned_wave_load.hpp"
#include "seacrane/sea/wave_table.hpp"
