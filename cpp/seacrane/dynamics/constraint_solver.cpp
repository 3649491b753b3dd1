#include "seacrane/dynamics/constraint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/math/dense.hpp"

namespace seacrane {
namespace {

constexpr double kRedundantPivot = 1.0 / (kRedundantSingularValue * kRedundantSingularValue);
constexpr int kMostDecomposed = 256;  // rows, for their singular values
constexpr double kWeakPivot = 1e4;  // rows beyond wait while a model is assembled: what is kept steps safely
constexpr double kPart = 1e-7;      // of a combination of rows of unit size: less is rounding

/// The block of M^-1 of two bodies that are coupled.
Mat6d inverse_between(const std::vector<MassCoupling>& couplings, int body, int other) {
  for (const MassCoupling& c : couplings) {
    if (c.first == body && c.second == other) return c.inverse;
    if (c.first == other && c.second == body) return c.inverse.transpose();
  }
  return Mat6d::Zero();
}

}  // namespace

ConstraintSolver::ConstraintSolver(const Terms& terms)
    : terms_(terms), model_(terms.model()), others_hold_(terms.model()) {
  const Model& m = model_;
  const auto bodies = idx(m.body_count()), elements = m.elements.size();
  over_mass_.assign(2 * elements + m.schur.crossings().size(), Mat6d::Zero());
  values_.assign(m.schur.value_count(), 0.0);
  multipliers_.assign(idx(m.rows()), 0.0);
  impulse_.assign(bodies + 1, Vec6d::Zero());
  here_.reserve(idx(m.rows()));
  over_shape_ = over_mass_;
  dense_mass_.assign(bodies, Mat6d::Zero());
  shape_values_.assign(m.schur.value_count(), 0.0);
  if (6 * m.body_count() + m.rows() <= kDenseLimit) {
    dense_.emplace(m.body_count(), m.rows());
    row_space_.emplace(m.body_count(), m.rows());
  }
}

bool ConstraintSolver::has_many_rows() const {
  return !model_.paper_kinematics && (!dense_ || model_.rows() > kManyRows);
}

void ConstraintSolver::factor() {
  const Model& m = model_;
  if (chooses_) return choose_here(kWeakPivot);
  assemble();
  here_.clear();
  const bool keeps = others_hold_.any();
  condition_ = keeps ? m.schur.factor(values_.data(), m.left_out) : m.schur.factor(values_.data());
  const bool accurate = condition_ <= kInaccuratePivot && !others_hold_.stand_open(terms_.blocks().data());
  left_out_ = others_hold_.count();
  regular_ = accurate && (keeps || !m.redundant);
  if (!regular_) return factor_anew();
  most_left_out_ = std::max(most_left_out_, left_out_);
}

void ConstraintSolver::factor_anew() {
  if (has_many_rows()) choose_here(kDependentPivot);
  if (dense_ && !(regular_ && condition_ <= kDependentPivot)) factor_dense();
}

void ConstraintSolver::assemble() {
  const Model& m = model_;
  const auto& blocks = terms_.blocks();
  for_each_side(m.elements, m.body_count(), [&](std::size_t e, int side, int body) {
    rows_over_mass(terms_.inertia(body), blocks[e].d[side], over_mass_[2 * e + idx(side)]);
  });
  for (std::size_t i = 0; i < m.schur.crossings().size(); ++i) {
    const auto [side, body, other] = m.schur.crossings()[i];
    over_mass_[2 * m.elements.size() + i].noalias() =
        blocks[idx(side / 2)].d[side % 2] * inverse_between(terms_.couplings(), body, other);
  }
  m.schur.assemble(blocks.data(), over_mass_.data(), values_.data());
}

/// Leaves out rows of which geometry leaves less than one part in `most`, in the order of elimination.
void ConstraintSolver::choose_here(double most) {
  assemble_shape();
  model_.schur.choose(shape_values_.data(), model_.schur.diagonal(shape_values_.data()), most, here_);
  assemble();
  condition_ = model_.schur.factor(values_.data(), here_);
  left_out_ = static_cast<int>(std::ranges::count(here_, 1));
  most_left_out_ = std::max(most_left_out_, left_out_);
  regular_ = true;
}

bool ConstraintSolver::misses(const std::vector<Vec6d>& acceleration) const {
  return regular_ && here_.empty() && others_hold_.are_missed(terms_.blocks().data(), acceleration.data());
}

void ConstraintSolver::assemble_shape() {
  const Model& m = model_;
  const auto& blocks = terms_.blocks();
  for_each_side(m.elements, m.body_count(), [&](std::size_t e, int side, int body) {
    rows_over_shape(m.bodies[idx(body)], terms_.bodies()[idx(body)], blocks[e].d[side],
                    over_shape_[2 * e + idx(side)]);
  });
  m.schur.assemble(blocks.data(), over_shape_.data(), shape_values_.data());
}

void ConstraintSolver::factor_dense() {
  const Model& m = model_;
  const RowBlock<double>* blocks = terms_.blocks().data();
  regular_ = false;
  left_out_ = 0;
  assemble_shape();
  dependent_ = m.schur.factor(shape_values_.data()) > kDependentPivot || m.redundant;
  if (dependent_) {
    left_out_ = m.rows() - row_space_->factor(m.elements, blocks, over_shape_.data(), kEnforcedSingularValue);
    most_left_out_ = std::max(most_left_out_, left_out_);
  }
  for (int b = 0; b < m.body_count(); ++b) dense_mass_[idx(b)] = terms_.symmetric_mass(b);
  dense_->factor(m.elements, blocks, dense_mass_.data(), terms_.couplings(),
                 dependent_ ? &*row_space_ : nullptr);
}

void ConstraintSolver::solve(const std::vector<Vec6d>& load, const std::vector<double>& right,
                             std::vector<Vec6d>& acceleration, std::vector<double>& lambda) {
  const Model& m = model_;
  if (!regular_) {
    dense_->solve(load.data(), right.data(), acceleration.data(), lambda.data());
    return;
  }
  const auto& blocks = terms_.blocks();
  for (Vec6d& of_body : acceleration) of_body.setZero();
  add_over_mass(load, acceleration);
  lambda = right;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    if (element.rows == 0) continue;
    const Vec6d free = blocks[e].d[0] * acceleration[idx(element.first)] +
                       blocks[e].d[1] * acceleration[idx(element.second)];
    for (int r = 0; r < element.rows; ++r) lambda[idx(element.row + r)] -= free[r];
  }
  m.schur.solve(values_.data(), lambda.data());
  multiplier_load(terms_, lambda.data(), impulse_);
  add_over_mass(impulse_, acceleration);
}

