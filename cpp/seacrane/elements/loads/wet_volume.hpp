#pragma once

#include <cmath>
#include <numbers>

#include "seacrane/math/dual.hpp"
#include "seacrane/math/pack.hpp"
#include "seacrane/math/select.hpp"
#include "seacrane/math/types.hpp"

/// Exact volumes of simple bodies below a level surface, at any attitude.
///
/// The height of a point of a box over its centre is a sum of three independent numbers, each uniform within
/// +-w_i = n_i c_i, with c_i half a length and n_i the cosine of its axis with the vertical; that of a
/// cylinder is the sum of one as a disc has it, within +-w_d, and a uniform one. So the wet share of the
/// volume is the distribution of that sum. Its integral over the depth of the centre is the energy of the
/// buoyancy, of which force and moment are the exact gradient.
namespace seacrane {

/// Share of the volume that is wet at the depth of the centre; its integral over the depth, m, and the
/// derivatives of that in the half widths w.
template <class T>
struct WetShare {
  T share = T(0), integral = T(0);
  Vec3<T> over_width = Vec3<T>::Zero();
};

/// A number with a known derivative: a function of x that is f at x, with the slope df.
inline double with_slope(double /*x*/, double f, double /*df*/) { return f; }
template <int N>
Dual<N> with_slope(const Dual<N>& x, double f, double df) {
  return x.chain(f, df);
}

/// Part of a disc of radius one below x, its first and its second integral from -1 on.
template <class T>
struct DiscShare {
  T share = T(0), first = T(0), second = T(0);

  explicit DiscShare(const T& at) {
    using std::numbers::pi;
    const double x = value_of(at);
    if (x <= -1.0) return;
    if (x >= 1.0) {
      share = T(1);
      first = at;
      second = T(0.5) * at * at + T(0.125);
      return;
    }
    const double root = std::sqrt((1.0 - x) * (1.0 + x)), angle = std::asin(x);
    const double part = 0.5 + (x * root + angle) / pi;
    const double once = x * part + 2.0 * root * root * root / (3.0 * pi);
    const double moment = (angle - x * root * (1.0 - 2.0 * x * x)) / 8.0 + pi / 16.0;
    const double twice = x * once - 0.5 * x * x * part + moment / pi;
    share = with_slope(at, part, 2.0 * root / pi);
    first = with_slope(at, once, part);
    second = with_slope(at, twice, once);
  }
};

/// A box of half widths w along the vertical, each above zero, its centre at `depth`.
template <class T>
WetShare<T> wet_box(const T& depth, const Vec3<T>& w) {
  WetShare<T> out;
  const T half = w[0] + w[1] + w[2];
  const auto dry = depth <= -half, sunk = depth >= half;
  if (all(dry)) return out;
  if (all(sunk)) {
    out.share = T(1);
    out.integral = depth;
    return out;
  }
  // Sums over the corners of a cube of what is above zero, by pairs along the last axis: those with both of
  // the first two, with one of them, with none.
  T pair[4], fourth[4], both[4];
  const T middle[4] = {depth + w[0] + w[1], depth + w[0] - w[1], depth - w[0] + w[1], depth - w[0] - w[1]};
  for (int n = 0; n < 4; ++n) {
    const T above = middle[n] + w[2], below = middle[n] - w[2];
    const T high = select(above > T(0), above, T(0)), low = select(below > T(0), below, T(0));
    const T high_cube = high * high * high, low_cube = low * low * low;
    pair[n] = high_cube - low_cube;
    both[n] = high_cube + low_cube;
    fourth[n] = high * high_cube - low * low_cube;
  }
  const T over = T(1.0 / 48.0) / (w[0] * w[1] * w[2]);
  out.share = (pair[0] - pair[1] - pair[2] + pair[3]) * over;
  out.integral = (fourth[0] - fourth[1] - fourth[2] + fourth[3]) * (T(0.25) * over);
  out.over_width[0] = pair[0] - pair[1] + pair[2] - pair[3];
  out.over_width[1] = pair[0] + pair[1] - pair[2] - pair[3];
  out.over_width[2] = both[0] - both[1] - both[2] + both[3];
  for (int i = 0; i < 3; ++i) out.over_width[i] = out.over_width[i] * over - out.integral / w[i];
  const auto in_part = [&](T& value, const T& of_sunk) {
    value = select(dry, T(0), select(sunk, of_sunk, value));
  };
  in_part(out.share, T(1));
  in_part(out.integral, depth);
  for (int i = 0; i < 3; ++i) in_part(out.over_width[i], T(0));
  return out;
}

/// A cylinder: w[0] half its length, w[1] its radius, along the vertical, each above zero.
template <class T>
WetShare<T> wet_cylinder(const T& depth, const Vec3<T>& w) {
  WetShare<T> out;
  const T &along = w[0], &disc = w[1];
  if (depth <= -(along + disc)) return out;
  if (depth >= along + disc) {
    out.share = T(1);
    out.integral = depth;
    return out;
  }
  const DiscShare<T> high((depth + along) / disc), low((depth - along) / disc);
  const T over = T(0.5) / along;
  out.share = disc * (high.first - low.first) * over;
  out.integral = disc * disc * (high.second - low.second) * over;
  out.over_width[0] = (disc * (high.first + low.first) - T(2) * out.integral) * over;
  // The integral is homogeneous of degree one in depth and widths.
  out.over_width[1] = (out.integral - depth * out.share - along * out.over_width[0]) / disc;
  return out;
}

/// A sphere of radius r.
template <class T>
WetShare<T> wet_sphere(const T& depth, double r) {
  WetShare<T> out;
  const T h = clamped(T((depth + T(r)) / T(r)), T(0), T(2));  // pi h^2 (1 - h / 3) over 4 pi / 3
  out.share = T(0.25) * h * h * (T(3) - h);
  out.integral = T(r) * h * h * h * (T(0.25) - h / T(16)) + select(depth > T(r), T(depth - T(r)), T(0));
  return out;
}

template <int L>
WetShare<Pack<L>> wet_cylinder(const Pack<L>& depth, const Vec3<Pack<L>>& w) {
  WetShare<Pack<L>> out;
  for (int lane = 0; lane < L; ++lane) {
    const WetShare<double> one = wet_cylinder(depth[lane], Vec3d(w[0][lane], w[1][lane], w[2][lane]));
    out.share.set(lane, one.share);
    out.integral.set(lane, one.integral);
    for (int i = 0; i < 3; ++i) out.over_width[i].set(lane, one.over_width[i]);
  }
  return out;
}

inline constexpr double kRoundedShare = 1e-3;  // of half a size, or of a cosine

/// |n|, rounded off at zero, exact at 0 and 1, from n^2; and its derivative in n^2.
template <class T>
struct Rounded {
  T value, slope;
  explicit Rounded(const T& square) {
    using std::sqrt;
    const double whole = std::sqrt(1.0 + kRoundedShare * kRoundedShare) - kRoundedShare;
    const T root = sqrt(square + T(kRoundedShare * kRoundedShare));
    value = (root - T(kRoundedShare)) * T(1.0 / whole);
    slope = T(0.5 / whole) / root;
  }
};

}  // namespace seacrane
