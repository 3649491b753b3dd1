#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/elements/loads/line.hpp"

namespace seacrane {

/// The unstretched length of a part of a line with mass: a curve, or a share of what a winch has paid out.
struct PaidOut {
  template <class T>
  struct Length {
    T value, rate;
  };

  Curve curve;
  double share = 1.0;
  std::shared_ptr<const Line> segment = nullptr;  // on the winch; null: by the curve

  template <class Context>
  static PaidOut compile(const Curve& curve, const std::string& winch, double share, const Check& part,
                         Context& context) {
    if (winch.empty()) return {curve};
    return {curve, share, Line::segment_on(winch, part, context)};
  }

  StateRange followed() const { return segment ? segment->leading() : StateRange{}; }

  template <class T>
  Length<T> length(const LoadInput<T>& in) const {
    if (segment) {
      const Winch& winch = *segment->winch;
      return {T(share) * winch.length(in), T(share) * winch.rate(in, T(0))};
    }
    const CurveValue given = curve.at(in.time, in.curve_limit);
    return {T(given.value), T(given.rate)};
  }
  template <class T>
  T acceleration(const LoadInput<T>& in) const {
    if (segment) return T(share) * segment->winch_acceleration(in);
    return T(curve.at(in.time, in.curve_limit).acceleration);
  }
  /// Kinks of the acceleration, as of a component of a load.
  std::vector<LoadKinks> kinks() const {
    std::vector<LoadKinks> all;
    const auto add = [&](const Curve& of, double factor, int order) {
      LoadKinks& out = all.emplace_back();
      for (const CurveKink& kink : of.kinks()) {
        LoadKink& one = out.emplace_back(LoadKink{kink.time, Eigen::Matrix<double, 1, 4>::Zero()});
        for (int p = 1; p <= 3 && p - 1 + order <= 3; ++p) one.jump(0, p) = factor * kink.jump(p - 1 + order);
      }
    };
    if (!segment) {
      add(curve, 1.0, 2);
      return all;
    }
    for (const auto& [of, factor] : segment->winch->driven_by()) add(*of, share * factor, 0);
    return all;
  }
};

}  // namespace seacrane