/// acceleration += M^-1 load, by body.
void ConstraintSolver::add_over_mass(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) const {
  for (int b = 0; b < model_.body_count(); ++b) {
    acceleration[idx(b)] += solve_inertia(terms_.inertia(b), load[idx(b)]);
  }
  for (const MassCoupling& c : terms_.couplings()) {
    c.add_product(c.inverse, load.data(), acceleration.data());
  }
}

void ConstraintSolver::solve_unsymmetric(const std::vector<Vec6d>& load, const std::vector<double>& right,
                                         std::vector<Vec6d>& acceleration, std::vector<double>& lambda) {
  const Model& m = model_;
  for (int b = 0; b < m.body_count(); ++b) dense_mass_[idx(b)] = terms_.mass_matrix(b);
  dense_->factor(m.elements, terms_.blocks().data(), dense_mass_.data(), terms_.couplings(), nullptr);
  dense_->solve(load.data(), right.data(), acceleration.data(), lambda.data());
  if (!regular_) factor_dense();  // project() corrects in the symmetric metric
}

void ConstraintSolver::correct(std::vector<double>& residual, std::vector<Vec6d>& motion) {
  if (!regular_) {
    dense_->solve(nullptr, residual.data(), motion.data(), multipliers_.data());
    return;
  }
  model_.schur.solve(values_.data(), residual.data());
  multiplier_load(terms_, residual.data(), impulse_);
  for (Vec6d& of_body : motion) of_body.setZero();
  add_over_mass(impulse_, motion);
}

