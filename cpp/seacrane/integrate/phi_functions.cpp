#include "seacrane/integrate/phi_functions.hpp"

#include <cmath>

namespace seacrane {
namespace {

/// Norm below which the polynomial is used, and its degree: the first term left out of phi_3 is below
/// 0.5^15 3! / 18! = 3e-20 of the first.
constexpr double taylor_norm = 0.5;
constexpr int taylor_degree = 14;

}  // namespace

PhiFunctions::PhiFunctions(Eigen::Index size) : scaled_(size, size), product_(size, size) {
  for (MatXd& phi : phi_) phi.resize(size, size);
}

void PhiFunctions::evaluate(const MatXd& z) {
  const double norm = z.cwiseAbs().rowwise().sum().maxCoeff();
  const int doublings = norm > taylor_norm ? static_cast<int>(std::ceil(std::log2(norm / taylor_norm))) : 0;
  scaled_ = std::ldexp(1.0, -doublings) * z;
  // 3! phi_3 = 1 + z / 4 (1 + z / 5 (1 + ...)).
  phi_[3].setIdentity();
  for (int j = taylor_degree; j > 0; --j) {
    product_.noalias() = scaled_ * phi_[3];
    phi_[3] = product_ / (j + 3.0);
    phi_[3].diagonal().array() += 1.0;
  }
  phi_[3] /= 6.0;
  double constant = 0.5;
  for (std::size_t k = 3; k > 0; --k) {
    phi_[k - 1].noalias() = scaled_ * phi_[k];
    phi_[k - 1].diagonal().array() += constant;
    constant = 1.0;
  }
  for (int i = 0; i < doublings; ++i) double_argument();
}

/// phi_k(2 z) from those of z, the highest first: each needs the lower ones of z.
void PhiFunctions::double_argument() {
  product_.noalias() = phi_[1] * phi_[2];
  phi_[3] = 0.125 * (product_ + 2.0 * phi_[3] + phi_[2]);
  product_.noalias() = phi_[1] * phi_[1];
  phi_[2] = 0.25 * (product_ + 2.0 * phi_[2]);
  product_.noalias() = phi_[0] * phi_[1];
  phi_[1] = 0.5 * (product_ + phi_[1]);
  product_.noalias() = phi_[0] * phi_[0];
  phi_[0] = product_;
}

}  // namespace seacrane
