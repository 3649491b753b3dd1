#pragma once

#include <cmath>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Friction of a point that hangs on its anchor by a spring and a damper: with no bound, by `pull`.
template <class T, int n>
struct BristleFriction {
  Eigen::Matrix<T, n, 1> force;   // against the motion, `most` long at the most
  Eigen::Matrix<T, n, 1> follow;  // rate of the anchor: slip alone, exactly 0 while friction holds
  bool slides = false;
};

/// `pull` is k z + c s with the way z from the anchor and the rate s. Beyond `most` the anchor follows, by
/// (pull - force) / c.
template <class T, int n>
BristleFriction<T, n> bristle_friction(const Eigen::Matrix<T, n, 1>& pull, const T& most, double damper) {
  using std::sqrt;
  BristleFriction<T, n> out{pull, Eigen::Matrix<T, n, 1>::Zero()};
  const T square = pull.squaredNorm();
  out.slides = square > most * most;
  if (!out.slides) return out;
  const T share = most / sqrt(square);
  out.force = pull * share;
  out.follow = pull * ((T(1) - share) / T(damper));
  return out;
}

}  // namespace seacrane
