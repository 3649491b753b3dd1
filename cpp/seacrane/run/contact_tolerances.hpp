#pragma once

namespace seacrane {

constexpr double kTouch = 1e-10;  // m or rad: gaps below it are closed, and overlaps rounding
constexpr double kParted = 1e-9;  // m or rad: closed limits further open cannot all hold
constexpr double kStill = 1e-9;   // m/s or rad/s: rates that are rounding

}  // namespace seacrane
