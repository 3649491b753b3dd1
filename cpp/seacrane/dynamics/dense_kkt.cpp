#include "seacrane/dynamics/dense_kkt.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "seacrane/model/model.hpp"

namespace seacrane {
namespace {

/// Eigenvalues of the row-scaled S below this, relative to the largest, count as zero: the square of a
/// relative singular value of 3e-6.
constexpr double kRankTolerance = 1e-11;

template <class F>
void for_each_side(const std::vector<ElementModel>& elements, int bodies, F&& f) {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const ElementModel& element = elements[e];
    if (element.rows == 0) continue;
    if (element.first < bodies) f(e, 0, element.first);
    if (element.second < bodies) f(e, 1, element.second);
  }
}

}  // namespace

DenseKkt::DenseKkt(int bodies, int rows)
    : velocities_(6 * bodies),
      rows_(rows),
      matrix_(velocities_ + rows, velocities_ + rows),
      right_(velocities_ + rows),
      scale_(velocities_ + rows),
      lu_(velocities_ + rows) {}

void DenseKkt::solve(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks,
                     const Mat6d* mass, const Vec6d* load, const double* gamma, Vec6d* acceleration,
                     double* lambda) {
  const int bodies = velocities_ / 6, n = velocities_;
  matrix_.setZero();
  double heaviest = 0.0;
  for (int b = 0; b < bodies; ++b) {
    matrix_.block<6, 6>(6 * b, 6 * b) = mass[b];
    right_.segment<6>(6 * b) = load[b];
    heaviest = std::max(heaviest, mass[b].diagonal().cwiseAbs().maxCoeff());
  }
  // One scale for all: a scale per body would make the rows of a light body's joints parallel.
  scale_.head(n).setConstant(1.0 / std::sqrt(heaviest));
  for (int i = 0; i < rows_; ++i) right_[n + i] = gamma[i];
  for_each_side(elements, bodies, [&](std::size_t e, int side, int body) {
    const ElementModel& element = elements[e];
    const auto d = blocks[e].d[side].topRows(element.rows);
    matrix_.block(n + element.row, 6 * body, element.rows, 6) = d;
    matrix_.block(6 * body, n + element.row, 6, element.rows) = -d.transpose();
  });
  for (int i = 0; i < rows_; ++i) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j) {
      const double v = matrix_(n + i, j) * scale_[j];
      sum += v * v;
    }
    scale_[n + i] = sum > 0.0 ? 1.0 / std::sqrt(sum) : 1.0;
  }
  matrix_.array().colwise() *= scale_.array();
  matrix_.array().rowwise() *= scale_.transpose().array();
  right_.array() *= scale_.array();
  lu_.compute(matrix_);
  right_ = lu_.solve(right_);
  right_.array() *= scale_.array();
  for (int b = 0; b < bodies; ++b) acceleration[b] = right_.segment<6>(6 * b);
  for (int i = 0; i < rows_; ++i) lambda[i] = right_[n + i];
}

MinimumNormSolver::MinimumNormSolver(int bodies, int rows)
    : bodies_(bodies), rows_(rows), d_(rows, 6 * bodies), dw_(rows, 6 * bodies), s_(rows, rows) {}

int MinimumNormSolver::factor(const std::vector<ElementModel>& elements, const RowBlock<double>* blocks,
                              const Mat6d* over_mass) {
  d_.setZero();
  dw_.setZero();
  for_each_side(elements, bodies_, [&](std::size_t e, int side, int body) {
    const ElementModel& element = elements[e];
    d_.block(element.row, 6 * body, element.rows, 6) = blocks[e].d[side].topRows(element.rows);
    dw_.block(element.row, 6 * body, element.rows, 6) =
        over_mass[2 * e + static_cast<std::size_t>(side)].topRows(element.rows);
  });
  s_.noalias() = dw_ * d_.transpose();
  scale_ = s_.diagonal().array().max(1e-300).sqrt().inverse();
  const MatXd scaled = scale_.asDiagonal() * s_ * scale_.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatXd> eigen(scaled);
  const double limit = kRankTolerance * eigen.eigenvalues()[rows_ - 1];
  int rank = 0;
  inverse_ = eigen.eigenvalues();
  for (int i = 0; i < rows_; ++i) {
    const bool kept = inverse_[i] > limit;
    rank += kept;
    inverse_[i] = kept ? 1.0 / inverse_[i] : 0.0;
  }
  vectors_ = eigen.eigenvectors();
  if (rank == rows_) {
    null_space_.resize(rows_, 0);
  } else {
    const MatXd basis = scale_.asDiagonal() * vectors_.leftCols(rows_ - rank);
    null_space_ = Eigen::HouseholderQR<MatXd>(basis).householderQ() * MatXd::Identity(rows_, rows_ - rank);
  }
  return rank;
}

void MinimumNormSolver::solve(double* x) const {
  Eigen::Map<VecXd> r(x, rows_);
  const VecXd scaled = scale_.cwiseProduct(r);
  const VecXd any = scale_.cwiseProduct(vectors_ * inverse_.cwiseProduct(vectors_.transpose() * scaled));
  r = any - null_space_ * (null_space_.transpose() * any);
}

}  // namespace seacrane
