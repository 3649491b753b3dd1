#pragma once

#include <array>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// phi_0(z) = exp(z), phi_k(z) = (phi_{k-1}(z) - 1 / (k-1)!) / z, k = 1 to 3, of a square matrix: what
/// exponential integrators are made of. By scaling, a Taylor polynomial and doubling [N. J. Higham, Functions
/// of Matrices, 2008, section 10.7.4]. Scratch of one size; evaluate() allocates nothing for small matrices.
class PhiFunctions {
 public:
  explicit PhiFunctions(Eigen::Index size);

  void evaluate(const MatXd& z);
  const MatXd& operator[](std::size_t k) const { return phi_[k]; }

 private:
  void double_argument();

  std::array<MatXd, 4> phi_;
  MatXd scaled_, product_;
};

}  // namespace seacrane
