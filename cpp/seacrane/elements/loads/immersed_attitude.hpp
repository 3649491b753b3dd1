#pragma once

#include <cmath>

#include "seacrane/elements/loads/immersed_part_description.hpp"
#include "seacrane/elements/loads/wet_volume.hpp"

namespace seacrane {

/// How a part lies in the water: how far it reaches down, and over which depths its added mass is a mean.
template <class T>
struct ImmersedAttitude {
  using Shape = ImmersedPartDescription::Shape;

  Mat3<T> axes;                    // of the part, inertial
  Vec3<T> half = Vec3<T>::Zero();  // of the widths along the vertical
  T below = T(0), reaches = T(0);  // its lowest point under its centre, and how fast that sinks
  /// Of a round part: depths within `along` of its centre's plus `shift`, in planes that it reaches `across`
  /// into either way; and their rates.
  T shift = T(0), along = T(0), across = T(0);
  T shift_rate = T(0), along_rate = T(0), across_rate = T(0);

  /// With edges that are round by `edge`, turning in inertial axes.
  ImmersedAttitude(Shape shape, const Vec3d& size, double edge, const Mat3<T>& axes, const Vec3<T>& turning)
      : axes(axes) {
    if (shape == Shape::sphere || shape == Shape::table) {
      below = T(0.5 * size[2]);
      return;
    }
    const auto reach = [&](int axis, const T& square, const T& square_rate) {
      using std::sqrt;
      const double width = 0.5 * size[axis];
      const Rounded<T> share(square);
      half[axis] = sqrt(T(width * width) * square + T(edge * edge));
      below += T(width) * share.value;
      reaches += T(width) * share.slope * square_rate;
    };
    for (int i = 0; i < (shape == Shape::box ? 3 : 1); ++i) {
      const T n = axes(2, i), n_rate = turning.x() * axes(1, i) - turning.y() * axes(0, i);
      const T square = n * n, square_rate = T(2) * n * n_rate;
      if (shape == Shape::disc) {
        half[0] = T(edge);
      } else {
        reach(i, square, square_rate);
      }
      if (shape == Shape::box) continue;
      reach(1, T(1) - square, -square_rate);
      look_through(shape, size, n, n_rate);
    }
  }

  /// For parts side by side, to which it is one.
  template <class S>
  explicit ImmersedAttitude(const ImmersedAttitude<S>& one)
      : axes(one.axes.template cast<T>()),
        half(one.half.template cast<T>()),
        below(one.below),
        reaches(one.reaches),
        shift(one.shift),
        along(one.along),
        across(one.across),
        shift_rate(one.shift_rate),
        along_rate(one.along_rate),
        across_rate(one.across_rate) {}

 private:
  static constexpr double kLeast = 1e-6;      // of a radius: no attitude is singular
  static constexpr double kStruck = 0.4;      // 2 / C_S, with C_S 5 of what is flat
  static constexpr double kRoundEnds = 0.25;  // of the depth over which a disc is struck

  /// With half of the length exact, so that strips add up to the whole.
  void look_through(Shape shape, const Vec3d& size, const T& n, const T& n_rate) {
    const double radius = 0.5 * size[1];
    const Rounded<T> share(T(1) - n * n);
    across = T(radius) * (T(1.0 - kLeast) * share.value + T(kLeast));
    across_rate = T(-2.0 * (1.0 - kLeast) * radius) * share.slope * n * n_rate;
    if (shape == Shape::disc) return look_through_disc(size[0], n, n_rate);
    const double length = n < T(0) ? -0.5 * size[0] : 0.5 * size[0];
    along = T(length) * n;
    along_rate = T(length) * n_rate;
  }

  /// A disc, x out of what it closes, gains its water over `depth` as it goes under facing up, by its C_S
  /// facing down, with rounded ends; one that stands on its edge gains it as it becomes wet.
  void look_through_disc(double depth, const T& n, const T& n_rate) {
    using std::sqrt;
    const double mean = 0.25 * (1.0 + kStruck) * depth, odd = 0.25 * (1.0 - kStruck) * depth;
    const double round = kRoundEnds * kStruck * depth;
    const T steep = sqrt(n * n + T(kRoundedShare * kRoundedShare));
    along = T(mean) * steep + T(odd) * n;
    along_rate = (T(mean) * n / steep + T(odd)) * n_rate;
    shift = T(-round) - along;
    shift_rate = -along_rate;
    across += T(round);
  }
};

}  // namespace seacrane
