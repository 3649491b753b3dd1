#include "seacrane/sea/sea_field.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace seacrane {
namespace {

constexpr double no_floor = 20.0;  // k depth beyond which the sea floor is not felt: exp(-2 * 20) is rounding

std::size_t whole_packs(std::size_t n) {
  return (n + SeaField::lanes - 1) / SeaField::lanes * SeaField::lanes;
}

}  // namespace

SeaField::SeaField(const WaveComponents& waves, Stretching stretching)
    : size_(waves.size()),
      depth_(waves.depth()),
      gravity_(waves.gravity()),
      current_(waves.current()),
      stretching_(stretching) {
  std::vector<std::size_t> order(size_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return waves.wavenumber()[a] < waves.wavenumber()[b];
  });
  Arrays& f = arrays_;
  for (const std::size_t i : order) {
    const double w = waves.omega()[i], k = waves.wavenumber()[i], sigma = waves.intrinsic()[i];
    const double x = waves.direction_x()[i], y = waves.direction_y()[i];
    const bool floor = k * depth_ < no_floor;
    f.omega.push_back(w);
    f.sigma.push_back(sigma);
    f.k.push_back(k);
    f.kx.push_back(k * x);
    f.ky.push_back(k * y);
    f.x.push_back(x);
    f.y.push_back(y);
    f.amplitude.push_back(waves.amplitude()[i]);
    f.phase.push_back(waves.phase()[i]);
    f.speed.push_back(floor ? sigma / -std::expm1(-2.0 * k * depth_) : sigma);
    f.pressure.push_back(sigma / k);
    crest_ += waves.amplitude()[i];
    largest_omega_ = std::max(largest_omega_, w);
    largest_phase_ = std::max(largest_phase_, std::fabs(waves.phase()[i]));
    if (floor) ++with_floor_;
  }
  largest_k_ = f.k.back();
  with_floor_ = whole_packs(with_floor_);
  for (auto* array :
       {&f.omega, &f.sigma, &f.kx, &f.ky, &f.x, &f.y, &f.amplitude, &f.phase, &f.speed, &f.pressure}) {
    array->resize(whole_packs(size_), 0.0);
  }
  f.k.resize(whole_packs(size_), largest_k_);
}

double SeaField::largest_angle(double t, double x, double y) const {
  return largest_omega_ * std::fabs(t) + largest_k_ * (std::fabs(x) + std::fabs(y)) + largest_phase_;
}

std::size_t SeaField::reach(double level, double cut) const {
  if (!(level < 0.0)) return padded();
  const double largest = std::log(0.5 * cut) / level;
  const auto end = std::upper_bound(arrays_.k.begin(), arrays_.k.end(), largest);
  return whole_packs(static_cast<std::size_t>(end - arrays_.k.begin()));
}

SeaField SeaField::without_waves() const {
  SeaField out = *this;
  std::ranges::fill(out.arrays_.amplitude, 0.0);
  out.crest_ = 0.0;
  return out;
}

SeaField SeaField::of_unit_height(const std::vector<std::size_t>& kept) const {
  SeaField out = *this;
  Arrays& f = out.arrays_ = {};
  out.size_ = kept.size();
  out.with_floor_ = 0;
  for (const std::size_t i : kept) {
    const double k = arrays_.k[i];
    const bool floor = i < with_floor_;
    f.k.push_back(k);
    f.kx.push_back(arrays_.kx[i]);
    f.ky.push_back(arrays_.ky[i]);
    f.x.push_back(arrays_.x[i]);
    f.y.push_back(arrays_.y[i]);
    f.speed.push_back(floor ? k / (1.0 + std::exp(-2.0 * k * depth_)) : k);
    f.pressure.push_back(gravity_ / k);
    if (floor) ++out.with_floor_;
  }
  out.with_floor_ = whole_packs(out.with_floor_);
  f.k.resize(whole_packs(out.size_), f.k.back());
  for (auto* array : {&f.kx, &f.ky, &f.x, &f.y, &f.speed, &f.pressure}) array->resize(f.k.size(), 0.0);
  f.amplitude.assign(f.k.size(), 1.0);
  f.phase.assign(f.k.size(), 0.0);
  f.omega.assign(f.k.size(), 1.0);
  f.sigma.assign(f.k.size(), gravity_);
  return out;
}

template <class Factor>
double SeaField::highest_without(double cut, int halvings, Factor&& factor) const {
  const auto changes = [&](double z) {
    double speed = 0.0, pull = 0.0, push = 0.0, speeds = 0.0, pulls = 0.0, pushes = 0.0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double size = arrays_.amplitude[i] * arrays_.speed[i], k = arrays_.k[i];
      const double change = factor(k) * std::exp(k * std::min(z + shift(), 0.0)) * 2.0;
      speeds += size, pulls += size * arrays_.sigma[i], pushes += size * arrays_.pressure[i];
      speed += size * change, pull += size * arrays_.sigma[i] * change;
      push += size * arrays_.pressure[i] * change;
    }
    return speed > cut * speeds || pull > cut * pulls || push > cut * pushes;
  };
  const double lowest = std::isinf(depth_) ? 50.0 / arrays_.k.front() : depth_;
  double above = -crest_, below = -lowest;
  if (!changes(below)) {
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (above + below);
      (changes(middle) ? above : below) = middle;
    }
  }
  return below;
}

double SeaField::calm_below(double cut) const {
  if (!(crest_ < depth_)) return -depth_;
  if (stretching_ == Stretching::none) return -crest_;
  const double least = highest_without(cut, 40, [&](double k) { return shift() * k; });
  return std::min(least, -(current_.settled() + shift()));
}

double SeaField::still_below(double cut) const {
  if (!(crest_ < depth_)) return -depth_;
  return highest_without(0.01 * cut, 12, [](double /*k*/) { return 1.0; });
}

LocalFlow<double> SeaField::magnitude() const {
  LocalFlow<double> out;
  const Arrays& f = arrays_;
  for (std::size_t i = 0; i < size_; ++i) {
    const double a = f.amplitude[i], floor = i < with_floor_ ? std::exp(-2.0 * f.k[i] * depth_) : 0.0;
    const double along = a * f.speed[i] * (1.0 + floor), up = a * f.speed[i] * (1.0 - floor);
    out.elevation += a;
    out.elevation_rate += a * f.omega[i];
    out.slope[0] += a * std::fabs(f.kx[i]);
    out.slope[1] += a * std::fabs(f.ky[i]);
    out.velocity += Vec3d(along * std::fabs(f.x[i]), along * std::fabs(f.y[i]), up);
    out.acceleration += f.sigma[i] * Vec3d(along * std::fabs(f.x[i]), along * std::fabs(f.y[i]), up);
    out.pressure += f.pressure[i] * along;
  }
  return out;
}

}  // namespace seacrane
