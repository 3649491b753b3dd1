#pragma once

#include <vector>

#include "seacrane/math/band_lu.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

class Terms;

/// Tensions of lines that depend on the accelerations of bodies, as Line says of a quasi-static stretch. With
/// u the wrenches of 1 N in a line, v these without friction, m its inertial mass, a0 the accelerations
/// without such tensions, and w = M^-1 u of the bodies as they are joined,
///
///   T_i + m_i sum_j (v_i . w_j) T_j = T_i(a0).
class InertialTensions {
 public:
  explicit InertialTensions(const Model& model);
  bool any() const { return !on_.empty(); }
  Eigen::Index count() const { return tension_.size(); }
  /// The only bodies that each tension accelerates; without this call, all. A chain of bodies that float has
  /// equations within a band, which cost as many operations as it has lines.
  void confine(std::vector<std::vector<int>> moved);

  // Call these in this order, right after an evaluation without the tensions.

  /// Begins with what lines told, and the accelerations of that evaluation, by body.
  void start(const Terms& terms, const Vec6d* acceleration);
  /// What 1 N in a line puts on bodies: one by one, and by body until the next call; and room for the
  /// response w to it of the bodies that it accelerates, which the caller writes.
  const std::vector<InertialTension::Pull>& pulls(Eigen::Index line) const { return told(line).pulls; }
  const std::vector<Vec6d>& unit(Eigen::Index line);
  std::vector<Vec6d>& response(Eigen::Index line) { return response_[idx(line)]; }
  /// The bodies on which a line acts, without the ground.
  const std::vector<int>& bodies(Eigen::Index line) const { return on_[idx(line)]; }
  /// Solves for the tensions, and adds them to the loads of the terms.
  const VecXd& finish(Terms& terms);
  /// Adds the share of the tensions to accelerations.
  void add_accelerations(std::vector<Vec6d>& acceleration) const;

  // What Jacobians need, at that evaluation.

  /// How the tensions change where they change by `own` with accelerations held, and these by `acceleration`
  /// with tensions held; by body.
  const VecXd& change(const VecXd& own, const Vec6d* acceleration);
  /// How those with given accelerations change with these.
  double along(Eigen::Index line, const Vec6d* acceleration) const {
    return -told(line).mass * told(line).along(acceleration);
  }
  void add_loads(const VecXd& tension, Vec6d* load) const;
  /// Power of winches and sheaves, and the sum of magnitudes, for changes of the tensions.
  double power(const VecXd& change) const;
  double absolute_power(const VecXd& change) const;

 private:
  const InertialTension& told(Eigen::Index line) const { return (*told_)[idx(line)]; }

  const std::vector<InertialTension>* told_ = nullptr;  // by the terms of start()
  std::vector<std::vector<int>> on_;                    // bodies of each, without the ground, by place
  std::vector<std::vector<int>> moved_;                 // bodies that it accelerates
  std::vector<std::vector<Eigen::Index>> felt_;         // tensions that act on these
  std::vector<std::vector<Vec6d>> response_;            // w, by place; zero of bodies that stay
  std::vector<Vec6d> unit_;
  VecXd tension_, change_;
  BandLu equations_;
};

}  // namespace seacrane
