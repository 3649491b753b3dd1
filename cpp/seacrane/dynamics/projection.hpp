#pragma once

/// Drift removal by Newton's method, on position and then on rate level, for constraints in any coordinates.
namespace seacrane::projection {

inline constexpr int kIterations = 12;
inline constexpr double kRateTolerance = 1e-13;  // m/s or rad/s
/// Residuals below it that no longer halve are rounding; positions and rates.
inline constexpr double kRounding = 1e-11;

/// Closes positions that are open by `worst` to `tolerance`. correct(i) takes the i-th Newton step and
/// returns the residual that it leaves. Whether there was a step.
template <class Correct>
bool close_positions(double worst, double tolerance, Correct&& correct) {
  bool changed = false;
  for (int i = 0; worst > tolerance && i < kIterations; ++i) {
    const double next = correct(i);
    changed = true;
    if (!(next < 0.5 * worst) && next < kRounding) break;
    worst = next;
  }
  return changed;
}

/// Projects rates. Their equations are linear: after two corrections, what is left is rounding.
template <class Residual, class Correct>
bool close_rates(Residual&& residual, Correct&& correct) {
  bool changed = false;
  for (int i = 0; i < kIterations; ++i) {
    const double rate = residual();
    if (!(rate > kRateTolerance) || (i >= 2 && rate < kRounding)) break;
    correct();
    changed = true;
  }
  return changed;
}

}  // namespace seacrane::projection
