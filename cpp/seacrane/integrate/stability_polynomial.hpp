#pragma once

#include <string>
#include <vector>

namespace seacrane {

/// Coefficients of the stability polynomial R(z) of an explicit Runge-Kutta method, lowest power first: a
/// step h of y' = lambda y multiplies y by R(h lambda) [Hairer, Wanner, Solving Ordinary Differential
/// Equations II, IV.2]. From the tableau that the method steps with; empty for an integrator that has none of
/// its own.
std::vector<double> stability_polynomial(const std::string& integrator);

}  // namespace seacrane
