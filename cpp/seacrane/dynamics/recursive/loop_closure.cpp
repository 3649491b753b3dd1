#include "seacrane/dynamics/recursive/loop_closure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/dynamics/kept_rows.hpp"

namespace seacrane {
namespace {

constexpr std::size_t kFewRows = 12;  // up to these, G is decomposed densely

/// Compliance of a free body per unit force and per unit moment, at most.
Eigen::Vector2d free_compliance(const Model& model, int body) {
  if (body == model.body_count()) return Eigen::Vector2d::Zero();
  const BodyModel& b = model.bodies[idx(body)];
  const Eigen::SelfAdjointEigenSolver<Mat3d> inertia(b.inertia, Eigen::EigenvaluesOnly);
  return {1.0 / b.mass, 1.0 / inertia.eigenvalues()[0]};
}

double free_along(const Eigen::Vector2d& free, const Vec6d& direction) {
  return free[0] * direction.head<3>().squaredNorm() + free[1] * direction.tail<3>().squaredNorm();
}

}  // namespace

LoopClosure::LoopClosure(const Model& model, const BodyTree& tree)
    : model_(model),
      tree_(tree),
      load_(idx(model.body_count()) + 1, Vec6d::Zero()),
      response_(idx(model.body_count()) + 1, Vec6d::Zero()),
      shape_mass_(idx(model.body_count()), Mat6d::Zero()),
      speeds_(idx(tree.speeds)),
      ldlt_(tree.loop_rows),
      eigen_(tree.loop_rows) {
  for (int e : tree.loops) {
    const ElementModel& element = model.elements[idx(e)];
    for (int r = 0; r < element.rows; ++r) {
      rows_.push_back({{e, r, element.first, element.second, element.driver},
                       free_compliance(model, element.first),
                       free_compliance(model, element.second)});
    }
  }
  const auto n = static_cast<Eigen::Index>(rows_.size());
  for (MatXd* matrix : {&g_, &shape_, &basis_, &product_, &scaled_}) *matrix = MatXd::Zero(n, n);
  for (VecXd* vector : {&free_, &scale_, &combined_, &multipliers_}) *vector = VecXd::Zero(n);
}

int LoopClosure::row_of(int element) const {
  const auto found = std::ranges::find(rows_, element, &Row::element);
  return found == rows_.end() ? -1 : static_cast<int>(found - rows_.begin());
}

/// g := D M^-1 D^T for the inertias that the tree holds factored.
void LoopClosure::gather(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, MatXd& g) {
  const Eigen::Index n = g.rows();
  for (Eigen::Index c = 0; c < n; ++c) {
    const Row& row = rows_[static_cast<std::size_t>(c)];
    const RowBlock<double>& block = blocks[row.element];
    load_[idx(row.first)] += block.d[0].row(row.row).transpose();
    load_[idx(row.second)] += block.d[1].row(row.row).transpose();
    tree.solve(load_.data(), false, response_.data(), speeds_.data());
    load_[idx(row.first)].setZero();
    load_[idx(row.second)].setZero();
    for (Eigen::Index r = 0; r < n; ++r) {
      const Row& other = rows_[static_cast<std::size_t>(r)];
      const RowBlock<double>& rows = blocks[other.element];
      const double first = rows.d[0].row(other.row).dot(response_[idx(other.first)]),
                   second = rows.d[1].row(other.row).dot(response_[idx(other.second)]);
      g(r, c) = first + second;
      if (r == c) free_[r] = std::abs(first) + std::abs(second);
    }
  }
}

/// LDL^T of a matrix with its diagonal scaled to one; the ratio of the smallest to the largest pivot.
double LoopClosure::decompose(const MatXd& g) {
  for (Eigen::Index i = 0; i < g.rows(); ++i) scale_[i] = g(i, i) > 0.0 ? 1.0 / std::sqrt(g(i, i)) : 0.0;
  scaled_.noalias() = scale_.asDiagonal() * g;
  scaled_.array().rowwise() *= scale_.transpose().array();
  ldlt_.compute(scaled_);
  return ldlt_.vectorD().minCoeff() / ldlt_.vectorD().maxCoeff();
}

/// Compliance of both bodies of a row along it, without joints.
double LoopClosure::loose(const Row& row, const RowBlock<double>* blocks) const {
  const RowBlock<double>& block = blocks[row.element];
  return free_along(row.first_free, block.d[0].row(row.row).transpose()) +
         free_along(row.second_free, block.d[1].row(row.row).transpose());
}

void LoopClosure::factor(const RowBlock<double>* blocks, const Mat6d* mass,
                         const BodyKinematics<double>* bodies, ArticulatedTree<double>& tree) {
  is_sparse_ = sparse_ && factor_sparse(blocks, tree);
  if (!is_sparse_) factor_all(blocks, mass, bodies, tree);
}

/// Whether the rows that are kept determine the others here, and G is accurate.
bool LoopClosure::factor_sparse(const RowBlock<double>* blocks, ArticulatedTree<double>& tree) {
  for (const int i : sparse_->left_out()) {
    const Row& row = rows_[idx(i)];
    if (stands_open(blocks[row.element], row.row)) return false;
  }
  free_.setConstant(std::numeric_limits<double>::infinity());
  const double pivots = sparse_->factor(blocks, tree, free_.data());
  double open = 1.0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    open = std::min(open, free_[static_cast<Eigen::Index>(i)] / loose(rows_[i], blocks));
  }
  condition_ = pivots;
  ratio_ = pivots / std::max(0.0, open);
  left_out_ = static_cast<int>(sparse_->left_out().size());
  dependent_ = false;
  if (!(ratio_ < kInaccuratePivot)) return false;
  most_left_out_ = std::max(most_left_out_, left_out_);
  return true;
}

