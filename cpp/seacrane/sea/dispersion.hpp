#pragma once

namespace seacrane {

/// Wavenumber k (rad/m) of omega^2 = g k tanh(k depth), omega >= 0 (rad/s), depth in m (infinity: deep
/// water).
double wavenumber(double omega, double depth, double gravity);

}  // namespace seacrane
