#pragma once

#include <cstddef>

namespace seacrane::tableaus {

/// The classical Runge-Kutta method of order 4; the derivative at the end of the step makes the embedded
/// method of order 3 [RK4(3)T of J. R. Dormand and P. J. Prince, New Runge-Kutta algorithms for numerical
/// simulation in dynamical astronomy, Celest. Mech. 18 (1978) 223]. Dense output of order 4 is the quartic of
/// rk4: the cubic Hermite polynomial, its slope corrected at (3 - sqrt 3) / 6.
struct RungeKutta43 {
  static constexpr const char* name = "rk43";
  static constexpr int order = 4, error_order = 3, dense_order = 4;
  static constexpr std::size_t stages = 4, extra_stages = 1;
  static constexpr long double a[6][5] = {
      {0},
      {0.5L},
      {0, 0.5L},
      {0, 0, 1},
      {1.0L / 6, 1.0L / 3, 1.0L / 3, 1.0L / 6},
      {0.1506291591891770620969681L, 0.03836660684674983010907805L, 0.03836660684674983010907805L,
       0.01918330342337491505453902L, -0.0352208109008645196242376L}};
  static constexpr long double error[5] = {0, 0, 0, 0.1L, -0.1L};
  static constexpr long double dense[6][4] = {
      {1L, -3.866025403784438646763723L, 5.398717474235543960194113L, -2.366025403784438646763723L},
      {0, -0.7320508075688772935274463L, 2.797434948471087920388226L, -1.732050807568877293527446L},
      {0, -0.7320508075688772935274463L, 2.797434948471087920388226L, -1.732050807568877293527446L},
      {0, -0.3660254037844386467637232L, 1.398717474235543960194113L, -0.8660254037844386467637232L},
      {0, 0.5L, -2L, 1.5L},
      {0, 5.196152422706631880582339L, -10.39230484541326376116468L, 5.196152422706631880582339L}};
};

}  // namespace seacrane::tableaus
