#include "seacrane/dynamics/recursive/loop_closure.hpp"

#include <array>
#include <cmath>

namespace seacrane {
namespace {

/// Pivot ratio of the scaled G beyond which rows may depend on each other, and the relative eigenvalue below
/// which a combination of them is not enforced: the square of the redundant form's singular value, 1e-4.
constexpr double kRegularCondition = 1e10;
constexpr double kSingularCut = 1e-8;
/// What rounding leaves of the compliance along a row that the tree holds already, relative to that of its
/// two ends alone.
constexpr double kRounding = 1e-12;
/// Bodies free in space yield more than in the tree: a row that passes their compliance by this much needs no
/// closer look.
constexpr double kClearly = 1e3 * kRounding;

/// Free compliance per unit force and per unit moment, at most; a body's ellipsoid of inertia is left aside.
Eigen::Vector2d free_compliance(const Model& model, int body) {
  if (body == model.body_count()) return Eigen::Vector2d::Zero();
  const BodyModel& b = model.bodies[idx(body)];
  const Eigen::SelfAdjointEigenSolver<Mat3d> inertia(b.inertia, Eigen::EigenvaluesOnly);
  return {1.0 / b.mass, 1.0 / inertia.eigenvalues()[0]};
}

}  // namespace

LoopClosure::LoopClosure(const Model& model, const BodyTree& tree)
    : load_(idx(model.body_count()) + 1, Vec6d::Zero()),
      response_(idx(model.body_count()) + 1, Vec6d::Zero()),
      speeds_(idx(tree.speeds)),
      ldlt_(tree.loop_rows),
      eigen_(tree.loop_rows) {
  for (int e : tree.loops) {
    const ElementModel& element = model.elements[idx(e)];
    for (int r = 0; r < element.rows; ++r) {
      rows_.push_back({e, r, element.first, element.second, element.driver,
                       free_compliance(model, element.first), free_compliance(model, element.second)});
    }
  }
  const auto n = static_cast<Eigen::Index>(rows_.size());
  g_ = MatXd::Zero(n, n);
  basis_ = MatXd::Zero(n, n);
  scale_ = weight_ = multipliers_ = VecXd::Zero(n);
}

/// Response to load_ on the two bodies of a row; clears the load.
void LoopClosure::respond(const Row& row, ArticulatedTree& tree) {
  tree.solve(load_.data(), false, response_.data(), speeds_.data());
  load_[idx(row.first)].setZero();
  load_[idx(row.second)].setZero();
}

/// Whether the tree yields along a row by more than rounding of what each end yields alone.
bool LoopClosure::is_open(const Row& row, double compliance, const RowBlock<double>* blocks,
                          ArticulatedTree& tree) {
  const std::array<Vec6d, 2> direction = {blocks[row.element].d[0].row(row.row).transpose(),
                                          blocks[row.element].d[1].row(row.row).transpose()};
  double loose = 0.0, held = 0.0;
  for (int side = 0; side < 2; ++side) {
    const Vec6d& d = direction[idx(side)];
    const Eigen::Vector2d& free = side == 0 ? row.first_free : row.second_free;
    loose += free[0] * d.head<3>().squaredNorm() + free[1] * d.tail<3>().squaredNorm();
  }
  if (compliance > kClearly * loose) return true;
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? row.first : row.second;
    load_[idx(body)] += direction[idx(side)];
    respond(row, tree);
    held += direction[idx(side)].dot(response_[idx(body)]);
  }
  return compliance > kRounding * held;
}

void LoopClosure::factor(const RowBlock<double>* blocks, ArticulatedTree& tree) {
  const Eigen::Index n = g_.rows();
  for (Eigen::Index c = 0; c < n; ++c) {
    const Row& row = rows_[static_cast<std::size_t>(c)];
    const RowBlock<double>& block = blocks[row.element];
    load_[idx(row.first)] += block.d[0].row(row.row).transpose();
    load_[idx(row.second)] += block.d[1].row(row.row).transpose();
    respond(row, tree);
    for (Eigen::Index r = 0; r < n; ++r) {
      const Row& other = rows_[static_cast<std::size_t>(r)];
      const RowBlock<double>& rows = blocks[other.element];
      g_(r, c) = rows.d[0].row(other.row).dot(response_[idx(other.first)]) +
                 rows.d[1].row(other.row).dot(response_[idx(other.second)]);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    scale_[i] = is_open(row, g_(i, i), blocks, tree) ? 1.0 / std::sqrt(g_(i, i)) : 0.0;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) g_(i, j) *= scale_[i] * scale_[j];
  }
  ldlt_.compute(g_);
  const double largest = ldlt_.vectorD().maxCoeff(), smallest = ldlt_.vectorD().minCoeff();
  condition_ = largest / smallest;
  regular_ = smallest > 0.0 && condition_ < kRegularCondition;
  if (regular_) return;
  eigen_.compute(g_);
  const double cut = kSingularCut * eigen_.eigenvalues().maxCoeff();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double value = eigen_.eigenvalues()[i];
    weight_[i] = value > cut ? 1.0 / value : 0.0;
  }
}

const VecXd& LoopClosure::solve(const VecXd& right) {
  multipliers_ = scale_.cwiseProduct(right);
  if (regular_) {
    ldlt_.solveInPlace(multipliers_);
  } else {
    basis_.col(0).noalias() = eigen_.eigenvectors().transpose() * multipliers_;
    basis_.col(0) = basis_.col(0).cwiseProduct(weight_);
    multipliers_.noalias() = eigen_.eigenvectors() * basis_.col(0);
  }
  multipliers_ = multipliers_.cwiseProduct(scale_);
  return multipliers_;
}

void LoopClosure::add_load(const RowBlock<double>* blocks, const VecXd& multipliers, Vec6d* loads) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const double lambda = multipliers[static_cast<Eigen::Index>(i)];
    loads[row.first] += lambda * blocks[row.element].d[0].row(row.row).transpose();
    loads[row.second] += lambda * blocks[row.element].d[1].row(row.row).transpose();
  }
}

void LoopClosure::add_driver_power(const RowBlock<double>* blocks, const VecXd& multipliers,
                                   RedundantSystem& terms) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i].driver) continue;
    terms.add_driver_power(multipliers[static_cast<Eigen::Index>(i)] * blocks[rows_[i].element].nu[0]);
  }
}

void LoopClosure::position_residual(const RowBlock<double>* blocks, VecXd& out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    out[static_cast<Eigen::Index>(i)] = blocks[rows_[i].element].phi[rows_[i].row];
  }
}

void LoopClosure::rate_residual(const RowBlock<double>* blocks, const Vec6d* twists, VecXd& out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const RowBlock<double>& block = blocks[row.element];
    out[static_cast<Eigen::Index>(i)] = block.d[0].row(row.row).dot(twists[row.first]) +
                                        block.d[1].row(row.row).dot(twists[row.second]) - block.nu[row.row];
  }
}

void LoopClosure::acceleration_residual(const RowBlock<double>* blocks, const Vec6d* acceleration,
                                        VecXd& out) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const RowBlock<double>& block = blocks[row.element];
    out[static_cast<Eigen::Index>(i)] = block.gamma[row.row] -
                                        block.d[0].row(row.row).dot(acceleration[row.first]) -
                                        block.d[1].row(row.row).dot(acceleration[row.second]);
  }
}

}  // namespace seacrane
