#pragma once

#include <cmath>

namespace seacrane {

/// One of two values, both of which have been computed: what templates on the scalar use in place of a branch
/// on compared values.
template <class T>
const T& select(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}

/// Whether a condition holds in any lane, or in all.
constexpr bool any(bool condition) { return condition; }
constexpr bool all(bool condition) { return condition; }

/// A value where a formula holds for it; elsewhere `fail`, called with the value, throws.
template <class T, class Fail>
const T& valid_where(bool holds, const T& value, Fail&& fail) {
  if (!holds) fail(value);
  return value;
}

/// f of a number, which gives three; of a pack lane by lane: what looks up tables.
template <class T, class F>
auto lane_by_lane(const T& value, F&& f) {
  return f(value);
}

template <class T>
T clamped(const T& value, const T& low, const T& high) {
  return select(value < low, low, select(value > high, high, value));
}

/// Cosine and sine of one angle.
template <class T>
struct CosSin {
  T cosine, sine;
};
template <class T>
CosSin<T> cos_sin(const T& angle) {
  using std::cos, std::sin;
  return {cos(angle), sin(angle)};
}

}  // namespace seacrane
