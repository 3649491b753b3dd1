#pragma once

#include <Eigen/LU>
#include <vector>

#include "seacrane/dynamics/formulation.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

struct Line;

/// Tensions of lines that depend on the accelerations of bodies, as Line says of a quasi-static stretch. With u
/// the wrenches of 1 N in a line, m its inertial mass, a0 the accelerations without such tensions, and w =
/// M^-1 u of the bodies as they are joined,
///
///   T_i + m_i sum_j (u_i . w_j) T_j = T_i(a0).
class InertialTensions {
 public:
  explicit InertialTensions(const Model& model);
  bool any() const { return !lines_.empty(); }
  Eigen::Index count() const { return tension_.size(); }

  /// Right after `system` has been evaluated without them: solves for them, and adds them to the loads of its
  /// terms. Accelerations are the caller's to renew.
  void add(Formulation& system, double t, const double* memory);

  // What Jacobians need, at that evaluation.

  /// How the tensions change where they change by `own` with accelerations held, and these by `acceleration`
  /// with tensions held; by body.
  const VecXd& change(const VecXd& own, const Vec6d* acceleration);
  /// How those with given accelerations change with these.
  double along(Eigen::Index line, const Vec6d* acceleration) const;
  void add_loads(const VecXd& tension, Vec6d* load) const;
  /// Power of the winches, and the sum of magnitudes, for changes of the tensions.
  double power(const VecXd& change) const { return winding_.dot(change); }
  double absolute_power(const VecXd& change) const;

 private:
  double dot(Eigen::Index line, const Vec6d* acceleration) const;

  int bodies_;
  std::vector<const Line*> lines_;
  std::vector<std::vector<Vec6d>> unit_;  // u, by place
  std::vector<Vec6d> load_, response_;
  VecXd mass_, winding_, tension_, change_;
  MatXd matrix_;
  Eigen::PartialPivLU<MatXd> factors_;
};

}  // namespace seacrane
