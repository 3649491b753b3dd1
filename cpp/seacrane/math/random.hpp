#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "seacrane/math/rotation.hpp"

namespace seacrane {

/// Numbers in [-1, 1) that are the same on every platform, and what is made of them: for examples.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double number() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1.0; }
  double positive() { return 0.7 + 0.5 * number(); }
  Vec3d vector() { return {number(), number(), number()}; }
  Mat3d rotation() {
    Vec4d q(number(), number(), number(), number());
    while (q.norm() < 0.1) q = {number(), number(), number(), number()};
    return rotation_from_quaternion<double>(q);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace seacrane
