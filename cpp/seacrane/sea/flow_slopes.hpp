#pragma once

#include <array>
#include <cstddef>

#include "seacrane/sea/flow_kernel.hpp"

namespace seacrane {

/// A point, as the middle of an element that is as wide as its extents.
template <class T>
struct FlowPlace {
  Vec3<T> position = Vec3<T>::Zero();  // m, inertial frame
  Mat3<T> extents = Mat3<T>::Zero();   // m, inertial frame: of the element along three axes, in columns
  Vec3<T> turning = Vec3<T>::Zero();   // rad/s, of the element
  T height = T(0);                     // m, of the element: the flow is averaged over what of it is wet

  bool operator==(const FlowPlace& other) const {
    return position == other.position && extents == other.extents && turning == other.turning &&
           height == other.height;
  }
  FlowPlace<double> values() const {
    const auto value = [](const T& x) { return value_of(x); };
    return {position.unaryExpr(value), extents.unaryExpr(value), turning.unaryExpr(value), value_of(height)};
  }
};
using FlowPoint = FlowPlace<double>;

/// The waves of a sum at an element, without the current, and their slopes over all that they depend on.
struct FlowSlopes {
  LocalFlow<double> value;
  std::array<LocalFlow<double>, 2> position;                // over x and y, its level and height held
  std::array<std::array<LocalFlow<double>, 3>, 2> extents;  // over x and y of each
  std::array<std::array<double, 3>, 2> turning{};           // the elevation's rate, over those' rates
  LocalFlow<double> level, height;                          // over those of what is wet
  LocalFlow<double> place;  // over the place along the waves at which the amplitudes are met
  bool wide = false;        // it has extents
  bool calm = false;        // the surface is taken at z = 0
  bool blended = false;     // the amplitudes depend on the place
};

/// A row as it was asked for, and the slopes at one of its elements: those in N directions.
template <int N>
LocalFlow<Dual<N>> in_directions(const FlowSlopes& at, const SeaField& field, const FlowPlace<Dual<N>>& first,
                                 const Vec3<Dual<N>>& step, double number, double middle) {
  using T = Dual<N>;
  LocalFlow<T> out;
  LocalFlow<T>::each(at.value, out, [](double from, T& to) { to = T(from); });
  const auto add = [&](const LocalFlow<double>& over, const T& by) {
    LocalFlow<T>::each(over, out, [&](double slope, T& to) {
      for (std::size_t n = 0; n < N; ++n) to.slope[n] += slope * by.slope[n];
    });
  };
  const Vec3<T> point = first.position + step * T(number);
  for (int i = 0; i < 2; ++i) add(at.position[idx(i)], point[i]);
  if (at.wide) {
    const Mat3<T> rates = skew<T>(first.turning) * first.extents;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 3; ++j) {
        add(at.extents[idx(i)][idx(j)], first.extents(i, j));
        const double slope = at.turning[idx(i)][idx(j)];
        for (std::size_t n = 0; n < N; ++n) out.elevation_rate.slope[n] += slope * rates(i, j).slope[n];
      }
    }
  }
  if (at.blended) {
    const Vec3<T> met = first.position + step * T(middle);
    add(at.place, T(field.arrays().x[0]) * met.x() + T(field.arrays().y[0]) * met.y());
  }
  WetHeight<T> wet{point.z(), first.height};
  if (!at.calm) wet = wet_height<T>(point.z(), first.height, out.elevation);
  const T level = at.calm ? wet.middle : field.level<T>(wet.middle, out.elevation);
  add(at.level, level);
  add(at.height, wet.height);
  const auto current = field.current().at<T>(level);
  out.velocity += Vec3<T>(current.x, current.y, T(0));
  return out;
}

namespace sea {

/// What an element feels of each component, see SeaField::filter, its rate, and the slopes of both over half
/// the phases between the ends of its extents; of no extents all of it. Rates are those of the extents.
void set_filters(const SeaField& field, std::size_t count, const Mat3d& extents, const Mat3d& rates,
                 FlowScratch& s);
/// The surface from phasors that no element has filtered, with its slopes.
void add_surface_slopes(const SeaField& field, std::size_t count, const FlowScratch& s, FlowSlopes& out);
/// The same within, over the height of the decays.
void add_interior_slopes(const SeaField& field, std::size_t count, FlowScratch& s, FlowSlopes& out);

}  // namespace sea
}  // namespace seacrane