bool LoopClosure::misses(const RowBlock<double>* blocks, const Vec6d* acceleration) const {
  if (!is_sparse_) return false;
  return std::ranges::any_of(sparse_->left_out(), [&](int i) {
    const Row& row = rows_[idx(i)];
    return is_missed(blocks[row.element], row.row, acceleration[row.first], acceleration[row.second]);
  });
}

void LoopClosure::choose_rows(const RowBlock<double>* blocks, const BodyKinematics<double>* bodies,
                              ArticulatedTree<double>& tree) {
  const std::vector<LoopRow> rows(rows_.begin(), rows_.end());
  if (rows_.size() <= kFewRows || SparseLoops::trees_of(model_, tree_) < 2) return;
  factor_shape(bodies, tree);
  std::vector<double> loose;
  for (const Row& row : rows_) loose.push_back(loose_shape(row, blocks, bodies));
  SparseLoops all(tree_, model_.body_count(), rows, std::vector<char>(rows.size(), 1));
  const std::vector<char> kept = all.choose(blocks, tree, loose, 1.0 / kEnforcedEigenvalue);
  sparse_.emplace(tree_, model_.body_count(), rows, kept);
}

void LoopClosure::factor_all(const RowBlock<double>* blocks, const Mat6d* mass,
                             const BodyKinematics<double>* bodies, ArticulatedTree<double>& tree) {
  is_sparse_ = false;
  gather(blocks, tree, g_);
  double cancelled = 1.0, open = 1.0;
  for (Eigen::Index i = 0; i < g_.rows(); ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    open = std::min(open, g_(i, i) / loose(row, blocks));
    cancelled = std::max(cancelled, free_[i] / std::abs(g_(i, i)));
  }
  const double pivots = decompose(g_);
  condition_ = cancelled / pivots;
  left_out_ = 0;
  ratio_ = 1.0 / std::max(0.0, open * pivots);
  dependent_ = !(open * pivots * kInaccuratePivot > 1.0) && !is_independent(blocks, mass, bodies, tree);
  if (!dependent_) return;
  for (double value : eigen_.eigenvalues()) left_out_ += value > kEnforcedEigenvalue ? 0 : 1;
  reduce();
  most_left_out_ = std::max(most_left_out_, left_out_);
}

