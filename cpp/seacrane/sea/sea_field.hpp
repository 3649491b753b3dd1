#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "seacrane/math/dual.hpp"
#include "seacrane/math/lane_functions.hpp"
#include "seacrane/math/types.hpp"
#include "seacrane/sea/stretching.hpp"
#include "seacrane/sea/wave_components.hpp"

namespace seacrane {

/// The undisturbed sea at one point, inertial axes; zeros are still water. T is double, or a Dual, whose
/// slopes are over what the point depends on.
///
/// Above the water's level velocity, acceleration and pressure are those at the level, not zero: what is in
/// air leaves by its wetted area, so that nothing jumps.
template <class T>
struct LocalFlow {
  T elevation = T(0);                      // m, of the surface above or below the point
  T elevation_rate = T(0);                 // m/s, at fixed x and y; an element that turns feels it turn
  std::array<T, 2> slope{};                // of the surface over x and y
  Vec3<T> velocity = Vec3<T>::Zero();      // m/s, of the water, the current included
  Vec3<T> acceleration = Vec3<T>::Zero();  // m/s2, of the water: u_t + (U . grad) u, first order in the waves
  T pressure = T(0);                       // m2/s2, dynamic, over density; without the hydrostatic -g z

  /// f(there, here) for every number of two flows.
  template <class S, class F>
  static void each(const LocalFlow<S>& from, LocalFlow& to, F&& f) {
    f(from.elevation, to.elevation);
    f(from.elevation_rate, to.elevation_rate);
    for (std::size_t i = 0; i < 2; ++i) f(from.slope[i], to.slope[i]);
    for (int i = 0; i < 3; ++i) f(from.velocity[i], to.velocity[i]);
    for (int i = 0; i < 3; ++i) f(from.acceleration[i], to.acceleration[i]);
    f(from.pressure, to.pressure);
  }
};

/// What is below the surface of an upright element.
template <class T>
struct WetHeight {
  T middle, height;
};

/// Of an element of a height with its middle at z; of one in air, none.
template <class T>
WetHeight<T> wet_height(const T& z, const T& height, const T& elevation) {
  const T half = T(0.5) * height, emerged = z + half - elevation;
  if (!(height > T(0)) || !(emerged > T(0))) return {z, height};
  const T dry = emerged < height ? emerged : height;
  return {z - T(0.5) * dry, height - dry};
}

/// The waves and the current of a scene as sums over components take them: by wavenumber, so that those that
/// reach a depth are the first ones, and in whole packs of `lanes`, filled up by waves of no height.
/// Immutable.
///
/// With c = cosh k(z + d), s = sinh k(z + d), S = sinh kd, each component of amplitude a, frequency omega for
/// a fixed observer and sigma = omega - k U for the water, phase angle theta, adds to first order
///   elevation a cos theta, velocity along it a sigma c/S cos theta and upwards -a sigma s/S sin theta,
///   accelerations -a sigma^2 c/S sin theta and -a sigma^2 s/S cos theta,
///   pressure over density a sigma^2 / k c/S cos theta.
class SeaField {
 public:
  static constexpr std::size_t lanes = 4;

  explicit SeaField(const WaveComponents& waves, Stretching stretching = Stretching::wheeler);
  /// The same water with its current, and waves of no height.
  SeaField without_waves() const;
  /// The same water with some of its wavenumbers, waves of unit height that stand still at t = 0, for sums in
  /// which accelerations and the pressure take g times the elevation's phasors, the velocity those of a
  /// potential: omega = 1, sigma = g.
  SeaField of_unit_height(const std::vector<std::size_t>& kept) const;

  /// One number for each component, padded.
  struct Arrays {
    std::vector<double> omega, sigma, k, kx, ky, x, y;  // x, y: cosine and sine of the direction
    std::vector<double> amplitude, phase;
    std::vector<double> speed;     // sigma d: c/S = d (exp kz + exp -k(z + 2 depth)), in deep water d = 1
    std::vector<double> pressure;  // sigma / k
  };
  const Arrays& arrays() const { return arrays_; }
  std::size_t size() const { return size_; }  // without padding
  std::size_t padded() const { return arrays_.k.size(); }
  double depth() const { return depth_; }
  double gravity() const { return gravity_; }
  const Current& current() const { return current_; }
  Stretching stretching() const { return stretching_; }
  /// Sum of all amplitudes, m: no crest is higher.
  double crest() const { return crest_; }
  /// A bound of |phase angle| at a time and place.
  double largest_angle(double t, double x, double y) const;

  /// Where a point at z counts in linear theory, -depth <= level <= 0.
  template <class T>
  T level(const T& z, const T& elevation) const {
    const T own =
        stretching_ == Stretching::wheeler ? T((z - elevation) / (T(1) + elevation * T(1.0 / depth_))) : z;
    return clamped(own, T(-depth_), T(0));
  }

  /// How many components count at a level: those with exp(k level) >= cut / 2; and of how many the image
  /// below the sea floor does. Whole packs. What is left out is at most `cut` of magnitude().
  std::size_t reach(double level, double cut) const;
  std::size_t images(double level, double cut) const {
    return with_floor_ > 0 ? std::min(with_floor_, reach(-(level + 2.0 * depth_), cut)) : 0;
  }

  /// The highest z below which a flow may be taken as if its surface were at z = 0: what stretching changes
  /// is at most `cut` of magnitude(), and the current changes no more. Always below all troughs.
  double calm_below(double cut) const;
  /// One below which it may be taken as if there were no waves: all of them together come to at most a
  /// hundredth of `cut` of magnitude(), about as little as one component that reach() leaves out.
  double still_below(double cut) const;

