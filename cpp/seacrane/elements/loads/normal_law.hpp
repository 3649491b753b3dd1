#pragma once

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

}  // namespace seacrane
