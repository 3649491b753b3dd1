#pragma once

#include <Eigen/Core>
#include <vector>

namespace seacrane::strip {

/// Weights (station, power) of the integrals over x of f(x) x^power, power 0, 1, 2, for f given at the
/// stations and linear between them; exact.
Eigen::MatrixX3d moment_weights(const std::vector<double>& x);

/// Weights of the integrals of f(x) x^power exp(-i k x), power 0, 1 (Filon's rule): exact for any k, so that
/// short waves need no more stations than the shape of f does.
Eigen::MatrixX2cd oscillatory_weights(const std::vector<double>& x, double k);

}  // namespace seacrane::strip
