#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// How far a point is outside a surface, negative inside it, and the way out there.
template <class T>
struct SurfaceDistance {
  T distance;
  Vec3<T> normal;
};

/// The surface of a body in axes of its own: a plane z = 0 with all below it inside, a box, a round post
/// along z, or the wall of a pipe along z. Edges are round, so that a point does not fall off with a jump.
struct ContactSurface {
  enum class Shape { plane, box, post, pipe };

  Shape shape = Shape::plane;
  Vec3d half = Vec3d::Zero();  // of a box; of a post or wall: half its thickness, unused, half its length
  double middle = 0.0;         // radius of the middle of a wall
  double edge = 0.0;           // radius of its edges

  /// m: no shorter way leads through it but past its edges.
  double thin() const {
    if (shape == Shape::plane) return std::numeric_limits<double>::infinity();
    return shape == Shape::box ? half.minCoeff() : std::min(half.x(), half.z());
  }

  template <class T>
  SurfaceDistance<T> at(const Vec3<T>& x) const {
    if (shape == Shape::plane) return {x.z(), Vec3<T>(T(0), T(0), T(1))};
    if (shape == Shape::box) {
      const auto out = round_box<3, T>({x.x(), x.y(), x.z()}, {half.x(), half.y(), half.z()});
      return {out.distance, Vec3<T>(out.way[0], out.way[1], out.way[2])};
    }
    using std::sqrt;
    const T radius = sqrt(x.x() * x.x() + x.y() * x.y() + T(kOnAxis * kOnAxis));
    const auto out = round_box<2, T>({radius - T(middle), x.z()}, {half.x(), half.z()});
    const T across = out.way[0] / radius;
    return {out.distance, Vec3<T>(across * x.x(), across * x.y(), out.way[1])};
  }

 private:
  static constexpr double kOnAxis = 1e-9;  // m: the distance to an axis has a slope there too

  template <int N, class T>
  struct Way {
    T distance;
    std::array<T, N> way;
  };

  /// A box of N dimensions about the origin.
  template <int N, class T>
  Way<N, T> round_box(const std::array<T, N>& x, const std::array<double, N>& halves) const {
    using std::sqrt;
    std::array<T, N> beyond, sign;
    T square(0);
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < N; ++i) {
      sign[i] = x[i] < T(0) ? T(-1) : T(1);
      beyond[i] = sign[i] * x[i] - T(halves[i] - edge);
      if (beyond[i] > T(0)) square += beyond[i] * beyond[i];
      if (beyond[i] > beyond[nearest]) nearest = i;
    }
    Way<N, T> out;
    out.way.fill(T(0));
    if (!(square > T(0))) {
      out.way[nearest] = sign[nearest];
      out.distance = beyond[nearest] - T(edge);
      return out;
    }
    const T root = sqrt(square);
    for (std::size_t i = 0; i < N; ++i) {
      if (beyond[i] > T(0)) out.way[i] = sign[i] * beyond[i] / root;
    }
    out.distance = root - T(edge);
    return out;
  }
};

}  // namespace seacrane
