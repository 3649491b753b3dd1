#pragma once

#include <optional>
#include <vector>

#include "seacrane/dynamics/dependence.hpp"
#include "seacrane/dynamics/recursive/articulated.hpp"
#include "seacrane/dynamics/recursive/sparse_loops.hpp"
#include "seacrane/dynamics/terms.hpp"
#include "seacrane/math/dense.hpp"

namespace seacrane {

/// Rows that a tree leaves open (cut joints, drivers): a small dense block G = D M^-1 D^T on top of the tree,
/// one response of the tree per row. Where rows depend on each other or on what the tree holds, only the
/// combinations that geometry tells apart are enforced, by the measure of the maximal form (RowSpace). Where
/// many rows couple several trees, G is sparse, and rows that the others hold at assembled poses are left out
/// as long as they hold. Nothing is allocated after choose_rows(). Scratch of one run.
class LoopClosure {
 public:
  LoopClosure(const Model& model, const BodyTree& tree);

  int rows() const { return static_cast<int>(rows_.size()); }
  /// Chooses the rows that are enforced, at assembled poses, where G is sparse.
  /// The tree is left with inertias of geometry.
  void choose_rows(const RowBlock<double>* blocks, const BodyKinematics<double>* bodies,
                   ArticulatedTree<double>& tree);
  /// G at the tree's last factor(mass), for the rows in `blocks` (by element); the tree is left as it was.
  void factor(const RowBlock<double>* blocks, const Mat6d* mass, const BodyKinematics<double>* bodies,
              ArticulatedTree<double>& tree);
  /// The same with all rows, after misses().
  void factor_all(const RowBlock<double>* blocks, const Mat6d* mass, const BodyKinematics<double>* bodies,
                  ArticulatedTree<double>& tree);
  /// Whether rows that were left out do not hold under accelerations of all bodies, ground last.
  bool misses(const RowBlock<double>* blocks, const Vec6d* acceleration) const;
  /// Multipliers of the smallest motion in the mass metric with D dv = right.
  const VecXd& solve(const VecXd& right);
  /// loads += D^T multipliers.
  void add_load(const RowBlock<double>* blocks, const VecXd& multipliers, Vec6d* loads) const;

  /// phi.
  void position_residual(const RowBlock<double>* blocks, VecXd& out) const;
  /// D v - nu for the twists of all bodies, ground last.
  void rate_residual(const RowBlock<double>* blocks, const Vec6d* twists, VecXd& out) const;
  /// gamma - D a.
  void acceleration_residual(const RowBlock<double>* blocks, const Vec6d* acceleration, VecXd& out) const;
  /// Drivers do work lambda nu.
  void add_driver_power(const RowBlock<double>* blocks, const VecXd& multipliers, Terms& terms) const;
  /// How much cancels in the entries of G, times largest over smallest pivot.
  double condition() const { return condition_; }
  Dependence take_dependence();
  /// False where rows depend on each other at the last factor().
  bool regular() const { return !dependent_; }
  /// The place of the first row of an element; -1: it has none here.
  int row_of(int element) const;
  /// The multipliers of the last solve().
  const VecXd& multipliers() const { return multipliers_; }

 private:
  struct Row : LoopRow {
    Eigen::Vector2d first_free, second_free;  // compliance of the bodies without joints: force, moment
  };

  void gather(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, MatXd& g);
  double decompose(const MatXd& g);
  void gather_shape(const RowBlock<double>* blocks, const BodyKinematics<double>* bodies,
                    ArticulatedTree<double>& tree);
  void factor_shape(const BodyKinematics<double>* bodies, ArticulatedTree<double>& tree);
  double loose_shape(const Row& row, const RowBlock<double>* blocks,
                     const BodyKinematics<double>* bodies) const;
  double loose(const Row& row, const RowBlock<double>* blocks) const;
  bool factor_sparse(const RowBlock<double>* blocks, ArticulatedTree<double>& tree);
  bool is_independent(const RowBlock<double>* blocks, const Mat6d* mass, const BodyKinematics<double>* bodies,
                      ArticulatedTree<double>& tree);
  void reduce();

  const Model& model_;
  const BodyTree& tree_;
  std::vector<Row> rows_;
  std::optional<SparseLoops> sparse_;
  bool is_sparse_ = false;  // at the last factor()
  std::vector<Vec6d> load_, response_;
  std::vector<Mat6d> shape_mass_;
  std::vector<double> speeds_;
  MatXd g_, shape_, basis_, product_, scaled_;
  VecXd free_, scale_, combined_, multipliers_;
  Eigen::LDLT<MatXd> ldlt_;
  Eigen::SelfAdjointEigenSolver<MatXd> eigen_;
  double condition_ = 1.0, ratio_ = 1.0;
  bool dependent_ = false;
  int redundant_ = -1, left_out_ = 0, most_left_out_ = 0;  // combinations of rows; -1: not known yet
};

}  // namespace seacrane
