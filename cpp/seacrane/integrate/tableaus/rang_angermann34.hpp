#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// ROS34PW2: four stages, order 3(2) as a W-method, that is with any matrix in the place of the Jacobian;
/// stiffly accurate, L-stable with the exact one [J. Rang, L. Angermann, New Rosenbrock W-methods of order 3
/// for partial differential algebraic equations of index 1, BIT 45 (2005) 761].
struct RangAngermann34 {
  static constexpr std::size_t stages = 4;
  static constexpr double gamma = 4.3586652150845900e-01;
  static constexpr double a[4][4] = {
      {0}, {8.7173304301691801e-01}, {8.4457060015369423e-01, -1.1299064236484185e-01}, {0, 0, 1}};
  /// Below the diagonal, on which all are `gamma`.
  static constexpr double coupling[4][4] = {
      {0},
      {-8.7173304301691801e-01},
      {-9.0338057013044082e-01, 5.4180672388095326e-02},
      {2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01}};
  static constexpr double b[4] = {2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00,
                                  4.3586652150845900e-01};
  static constexpr double embedded[4] = {3.7810903145819369e-01, -9.6042292212423178e-02,
                                         5.0000000000000000e-01, 2.1793326075422950e-01};
};

}  // namespace seacrane::tableaus
