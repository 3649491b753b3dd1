#pragma once

#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "seacrane/math/dual.hpp"
#include "seacrane/sea/realisation.hpp"
#include "seacrane/sea/sea_field.hpp"

namespace seacrane::test {

/// Waves of random frequency, height, phase and direction.
struct RandomSea {
  std::mt19937_64 engine;
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vec3d vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

  WaveComponents waves(std::size_t count, double depth, const Current& current = {}, double factor = 1.0) {
    std::vector<double> omega, amplitude, phase, direction;
    for (std::size_t i = 0; i < count; ++i) {
      omega.push_back(number(0.3, 2.4));
      amplitude.push_back(factor * number(0.0, 2.0) / static_cast<double>(count));
      phase.push_back(number(0.0, 6.28));
      direction.push_back(number(-3.1, 3.1));
    }
    return {omega, amplitude, phase, direction, depth, standard_gravity, current};
  }
  /// A long-crested sea of 200 components.
  std::shared_ptr<const SeaField> long_crested(double depth, const Current& current) {
    RealisationOptions o;
    o.direction = number(-3.1, 3.1);
    o.seed = engine();
    o.depth = depth;
    const WaveComponents w = realise(Spectrum::jonswap(2.0, number(5.0, 13.0)), o);
    return std::make_shared<const SeaField>(
        WaveComponents(w.omega(), w.amplitude(), w.phase(), w.direction(), depth, standard_gravity, current));
  }
};

/// A current that turns with depth.
inline Current shear() { return Current({0.0, 5.0, 30.0}, {0.6, 0.4, 0.1}, {0.0, 0.2, 0.1}); }

/// A point whose coordinates are the variables.
inline Vec3<Dual<3>> variables(const Vec3d& p) {
  Vec3<Dual<3>> out;
  for (int i = 0; i < 3; ++i) out[i] = Dual<3>::variable(p[i], i);
  return out;
}

}  // namespace seacrane::test
