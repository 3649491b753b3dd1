#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "seacrane/math/types.hpp"

// Dense decompositions of matrices of any size. Each costs the compiler as much as a file of ours, so they
// are compiled once, in dense.cpp.
namespace Eigen {

extern template class PartialPivLU<MatrixXd>;
extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute<MatrixXd>(
    const EigenBase<MatrixXd>&, int);
extern template LDLT<MatrixXd>& LDLT<MatrixXd>::compute<MatrixXd>(const EigenBase<MatrixXd>&);

}  // namespace Eigen

namespace seacrane {

/// An orthonormal basis of independent columns; shape (rows, columns).
MatXd orthonormal(const MatXd& columns);

/// An orthonormal basis of what is perpendicular to all columns, those left out whose pivot is below
/// `threshold` times the largest; shape (rows, rows - rank).
MatXd perpendicular(const MatXd& columns, double threshold);

/// The shortest x of a x = b, where pivots below `threshold` times the largest are none.
VecXd shortest_solution(const MatXd& a, const VecXd& b, double threshold);

}  // namespace seacrane
