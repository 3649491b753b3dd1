#pragma once

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Forces f >= 0 of unilateral contacts with w = G f + b >= 0 and f^T w = 0: the least f^T G f / 2 + b^T f,
/// by the active set method of C. L. Lawson and R. J. Hanson (Solving Least Squares Problems, 1974, ch. 23).
/// G is symmetric and may be singular, where contacts depend on each other: w is unique, f one of many.
VecXd complementary_forces(const MatXd& g, const VecXd& b);

}  // namespace seacrane
