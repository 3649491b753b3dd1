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
  bool any() const { return !loads_.empty(); }
  Eigen::Index count() const { return tension_.size(); }
  /// The only bodies that each tension accelerates; without this call, all. A chain of bodies that float has
  /// equations within a band, which cost as many operations as it has lines.
  void confine(std::vector<std::vector<int>> moved);

  // Call these in this order, right after an evaluation without the tensions.

  /// Begins with the accelerations of that evaluation, by body.
  void start(const Terms& terms, double t, const double* memory, const Vec6d* acceleration);
  /// The wrenches u of 1 N in a line, and room for the response w to them of the bodies that it accelerates,
  /// which the caller writes.
  const std::vector<Vec6d>& unit(Eigen::Index line) const { return unit_[idx(line)]; }
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
  double along(Eigen::Index line, const Vec6d* acceleration) const;
  void add_loads(const VecXd& tension, Vec6d* load) const;
  /// Power of winches and sheaves, and the sum of magnitudes, for changes of the tensions.
  double power(const VecXd& change) const { return winding_.dot(change); }
  double absolute_power(const VecXd& change) const;

 private:
  double dot(Eigen::Index line, const std::vector<int>& bodies, const Vec6d* acceleration) const;

  int bodies_;
  struct Tensioned {
    const LoadList* list;
    std::size_t at;
    int place;  // among the tensions
  };
  struct Felt {
    int by;
    std::vector<int> at;  // bodies
  };
  std::vector<Tensioned> loads_;
  std::vector<std::vector<int>> on_;                        // bodies of each, without the ground, by place
  std::vector<std::vector<int>> moved_;                     // bodies that it accelerates
  std::vector<std::vector<Felt>> felt_;                     // tensions that act on these
  std::vector<std::vector<Vec6d>> unit_, path_, response_;  // u, v and w, by place
  std::vector<Vec6d> load_;
  VecXd mass_, winding_, tension_, change_;
  BandLu equations_;
};

}  // namespace seacrane
