#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <vector>

#include "seacrane/dynamics/dependence.hpp"
#include "seacrane/dynamics/recursive/articulated.hpp"
#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// Rows that a tree leaves open (cut joints, drivers): a small dense block G = D M^-1 D^T on top of the tree,
/// one response of the tree per row. Where rows depend on each other or on what the tree holds, only the
/// combinations that geometry tells apart are enforced, by the measure of the maximal form (RowSpace).
/// Nothing is allocated after construction. Scratch of one run.
class LoopClosure {
 public:
  LoopClosure(const Model& model, const BodyTree& tree);

  int rows() const { return static_cast<int>(rows_.size()); }
  /// G at the tree's last factor(mass), for the rows in `blocks` (by element); the tree is left as it was.
  void factor(const RowBlock<double>* blocks, const Mat6d* mass, const BodyKinematics<double>* bodies,
              ArticulatedTree<double>& tree);
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
  /// The multipliers of the last solve().
  const VecXd& multipliers() const { return multipliers_; }

 private:
  struct Row {
    int element, row, first, second;
    bool driver;
    Eigen::Vector2d first_free, second_free;  // compliance of the bodies without joints: force, moment
  };

  void gather(const RowBlock<double>* blocks, ArticulatedTree<double>& tree, MatXd& g);
  double decompose(const MatXd& g);
  bool is_independent(const RowBlock<double>* blocks, const Mat6d* mass, const BodyKinematics<double>* bodies,
                      ArticulatedTree<double>& tree);
  void reduce();

  const Model& model_;
  std::vector<Row> rows_;
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
