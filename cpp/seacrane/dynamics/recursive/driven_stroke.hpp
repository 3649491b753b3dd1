#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "seacrane/dynamics/recursive/strut.hpp"
#include "seacrane/math/curve.hpp"

namespace seacrane {

/// A coordinate of a tree that is prescribed: position, speed, and the rate of the speed.
struct DrivenMotion {
  double q = 0.0, u = 0.0, u_rate = 0.0;
};

/// The hinge angle under a strut of prescribed stroke, by the triangle of the strut's ends and the hinge:
///
///   (stroke + offset)^2 + across^2 = mean - swing cos(phi),   phi = angle - turned.
class DrivenStroke {
 public:
  DrivenStroke(const Strut& s, const TreeJoint& hinge)
      : extension_(s.extension_sign), offset_(s.offset[2]), across_(s.offset.head<2>().squaredNorm()) {
    const Vec3d base = hinge.parent_axes.transpose() * (s.base_point - hinge.parent_point),
                arm = hinge.child_axes.transpose() * (s.arm_point - hinge.child_point);
    const double along = arm[2] - base[2];
    mean_ = base.head<2>().squaredNorm() + arm.head<2>().squaredNorm() + along * along;
    swing_ = 2.0 * base.head<2>().norm() * arm.head<2>().norm();
    turned_ = std::atan2(base[1], base[0]) - std::atan2(arm[1], arm[0]);
  }

  /// sin(phi): how far from a dead centre a hinge angle is, and on which side of it.
  double sine(double angle) const { return std::sin(angle - turned_); }

  /// The angle near another one, on the same side of the dead centres; none where the stroke is out of reach.
  std::optional<DrivenMotion> motion(const CurveValue& stroke, double near) const {
    const double length = stroke.value + offset_;
    const double cosine = (mean_ - length * length - across_) / swing_;
    if (!(extension_ * length > 0.0) || !(std::abs(cosine) < 1.0)) return std::nullopt;
    const double phi = near - turned_;
    const double sine = std::copysign(std::sqrt(1.0 - cosine * cosine), std::sin(phi));
    const double u = 2.0 * length * stroke.rate / (swing_ * sine);
    const double bend = 2.0 * (stroke.rate * stroke.rate + length * stroke.acceleration);
    return DrivenMotion{near + wrap_angle<double>(std::atan2(sine, cosine) - phi), u,
                        (bend - swing_ * cosine * u * u) / (swing_ * sine)};
  }

  /// The least and the largest stroke that the hinge allows.
  std::pair<double, double> reach() const {
    const auto at = [&](double squared) {
      return extension_ * std::sqrt(std::max(squared - across_, 0.0)) - offset_;
    };
    return std::minmax({at(mean_ - swing_), at(mean_ + swing_)});
  }

 private:
  double extension_, offset_, across_, mean_, swing_, turned_;
};

}  // namespace seacrane
