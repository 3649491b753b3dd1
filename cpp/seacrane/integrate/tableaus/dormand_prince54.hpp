#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// Dormand and Prince 5(4), first-same-as-last, with its dense output of order 4 [Hairer, Norsett, Wanner,
/// Solving Ordinary Differential Equations I, table II.5.2 and section II.6].
struct DormandPrince54 {
  static constexpr const char* name = "dopri5";
  static constexpr const char* kind = "explicit pair (Dormand, Prince)";
  static constexpr const char* purpose = "the default; many other programs have it too";
  static constexpr int order = 5, error_order = 4, dense_order = 4;
  static constexpr std::size_t stages = 6, extra_stages = 0;
  static constexpr long double a[7][6] = {
      {0},
      {1.0L / 5},
      {3.0L / 40, 9.0L / 40},
      {44.0L / 45, -56.0L / 15, 32.0L / 9},
      {19372.0L / 6561, -25360.0L / 2187, 64448.0L / 6561, -212.0L / 729},
      {9017.0L / 3168, -355.0L / 33, 46732.0L / 5247, 49.0L / 176, -5103.0L / 18656},
      {35.0L / 384, 0, 500.0L / 1113, 125.0L / 192, -2187.0L / 6784, 11.0L / 84}};
  static constexpr long double error[7] = {71.0L / 57600,      0,           -71.0L / 16695, 71.0L / 1920,
                                           -17253.0L / 339200, 22.0L / 525, -1.0L / 40};
  static constexpr long double dense[7][4] = {
      {1, -8048581381.0L / 2820520608, 8663915743.0L / 2820520608, -12715105075.0L / 11282082432},
      {0, 0, 0, 0},
      {0, 131558114200.0L / 32700410799, -68118460800.0L / 10900136933, 87487479700.0L / 32700410799},
      {0, -1754552775.0L / 470086768, 14199869525.0L / 1410260304, -10690763975.0L / 1880347072},
      {0, 127303824393.0L / 49829197408, -318862633887.0L / 49829197408, 701980252875.0L / 199316789632},
      {0, -282668133.0L / 205662961, 2019193451.0L / 616988883, -1453857185.0L / 822651844},
      {0, 40617522.0L / 29380423, -110615467.0L / 29380423, 69997945.0L / 29380423}};
};

}  // namespace seacrane::tableaus
