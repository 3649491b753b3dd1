#pragma once

#include <cmath>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// What a surface that gives presses back with: an elastic part and one that takes energy.
template <class T>
struct NormalForce {
  T elastic{0}, viscous{0};

  T total() const { return elastic + viscous; }
};

/// The law of K. H. Hunt and F. R. E. Crossley (J. Appl. Mech. 42, 1975): elastic (1 + damping p') at a depth
/// p that grows at the rate p', and never a pull. It is continuous where the surface is touched.
template <class T>
NormalForce<T> hunt_crossley(const T& elastic, double damping, const T& rate) {
  const T viscous = T(damping) * rate * elastic;
  if (elastic + viscous < T(0)) return {elastic, -elastic};
  return {elastic, viscous};
}

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
