#include "seacrane/math/dense.hpp"

#include <Eigen/QR>

namespace Eigen {

template class PartialPivLU<MatrixXd>;
template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute<MatrixXd>(
    const EigenBase<MatrixXd>&, int);
template LDLT<MatrixXd>& LDLT<MatrixXd>::compute<MatrixXd>(const EigenBase<MatrixXd>&);

}  // namespace Eigen

namespace seacrane {

MatXd orthonormal(const MatXd& columns) {
  return Eigen::HouseholderQR<MatXd>(columns).householderQ() *
         MatXd::Identity(columns.rows(), columns.cols());
}

MatXd perpendicular(const MatXd& columns, double threshold) {
  Eigen::ColPivHouseholderQR<MatXd> qr(columns);
  qr.setThreshold(threshold);
  const MatXd q = qr.householderQ();
  return q.rightCols(q.cols() - qr.rank());
}

VecXd shortest_solution(const MatXd& a, const VecXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatXd> parts;
  parts.setThreshold(threshold);
  parts.compute(a);
  return parts.solve(b);
}

}  // namespace seacrane
