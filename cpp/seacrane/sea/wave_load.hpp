#pragma once

#include "seacrane/sea/exact_wave_load.hpp"
#include "seacrane/sea/wave_table.hpp"
