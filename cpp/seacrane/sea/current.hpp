#pragma once

#include <cstddef>
#include <vector>

#include "seacrane/math/select.hpp"

namespace seacrane {

/// Wavenumber k (rad/m) of omega^2 = g k tanh(k depth), omega >= 0 (rad/s), depth in m (infinity: deep
/// water).
double wavenumber(double omega, double depth, double gravity);

/// Steady horizontal current over depth: linear between the depths given, and held beyond the first and the
/// last. Immutable; empty: the water is at rest.
class Current {
 public:
  Current() = default;
  /// m below the still water (zero or more, increasing); m/s along x and y there.
  Current(std::vector<double> depth, std::vector<double> x, std::vector<double> y);

  bool any() const { return !depth_.empty(); }
  const std::vector<double>& depth() const { return depth_; }
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }

  /// m below the still water, from where on it does not change.
  double settled() const {
    std::size_t last = depth_.size();
    while (last > 1 && x_[last - 1] == x_[last - 2] && y_[last - 1] == y_[last - 2]) --last;
    return last > 1 ? depth_[last - 1] : 0.0;
  }

  /// m/s at z (m, upwards; above the still water as at it), along x and y.
  template <class T>
  struct Velocity {
    T x = T(0), y = T(0);
  };
  template <class T>
  Velocity<T> at(const T& z) const {
    if (!any()) return {};
    Velocity<T> out{T(x_.front()), T(y_.front())};
    for (std::size_t i = 1; i < depth_.size(); ++i) {
      const double thickness = depth_[i] - depth_[i - 1];
      const T share = clamped(T((-z - T(depth_[i - 1])) / T(thickness)), T(0), T(1));
      out.x += share * T(x_[i] - x_[i - 1]);
      out.y += share * T(y_[i] - y_[i - 1]);
    }
    return out;
  }

  /// The uniform current (m/s, along the wave of direction cos b, sin b) that carries a wave of wavenumber k
  /// as this one does, in water of this depth: 2 k / sinh 2 k d times the integral of U cosh 2 k (d + z).
  /// First order in the shear (R. A. Skop, J. Waterway, Port, Coastal and Ocean Eng. 113, 1987; in deep water
  /// R. H. Stewart and J. W. Joy, Deep-Sea Research 21, 1974); exact for a uniform current.
  double carrying(double k, double direction_x, double direction_y, double water_depth) const;

  /// Wavenumber (rad/m) of the wave that a fixed observer sees at omega: (omega - k U)^2 = g k tanh(k d), U
  /// as above; the root that belongs to no current. NaN where the current stops such a wave.
  double wavenumber(double omega, double direction_x, double direction_y, double water_depth,
                    double gravity) const;

 private:
  std::vector<double> depth_, x_, y_;
};

}  // namespace seacrane
