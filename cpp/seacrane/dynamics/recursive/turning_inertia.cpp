#include "seacrane/dynamics/recursive/turning_inertia.hpp"

#include <Eigen/Eigenvalues>

namespace seacrane {
namespace {

constexpr double kSymmetric = 1e-14;  // of the largest entry: what rounding leaves of a symmetry

}  // namespace

TurningInertia::TurningInertia(const Mat3d& inertia) : inertia_(inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3d> principal(inertia);
  const Vec3d& values = principal.eigenvalues();
  const int other =
      values[2] - values[1] < values[1] - values[0] ? 0 : 2;  // the one apart from the two others
  axis_ = principal.eigenvectors().col(other);
  across_ = 0.5 * (values[1] + values[2 - other]);
  excess_ = values[other] - across_;
  const Mat3d symmetric = across_ * Mat3d::Identity() + excess_ * axis_ * axis_.transpose();
  has_axis_ = (inertia - symmetric).cwiseAbs().maxCoeff() <= kSymmetric * inertia.cwiseAbs().maxCoeff();
}

}  // namespace seacrane