Dependence ConstraintSolver::take_dependence() {
  const Model& m = model_;
  if (m.rows() == 0) return {};
  redundant_ = redundant_rows(m, redundant_, left_out_);
  // Where rows are redundant from the start, nothing is ever left of the worst one.
  const bool hidden = !regular_ && redundant_ > 0 && redundant_ <= left_out_;
  const double ratio = hidden ? std::pow(row_space_->singular_value(redundant_), -2) : condition_;
  return {ratio, redundant_, left_out_, std::exchange(most_left_out_, 0)};
}

ConstraintRank ConstraintSolver::rank(int skipped) {
  if (chooses_ || !row_space_ || model_.rows() > kMostDecomposed) return rank_of_many();
  factor();
  ConstraintRank out;
  out.condition = condition_;
  assemble_shape();
  out.rank = row_space_->factor(model_.elements, terms_.blocks().data(), over_shape_.data(),
                                kRedundantSingularValue);
  out.shared = row_space_->null_space().rowwise().norm();
  out.smallest_singular_value = row_space_->singular_value(skipped);
  out.weakest = weakest_element(skipped);
  return out;
}

/// By the pivots of S: rounding leaves less than one part in kRedundantPivot of rows that others hold.
ConstraintRank ConstraintSolver::rank_of_many() {
  choose_here(kRedundantPivot);
  ConstraintRank out;
  out.condition = condition_;
  out.rank = model_.rows() - left_out_;
  if (left_out_ == 0) return out;
  out.left_out = here_;
  out.shared = shared_rows();
  return out;
}

/// The largest part of each row in a combination that depends on others, with the geometry of choose_here().
VecXd ConstraintSolver::shared_rows() {
  VecXd out = VecXd::Zero(model_.rows());
  for (const auto& combination : null_space(shape_values_.data(), here_).colwise()) {
    out = out.cwiseMax(combination.cwiseAbs() / combination.norm());
  }
  return (out.array() > kPart).select(out, 0.0);
}

/// A basis of ker(D^T), a column for each row left out.
const MatXd& ConstraintSolver::null_space(double* factored, const std::vector<char>& left_out) {
  null_space_.resize(model_.rows(), std::ranges::count(left_out, 1));
  Eigen::Index column = 0;
  for (int row = 0; row < model_.rows(); ++row) {
    if (left_out[idx(row)]) model_.schur.null_vector(factored, row, null_space_.col(column++).data());
  }
  return null_space_;
}

void ConstraintSolver::shorten(std::vector<double>& lambda) {
  if (!regular_ || left_out_ == 0) return;
  const MatXd& n = null_space(values_.data(), here_.empty() ? model_.left_out : here_);
  Eigen::Map<VecXd> multipliers(lambda.data(), model_.rows());
  const MatXd gram = n.transpose() * n;
  multipliers -= n * Eigen::LDLT<MatXd>(gram).solve(n.transpose() * multipliers);
}

/// The element with the largest part in a combination of rows.
int ConstraintSolver::weakest_element(int combination) const {
  int weakest = -1;
  double largest = -1.0;
  for (std::size_t e = 0; e < model_.elements.size(); ++e) {
    const ElementModel& element = model_.elements[e];
    const double part = row_space_->combination(combination).segment(element.row, element.rows).norm();
    if (element.rows == 0 || !(part > largest)) continue;
    largest = part;
    weakest = static_cast<int>(e);
  }
  return weakest;
}

}  // namespace seacrane
