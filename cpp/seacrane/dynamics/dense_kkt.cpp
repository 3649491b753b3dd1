#include "seacrane/dynamics/dense_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/math/dense.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {
namespace {

using SymmetricEigen = Eigen::SelfAdjointEigenSolver<MatXd>;

/// Runs of a scene, in any sea, end with the matrix of the pose where they begin: each thread keeps the last.
const SymmetricEigen& eigen_of(const MatXd& matrix) {
  thread_local MatXd last;
  thread_local SymmetricEigen found;
  const auto bytes = sizeof(double) * static_cast<std::size_t>(matrix.size());
  if (last.size() != matrix.size() || std::memcmp(last.data(), matrix.data(), bytes) != 0) {
    last.resize(0, 0);  // where memory runs out, nothing is known
    found.compute(matrix);
    last = matrix;
  }
  return found;
}

}  // namespace

DenseKkt::DenseKkt(int bodies, int rows)
    : velocities_(6 * bodies),
      rows_(rows),
      matrix_(velocities_ + rows, velocities_ + rows),
      d_(rows, velocities_),
      reduced_(rows, velocities_),
      right_(velocities_ + rows),
      scale_(velocities_ + rows),
      lu_(velocities_ + rows) {}

void DenseKkt::factor(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks,
                      const Mat6d* mass, const std::vector<MassCoupling>& couplings,
                      const RowSpace* independent) {
  const int bodies = velocities_ / 6, n = velocities_;
  independent_ = independent;
  matrix_.setZero();
  double heaviest = 0.0;
  for (int b = 0; b < bodies; ++b) {
    matrix_.block<6, 6>(6 * b, 6 * b) = mass[b];
    heaviest = std::max(heaviest, mass[b].diagonal().cwiseAbs().maxCoeff());
  }
  for (const MassCoupling& c : couplings) {
    matrix_.block<6, 6>(6 * c.first, 6 * c.second) = c.mass;
    matrix_.block<6, 6>(6 * c.second, 6 * c.first) = c.mass.transpose();
  }
  // One scale for all: a scale per body would make the rows of a light body's joints parallel.
  scale_.setConstant(1.0 / std::sqrt(heaviest));
  d_.setZero();
  for_each_side(elements, bodies, [&](std::size_t e, int side, int body) {
    const ElementModel& element = elements[e];
    d_.block(element.row, 6 * body, element.rows, 6) = blocks[e].d[side].topRows(element.rows);
  });
  if (independent) {
    reduced_.setZero();
    reduced_.topRows(independent->rank()).noalias() = independent->basis().transpose() * d_;
    // Rows left out keep the size of the system: their multipliers are zero.
    for (int i = independent->rank(); i < rows_; ++i) matrix_(n + i, n + i) = heaviest;
  }
  const MatXd& rows = independent ? reduced_ : d_;
  matrix_.bottomLeftCorner(rows_, n) = rows;
  matrix_.topRightCorner(n, rows_) = -rows.transpose();
  for (int i = 0; i < rows_; ++i) {
    const double length = rows.row(i).norm();
    if (length > 0.0) scale_[n + i] = std::sqrt(heaviest) / length;
  }
  matrix_.array().colwise() *= scale_.array();
  matrix_.array().rowwise() *= scale_.transpose().array();
  lu_.compute(matrix_);
}

void DenseKkt::solve(const Vec6d* load, const double* right, Vec6d* acceleration, double* lambda) {
  const int bodies = velocities_ / 6, n = velocities_;
  const Eigen::Map<const VecXd> given(right, rows_);
  for (int b = 0; b < bodies; ++b) {
    if (load) {
      right_.segment<6>(6 * b) = load[b];
    } else {
      right_.segment<6>(6 * b).setZero();
    }
  }
  if (independent_) {
    right_.tail(rows_).setZero();
    right_.segment(n, independent_->rank()).noalias() = independent_->basis().transpose() * given;
  } else {
    right_.tail(rows_) = given;
  }
  right_.array() *= scale_.array();
  solved_ = lu_.solve(right_);  // in place it would allocate
  solved_.array() *= scale_.array();
  for (int b = 0; b < bodies; ++b) acceleration[b] = solved_.segment<6>(6 * b);
  Eigen::Map<VecXd> out(lambda, rows_);
  if (independent_) {
    out.noalias() = independent_->basis() * solved_.segment(n, independent_->rank());
    const MatXd& null_space = independent_->null_space();
    out -= null_space * (null_space.transpose() * out).eval();
  } else {
    out = solved_.tail(rows_);
  }
}

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
  const SymmetricEigen& eigen = eigen_of(scale.asDiagonal() * g * scale.asDiagonal());
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
