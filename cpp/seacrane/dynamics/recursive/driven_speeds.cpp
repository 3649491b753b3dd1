#include "seacrane/dynamics/recursive/driven_speeds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "seacrane/dynamics/projection.hpp"
#include "seacrane/elements/check.hpp"

namespace seacrane {
namespace {

CurveValue times(double sign, const CurveValue& v) {
  return {sign * v.value, sign * v.rate, sign * v.acceleration};
}

/// Whether the speeds stand where they were before a jump, not where they are after it.
bool is_before(const double* u, const Vec6d& before, const Vec6d& by) {
  return (view<6>(u) - before).norm() < 0.5 * by.norm();
}

}  // namespace

DrivenSpeeds::DrivenSpeeds(const Model& model, const BodyTree& tree) : model_(model) {
  for (std::size_t i = 0; i < tree.clusters.size(); ++i) {
    const Cluster& c = tree.clusters[i];
    if (!c.is_driven()) continue;
    clusters_.push_back(i);
    if (c.kind == Cluster::floating) {
      Body& body = bodies_.emplace_back(Body{&c, i, {}, std::vector(6, Twist<double>::zero())});
      for (std::size_t k = 0; k < 6; ++k) body.drivers[k] = &model.drivers[idx(c.drive.drivers[k])];
      continue;
    }
    Coordinate& one =
        coordinates_.emplace_back(Coordinate{&c, i, &model.drivers[idx(c.drive.drivers[0])], std::nullopt});
    if (c.drive.strut >= 0) one.stroke.emplace(tree.struts[idx(c.drive.strut)], c.joint);
  }
}

DrivenMotion DrivenSpeeds::motion(const Coordinate& one, double t, double curve_limit, double near) const {
  const double sign = one.cluster->drive.sign;
  const CurveValue asked = times(sign, one.driver->curve.at(t, curve_limit));
  if (!one.stroke) {
    const bool turns = is_angular(one.driver->coordinate.kind);
    return {turns ? near + wrap_angle<double>(asked.value - near) : asked.value, asked.rate,
            asked.acceleration};
  }
  if (const auto found = one.stroke->motion(asked, near)) return *found;
  const auto [least, most] = one.stroke->reach();
  const auto [from, to] = std::minmax({sign * least, sign * most});
  throw std::domain_error("driver '" + model_.elements[idx(one.driver->element)].name +
                          "': asks for a stroke of " + to_text(sign * asked.value) + " m at t = " +
                          to_text(t) + " s; its hinge allows " + to_text(from) + " to " + to_text(to) + " m");
}

DrivenBody DrivenSpeeds::motion(const Body& one, double t, double curve_limit) {
  std::array<CurveValue, 6> asked;
  for (std::size_t k = 0; k < 6; ++k) asked[k] = one.drivers[k]->curve.at(t, curve_limit);
  return {one.drivers[0]->coordinate.joint, asked};
}

void DrivenSpeeds::follow(double t, double curve_limit, double* q, double* u, double* u_rate) {
  for (Coordinate& one : coordinates_) {
    const Cluster& c = *one.cluster;
    const DrivenMotion now = motion(one, t, curve_limit, q[c.q]);
    q[c.q] = now.q;
    u[c.u] = one.u = now.u;
    u_rate[c.u] = now.u_rate;
  }
  for (Body& one : bodies_) {
    const Cluster& c = *one.cluster;
    const DrivenBody now = motion(one, t, curve_limit);
    const Vec4d turned = quaternion_from_rotation(now.rotation);
    auto quaternion = view<4>(q + c.q + 3);
    quaternion = turned.dot(quaternion) < 0.0 ? Vec4d(-turned) : turned;
    view<3>(q + c.q) = now.position;
    view<6>(u + c.u) = now.twist.vector();
    view<6>(u_rate + c.u) = now.acceleration.vector();
    std::ranges::copy(now.parts, one.parts.begin());
  }
}

double DrivenSpeeds::force(int element, const std::vector<double>& drives, double t, double curve_limit,
                           const double* q) const {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const Coordinate& one = coordinates_[i];
    if (one.driver->element != element) continue;
    const double sign = one.cluster->drive.sign;
    if (!one.stroke) return sign * drives[i];
    const double stroke = sign * one.driver->curve.at(t, curve_limit).value;
    const auto unit = one.stroke->motion({stroke, sign, 0.0}, q[one.cluster->q]);
    if (unit) return unit->u * drives[i];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

bool DrivenSpeeds::jump(double t, double curve_limit, const double* q, const double* u, double* jump) {
  bool any = false;
  for (const Coordinate& one : coordinates_) {
    const Cluster& c = *one.cluster;
    const double before = motion(one, t, t, q[c.q]).u, by = motion(one, t, curve_limit, q[c.q]).u - before;
    const bool jumps =
        std::abs(by) > projection::kRateTolerance && std::abs(u[c.u] - before) < 0.5 * std::abs(by);
    jump[c.u] = jumps ? by : 0.0;
    any |= jumps;
  }
  for (const Body& one : bodies_) {
    const Cluster& c = *one.cluster;
    const Vec6d before = motion(one, t, t).twist.vector(),
                by = motion(one, t, curve_limit).twist.vector() - before;
    const bool jumps = by.norm() > projection::kRateTolerance && is_before(u + c.u, before, by);
    view<6>(jump + c.u) = jumps ? by : Vec6d(Vec6d::Zero());
    any |= jumps;
  }
  return any;
}

}  // namespace seacrane
