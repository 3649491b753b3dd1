#pragma once

#include <vector>

#include "seacrane/dynamics/body_residual.hpp"
#include "seacrane/dynamics/inertial_tensions.hpp"
#include "seacrane/dynamics/jacobian.hpp"
#include "seacrane/dynamics/recursive/driven_speeds.hpp"
#include "seacrane/dynamics/recursive/loop_closure.hpp"

namespace seacrane {

/// What an evaluation of the recursive formulation left behind.
struct TreeEvaluation {
  const Terms& terms;
  ArticulatedTree<double>& tree;
  LoopClosure& loops;
  InertialTensions& tensions;
  const Mat6d* mass;               // by body
  const Vec6d* load;               // by body: wrench less velocity terms, multipliers of loops included
  const Vec6d* acceleration;       // by body
  const RowBlock<double>* blocks;  // by element
  const DrivenSpeeds& driven;
  const std::vector<double>& forces;  // see TreeDerivative::read_forces
};

/// Exact Jacobian of dy/dt of the recursive formulation, y = (positions q, speeds u, memory, work). With the
/// rates of the speeds and the multipliers held, the equations of motion of every cluster,
///
///   g = sum over its bodies and all they carry of S^T (load + D^T lambda - M (S udot + bias)) = 0,
///
/// are differentiated: slopes of a body's share in its own twelve directions (BodyResidual), times those of
/// the bodies' kinematics in (q, u), which the recursions outwards give on dual numbers; a recursion inwards
/// on dual numbers gathers them. Then H dudot - (D S)^T dlambda = dg, with what closes loops, is solved by
/// the factors of the evaluation.
class RecursiveJacobian {
 public:
  RecursiveJacobian(const Model& model, const BodyTree& tree);
  RecursiveJacobian(const RecursiveJacobian&) = delete;
  RecursiveJacobian& operator=(const RecursiveJacobian&) = delete;

  /// Right after an evaluation at (t, y) with rates `rate`: writes df/dy by columns.
  void evaluate(const TreeEvaluation& at, double t, const double* y, const double* rate, double* out);

 private:
  static constexpr int kDirections = BodyResidual::kDirections;
  using Scalar = BodyResidual::Scalar;
  using Square = Eigen::Matrix<double, kDirections, kDirections>;
  using Row = Eigen::Matrix<double, 1, kDirections>;
  /// Slopes of the residual of one body in the directions of another.
  struct Share {
    int to, from;
    BodyResidual::Slopes slopes;
  };
  struct RowShare {
    int row, from;
    Row slopes;
  };

  void differentiate_bodies(double t, const double* y);
  void differentiate_tree(int first, const double* y, const double* rate, double* out);
  void read_kinematics();
  void spread_acceleration(const double* u_rate);
  void gather();
  void write_column(int k, double* column);
  void spread_torques(int k);
  void turn_rows(int k);
  void add_drive_power(double& power, double& absolute_power);
  void solve(double* column, double power, double absolute_power);
  void respond(double* u_rate);
  void add_inertial_slopes(int direction);
  void write_memory_columns(const double* y, double* out);
  void write_group_columns(std::size_t group, const double* y, double* out);
  void respond_to_motions(std::size_t vessel, double direction);
  void write_state_columns(double* out);
  double along_row(int row, const Vec6d* acceleration) const;

  const Model* model_;
  const BodyTree& tree_;
  const TreeEvaluation* at_ = nullptr;  // during an evaluation
  BodyResidual residual_;
  std::vector<MemoryMatrices> memory_, groups_;
  int states_ = 0;                         // of the memory and of loads
  std::vector<std::pair<int, int>> rows_;  // element and its row, of the loops
  std::vector<double> multipliers_;        // by row of the model

  std::vector<Share> shares_;
  std::vector<RowShare> row_shares_;
  std::vector<Row> power_, absolute_power_;  // by body
  using Rates = Eigen::Matrix<double, Eigen::Dynamic, kDirections>;
  std::vector<Rates> fluid_;       // memory rates, by vessel
  std::vector<Rates> group_;       // those of its group
  std::vector<Rates> state_over_;  // rates of the states of loads, by body

  std::vector<Scalar> state_, state_rate_;  // positions and speeds, rates of positions
  std::vector<BodyKinematics<Scalar>> bodies_;
  TreeKinematics<Scalar> kinematics_;
  std::vector<Twist<Scalar>> acceleration_;
  std::vector<Wrench<Scalar>> force_;
  std::vector<Square> motion_;                // by body: its directions over those of the state
  std::vector<BodyResidual::Slopes> change_;  // of p, by body
  std::vector<Eigen::Matrix<double, 6, kDirections>> torque_;  // dg, by cluster

  std::vector<Rates> inertial_over_;  // inertial tensions with accelerations held, by body

  std::vector<Vec6d> load_, response_, given_load_;
  std::vector<Vec6d> coupled_;  // loads of masses between bodies
  VecXd right_, lambda_, given_right_;
  std::vector<double> drive_change_;  // by driver of the tree
  VecXd own_;                         // changes of inertial tensions with accelerations held
  MatXd to_fluid_;                    // responses to unit loads of the memory
};

}  // namespace seacrane
