#include "seacrane/dynamics/row_space.hpp"

#include <cmath>

#include "seacrane/math/dense.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

RowSpace::RowSpace(int bodies, int rows)
    : bodies_(bodies), rows_(rows), d_(rows, 6 * bodies), over_shape_(rows, 6 * bodies) {}

int RowSpace::factor(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks,
                     const Mat6d* over_shape, double cut) {
  d_.setZero();
  over_shape_.setZero();
  for_each_side(elements, bodies_, [&](std::size_t e, int side, int body) {
    const ElementModel& element = elements[e];
    d_.block(element.row, 6 * body, element.rows, 6) = blocks[e].d[side].topRows(element.rows);
    over_shape_.block(element.row, 6 * body, element.rows, 6) =
        over_shape[2 * e + idx(side)].topRows(element.rows);
  });
  const MatXd g = over_shape_ * d_.transpose();
  const VecXd scale = g.diagonal().array().max(1e-300).sqrt().inverse();
  const MatXd scaled = scale.asDiagonal() * g * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatXd> eigen(scaled);
  const double limit = cut * cut * eigen.eigenvalues()[rows_ - 1];
  singular_values_ = (eigen.eigenvalues() / eigen.eigenvalues()[rows_ - 1]).cwiseMax(0.0).cwiseSqrt();
  combinations_ = eigen.eigenvectors();
  int dropped = 0;  // eigenvalues come in increasing order
  while (dropped < rows_ && !(eigen.eigenvalues()[dropped] > limit)) ++dropped;
  basis_ = scale.asDiagonal() * eigen.eigenvectors().rightCols(rows_ - dropped);
  const MatXd left_out = scale.asDiagonal() * eigen.eigenvectors().leftCols(dropped);
  null_space_ = dropped > 0 ? orthonormal(left_out) : MatXd(rows_, 0);
  return rank();
}

}  // namespace seacrane
