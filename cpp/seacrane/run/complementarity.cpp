#include "seacrane/run/complementarity.hpp"

#include <cmath>
#include <vector>

#include "seacrane/math/dense.hpp"

namespace seacrane {
namespace {

constexpr double kForceRounding = 1e-10;  // of the largest b
constexpr double kDependent = 1e-11;      // relative pivot of G

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// The shortest solution of G z = -b over the contacts that carry; zero for the others.
VecXd carried(const MatXd& g, const VecXd& b, const Flags& carries) {
  std::vector<Eigen::Index> at;
  for (Eigen::Index i = 0; i < carries.size(); ++i) {
    if (carries[i]) at.push_back(i);
  }
  VecXd z = VecXd::Zero(b.size());
  if (at.empty()) return z;
  z(at) = shortest_solution(g(at, at), -b(at), kDependent);
  return z;
}

}  // namespace

VecXd complementary_forces(const MatXd& g, const VecXd& b) {
  const Eigen::Index n = b.size();
  VecXd f = VecXd::Zero(n), w = b;
  Flags carries = Flags::Constant(n, false), refused = Flags::Constant(n, false);
  const double least = n > 0 ? kForceRounding * b.cwiseAbs().maxCoeff() : 0.0;
  for (Eigen::Index turn = 0; turn < 4 * n + 4; ++turn) {
    Eigen::Index next = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!carries[i] && !refused[i] && w[i] < -least && (next < 0 || w[i] < w[next])) next = i;
    }
    if (next < 0) break;
    carries[next] = true;
    // A contact that no force parts, by rounding or because all is held, waits until the others have changed.
    if (!(carried(g, b, carries)[next] > 0.0)) {
      carries[next] = false;
      refused[next] = true;
      continue;
    }
    refused.setConstant(false);
    for (;;) {
      const VecXd z = carried(g, b, carries);
      double part = 1.0;
      Eigen::Index out = -1;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (!carries[i] || z[i] > 0.0) continue;
        const double reach = f[i] / (f[i] - z[i]);
        if (out >= 0 && reach >= part) continue;
        part = reach;
        out = i;
      }
      if (out < 0) {
        f = z;
        break;
      }
      f += std::isfinite(part) ? part * (z - f) : VecXd(VecXd::Zero(n));
      f[out] = 0.0;
      carries[out] = false;
    }
    w = g * f + b;
  }
  return f;
}

}  // namespace seacrane
