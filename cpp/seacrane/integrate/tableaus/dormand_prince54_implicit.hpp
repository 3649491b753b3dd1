#pragma once

namespace seacrane::tableaus {

/// Diagonally implicit companion of DormandPrince54: the same nodes, of stage order 2, stiffly accurate. For
/// y' = (f - A y) + A y, the first part by the explicit pair and the second by this, with any matrix A, all
/// conditions up to order 4 hold, those of order 3 and 4 that couple both parts included [Kennedy, Carpenter,
/// Applied Numerical Mathematics 44 (2003) 139, for the conditions]. Small at infinity, and A-stable but for
/// 6e-4 on the imaginary axis. Its free coefficients were found by a search for stability, also where A is
/// wrong by a quarter, and for small errors where fast states follow slow ones.
struct DormandPrince54Implicit {
  static constexpr double a[7][7] = {
      {0},
      {0.1, 0.1},
      {0.1284904428287834, 0.06452867151364762, 0.10698088565756944},
      {0.24901086123165617, 1.0041441736641636, -0.9633903863676501, 0.5102353514718294},
      {0.6338592906411675, 3.472790609655979, -4.48237500519982, 0.8874587226477578, 0.3771552711438064},
      {0.5590369949604203, 3.3356907828819375, -4.190513378982884, 1.1067798123283292, -0.14027596599254358,
       0.32928175480474164},
      {0.0827790723375943, 0, 0.47810275132401736, 0.4000388367945601, 0.022871109390124718,
       -0.15348382384434167, 0.16969205399804438}};
};

}  // namespace seacrane::tableaus