  /// Share of component i that an element feels whose extents (m) along three of its axes are the columns:
  /// its mean over the element, the product of sin(x) / x with x = k (extent along the wave) / 2, and nothing
  /// beyond the first zero of any, where the element is longer than the wave.
  template <class T>
  T filter(std::size_t i, const Mat3<T>& extents) const {
    T rate;
    return filter(i, extents, Mat3<T>::Zero().eval(), rate);
  }
  /// The same of extents that change, with its rate.
  template <class T>
  T filter(std::size_t i, const Mat3<T>& extents, const Mat3<T>& extents_rate, T& rate) const {
    T out(1);
    rate = T(0);
    const auto along = [&](const Mat3<T>& of, int j) -> T {
      return T(0.5 * arrays_.kx[i]) * of(0, j) + T(0.5 * arrays_.ky[i]) * of(1, j);
    };
    for (int j = 0; j < 3; ++j) {
      const T half = along(extents, j), square = half * half;
      const bool felt = square < T(sinc_end);
      T sinc, slope;
      sinc_lane<T>(square, sinc, slope);
      if (!felt) sinc = slope = T(0);
      rate = rate * sinc + out * slope * (T(2) * half * along(extents_rate, j));
      out *= sinc;
    }
    return out;
  }

  /// The flow at a point in `waves` times the waves, component by component: what stencils are faster than,
  /// and their slopes.
  template <class T>
  LocalFlow<T> at(double t, const Vec3<T>& point, const Mat3<T>& extents = Mat3<T>::Zero(),
                  const T& height = T(0), const Vec3<T>& turning = Vec3<T>::Zero(), double waves = 1.0) const;

  /// Bounds of all numbers of a flow: sums of the magnitudes of the components at z = 0.
  LocalFlow<double> magnitude() const;

 private:
  /// By how much stretching shifts a level at most, m.
  double shift() const { return stretching_ == Stretching::none ? 0.0 : crest_ / (1.0 - crest_ / depth_); }
  /// The highest z, as near as so many halvings come to it, below which the sums of magnitudes of all
  /// components, each times factor(k), are at most `cut` of magnitude().
  template <class Factor>
  double highest_without(double cut, int halvings, Factor&& factor) const;
  /// exp(kz) and its image below the sea floor, of component i.
  template <class T>
  std::array<T, 2> decay(std::size_t i, const T& level) const {
    const T down = exponential(T(arrays_.k[i]) * level);
    if (i >= with_floor_) return {down, T(0)};
    return {down, exponential(T(-arrays_.k[i]) * (level + T(2.0 * depth_)))};
  }

  Arrays arrays_;
  std::size_t size_ = 0, with_floor_ = 0;
  double depth_, gravity_, crest_ = 0.0;
  double largest_omega_ = 0.0, largest_k_ = 0.0, largest_phase_ = 0.0;
  Current current_;
  Stretching stretching_;
};

template <class T>
LocalFlow<T> SeaField::at(double t, const Vec3<T>& point, const Mat3<T>& extents, const T& height,
                          const Vec3<T>& turning, double waves) const {
  LocalFlow<T> out;
  const Arrays& f = arrays_;
  const Mat3<T> rate = skew<T>(turning) * extents;
  T gain;  // what turning adds to the rate of the elevation
  const auto phasor = [&](std::size_t i) {
    const T angle = T(f.omega[i] * t + f.phase[i]) - (T(f.kx[i]) * point.x() + T(f.ky[i]) * point.y());
    const CosSin<T> turn = cos_sin(angle);
    T filter_rate;
    const T met(waves * f.amplitude[i]), amplitude = met * filter<T>(i, extents, rate, filter_rate);
    gain = met * filter_rate * turn.cosine;
    return CosSin<T>{amplitude * turn.cosine, amplitude * turn.sine};
  };
  for (std::size_t i = 0; i < size_; ++i) {
    const CosSin<T> wave = phasor(i);
    out.elevation += wave.cosine;
    out.elevation_rate += gain - T(f.omega[i]) * wave.sine;
    out.slope[0] += T(f.kx[i]) * wave.sine;
    out.slope[1] += T(f.ky[i]) * wave.sine;
  }
  const WetHeight<T> wet = wet_height<T>(point.z(), height, out.elevation);
  const T level = this->level(wet.middle, out.elevation);
  for (std::size_t i = 0; i < size_; ++i) {
    const CosSin<T> wave = phasor(i);
    auto [down, image] = decay(i, level);
    if (wet.height > T(0)) {
      const T half = T(0.5 * f.k[i]) * wet.height;
      T mean;
      sinc_lane<T>(-(half * half), mean);  // sinh half / half
      down *= mean;
      image *= mean;
    }
    const T along = T(f.speed[i]) * (down + image), up = T(f.speed[i]) * (down - image);
    const Vec3<T> direction(T(f.x[i]), T(f.y[i]), T(0));
    out.velocity += direction * T(along * wave.cosine);
    out.velocity.z() -= up * wave.sine;
    out.acceleration -= direction * T(T(f.sigma[i]) * (along * wave.sine));
    out.acceleration.z() -= T(f.sigma[i]) * (up * wave.cosine);
    out.pressure += T(f.pressure[i]) * (along * wave.cosine);
  }
  const auto current = current_.at<T>(level);
  out.velocity += Vec3<T>(current.x, current.y, T(0));
  return out;
}

}  // namespace seacrane