Dependence LoopClosure::take_dependence() {
  if (rows_.empty()) return {};
  redundant_ = redundant_rows(model_, redundant_, left_out_);
  // Rows that are redundant from the start always reduce the worst one to zero.
  if (!is_sparse_ && redundant_ > 0 && redundant_ <= left_out_) {
    ratio_ = redundant_ < rows() ? 1.0 / std::max(0.0, eigen_.eigenvalues()[redundant_]) : 1.0;
  }
  return {ratio_, redundant_, left_out_, std::exchange(most_left_out_, 0)};
}

/// Whether geometry alone, with every mass one, tells the rows apart; else `basis_` holds the combinations
/// that it does, and columns of zeros. Light bodies between heavy ones and rows that depend on each other
/// both make G nearly singular: only the latter do so with equal masses.
bool LoopClosure::is_independent(const RowBlock<double>* blocks, const Mat6d* mass,
                                 const BodyKinematics<double>* bodies, ArticulatedTree<double>& tree) {
  gather_shape(blocks, bodies, tree);
  tree.factor(mass);
  const Eigen::Index n = shape_.rows();
  eigen_.compute(scaled_);
  if (eigen_.eigenvalues()[0] > kEnforcedEigenvalue) {
    decompose(g_);
    return true;
  }
  basis_.noalias() = scale_.asDiagonal() * eigen_.eigenvectors();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(eigen_.eigenvalues()[i] > kEnforcedEigenvalue)) basis_.col(i).setZero();
  }
  return false;
}

/// The tree with every mass one.
void LoopClosure::factor_shape(const BodyKinematics<double>* bodies, ArticulatedTree<double>& tree) {
  for (std::size_t b = 0; b < shape_mass_.size(); ++b) {
    shape_mass_[b] = shape_mass_matrix(model_.bodies[b], bodies[b].rotation);
  }
  tree.factor(shape_mass_.data(), false);
}

/// What both bodies of a row give along it without joints, every mass one.
double LoopClosure::loose_shape(const Row& row, const RowBlock<double>* blocks,
                                const BodyKinematics<double>* bodies) const {
  double loose = 0.0;
  for (const int side : {0, 1}) {
    const int body = side == 0 ? row.first : row.second;
    if (body == model_.body_count()) continue;
    const Mat6d& d = blocks[row.element].d[side];
    Mat6d over;
    rows_over_shape(model_.bodies[idx(body)], bodies[body], d, over);
    loose += over.row(row.row).dot(d.row(row.row));
  }
  return loose;
}

/// `shape_` is G with every mass one, `scaled_` the same over what both bodies of a row give without joints.
void LoopClosure::gather_shape(const RowBlock<double>* blocks, const BodyKinematics<double>* bodies,
                               ArticulatedTree<double>& tree) {
  factor_shape(bodies, tree);
  gather(blocks, tree, shape_);
  const Eigen::Index n = shape_.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    scale_[i] = 1.0 / std::sqrt(loose_shape(rows_[static_cast<std::size_t>(i)], blocks, bodies));
  }
  scaled_.noalias() = scale_.asDiagonal() * shape_;
  scaled_.array().rowwise() *= scale_.transpose().array();
}

/// G of the independent combinations; a one stands for each that is left out.
void LoopClosure::reduce() {
  product_.noalias() = g_ * basis_;
  shape_.noalias() = basis_.transpose() * product_;
  for (Eigen::Index i = 0; i < shape_.rows(); ++i) {
    if (!(eigen_.eigenvalues()[i] > kEnforcedEigenvalue)) shape_(i, i) = 1.0;
  }
  condition_ = 1.0 / decompose(shape_);
}

const VecXd& LoopClosure::solve(const VecXd& right) {
  if (is_sparse_) {
    sparse_->solve(right, multipliers_);
    return multipliers_;
  }
  if (dependent_) {
    combined_.noalias() = basis_.transpose() * right;
  } else {
    combined_ = right;
  }
  combined_ = combined_.cwiseProduct(scale_);
  ldlt_.solveInPlace(combined_);
  combined_ = combined_.cwiseProduct(scale_);
  if (dependent_) {
    multipliers_.noalias() = basis_ * combined_;
  } else {
    multipliers_ = combined_;
  }
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
                                   Terms& terms) const {
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
