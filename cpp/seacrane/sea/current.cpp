#include "seacrane/sea/current.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "seacrane/sea/require.hpp"

namespace seacrane {
namespace {

constexpr double fastest = 20.0;  // m/s

/// cosh 2k(d + z) / sinh 2kd for z <= 0, without overflow.
double weight(double k, double z, double depth) {
  const double deep = std::exp(2.0 * k * z);
  if (std::isinf(depth)) return deep;
  return deep * (1.0 + std::exp(-4.0 * k * (z + depth))) / -std::expm1(-4.0 * k * depth);
}

}  // namespace

Current::Current(std::vector<double> depth, std::vector<double> x, std::vector<double> y)
    : depth_(std::move(depth)), x_(std::move(x)), y_(std::move(y)) {
  const std::size_t n = depth_.size();
  sea::require(n > 0 && x_.size() == n && y_.size() == n, "current", "number of speeds", x_.size(),
               "give one for every depth (" + std::to_string(n) + "), and at least one");
  for (std::size_t i = 0; i < n; ++i) {
    const bool below = i == 0 ? depth_[i] >= 0.0 : depth_[i] > depth_[i - 1];
    sea::require(std::isfinite(depth_[i]) && below, "current", "depth[" + std::to_string(i) + "]", depth_[i],
                 "give depths of zero or more in m, increasing");
    const double speed = std::hypot(x_[i], y_[i]);
    sea::require(speed <= fastest, "current", "speed[" + std::to_string(i) + "]", speed,
                 "give at most 20 m/s; no sea has more");
  }
}

double Current::carrying(double k, double direction_x, double direction_y, double water_depth) const {
  if (!any()) return 0.0;
  // By parts: U(0) less the integral of U' times the integrated weight, U' constant between two depths.
  double along = direction_x * x_.front() + direction_y * y_.front();
  for (std::size_t i = 1; i < depth_.size() && depth_[i - 1] < water_depth; ++i) {
    const double thickness = depth_[i] - depth_[i - 1];
    const double bottom = std::min(depth_[i], water_depth);
    const double slope = (direction_x * (x_[i - 1] - x_[i]) + direction_y * (y_[i - 1] - y_[i])) / thickness;
    along -= slope * (weight(k, -depth_[i - 1], water_depth) - weight(k, -bottom, water_depth)) / (2.0 * k);
  }
  return along;
}

double Current::wavenumber(double omega, double direction_x, double direction_y, double water_depth,
                           double gravity) const {
  double k = seacrane::wavenumber(omega, water_depth, gravity);
  if (!any()) return k;
  // Newton's method: of a uniform current the left side less the right is convex in k, and falls to the
  // root sought, so that no step passes beyond it.
  for (int i = 0; i < 60; ++i) {
    const double small = 1e-6 * k, u = carrying(k, direction_x, direction_y, water_depth);
    const double bend = (carrying(k + small, direction_x, direction_y, water_depth) - u) / small;
    const double kd = k * water_depth, h = kd < 20.0 ? std::tanh(kd) : 1.0;
    const double own = std::sqrt(gravity * k * h);
    const double group = 0.5 * own / k * (1.0 + (kd < 20.0 ? kd * (1.0 - h * h) / h : 0.0));
    const double slope = -u - k * bend - group;
    if (!(slope < 0.0)) break;
    const double change = -(omega - k * u - own) / slope;
    k += change;
    if (!(k > 0.0)) break;
    if (std::fabs(change) <= 1e-15 * k) return k;
    if (i > 20 && std::fabs(change) <= 1e-13 * k) return k;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double wavenumber(double omega, double depth, double gravity) {
  const double deep = omega * omega / gravity;
  const double alpha = deep * depth;
  // Beyond 20 tanh is one to rounding.
  if (!(alpha < 20.0) || omega == 0.0) return deep;
  // Newton's method on y tanh y = alpha from Eckart's (1951) estimate, within 5 % for every depth: four
  // steps reach rounding, the other two are spare.
  double y = alpha / std::sqrt(std::tanh(alpha));
  for (int i = 0; i < 6; ++i) {
    const double h = std::tanh(y);
    y -= (y * h - alpha) / (h + y * (1.0 - h * h));
  }
  return y / depth;
}

}  // namespace seacrane
