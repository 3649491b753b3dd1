#include "seacrane/sea/near_sea.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "seacrane/math/types.hpp"
#include "seacrane/sea/knot_table.hpp"

namespace seacrane {
namespace {

constexpr double longest = 12.0;       // k times the reach of a stencil that is served
constexpr double lattice = 16.0;       // k times the distance of regions
constexpr double above = 0.2;          // k z up to which kernels are taken: elements reach over z = 0
constexpr double least_cut = 1e-5;     // of a stencil, far above the bound
constexpr std::size_t least_gain = 3;  // components over the few

/// Points on half of the edge of a region of half length `half`; the kernels of the other half are conjugate.
/// Errors are analytic in z - is, so that none is larger within. The first `top` points are at the surface.
struct Edge {
  VecXd s, z;
  Eigen::Index top;

  Edge(const SeaField& sea, double half, double density) {
    const double k = sea.arrays().k[sea.size() - 1];
    const double deepest = std::min(sea.depth(), 20.0 / sea.arrays().k[0]);
    const double first = std::min(0.1 / k, 0.1 * deepest), turns = density * (10.0 + half * k);
    top = static_cast<Eigen::Index>(turns);
    const auto side = static_cast<Eigen::Index>(16.0 * density);
    s = VecXd::Constant(top + side, half);
    z = VecXd::Constant(top + side, above / k);
    for (Eigen::Index i = 0; i < top; ++i)
      s[i] *= std::cos(0.5 * std::numbers::pi * static_cast<double>(i) / (static_cast<double>(top) - 0.5));
    for (Eigen::Index i = 0; i < side; ++i)
      z[top + i] = -first * std::pow(deepest / first, static_cast<double>(i) / static_cast<double>(side - 1));
  }
};

/// At the points of an edge, a column for each wavenumber: cosh k(z + d) and sinh k(z + d), over cosh kd,
/// times exp(-iks).
struct Kernels {
  Eigen::MatrixXcd level, upright;

  Kernels(const Edge& edge, const VecXd& k, double depth)
      : level(edge.s.size(), k.size()), upright(edge.s.size(), k.size()) {
    for (Eigen::Index j = 0; j < k.size(); ++j) {
      const double floor = std::exp(-2.0 * k[j] * depth);
      for (Eigen::Index i = 0; i < edge.s.size(); ++i) {
        const double down = std::exp(k[j] * edge.z[i]);
        const double image = floor > 0.0 ? std::exp(-k[j] * (edge.z[i] + 2.0 * depth)) : 0.0;
        const std::complex<double> turn = std::polar(1.0 / (1.0 + floor), -k[j] * edge.s[i]);
        level(i, j) = (down + image) * turn;
        upright(i, j) = (down - image) * turn;
      }
    }
  }
};

class Decomposition {
 public:
  Decomposition(const SeaField& sea, double half)
      : depth_(sea.depth()), edge_(sea, half, 1.0), finer_(sea, half, 1.5) {
    const auto of = [&](const std::vector<double>& all) {
      return VecXd(VecXd::Map(all.data(), static_cast<Eigen::Index>(sea.size())));
    };
    k_ = of(sea.arrays().k), omega_ = of(sea.arrays().omega), sigma_ = of(sea.arrays().sigma);
    amplitude_ = of(sea.arrays().amplitude);
    const Kernels kernels(edge_, k_, depth_);
    const auto points = edge_.s.size();
    MatXd weighed(2 * points, k_.size());
    weighed << kernels.level.real(), kernels.level.imag();
    qr_.compute(weighed * amplitude_.cwiseProduct(omega_).asDiagonal());
  }

  /// Components that are kept, and what each is of all others, times their amplitudes: kept x all.
  struct Kept {
    std::vector<std::size_t> which;
    MatXd shares;
  };
  /// With the bound, or none.
  Kept least(std::size_t most) const {
    const VecXd left = qr_.matrixQR().diagonal().cwiseAbs();
    most = std::min(most, static_cast<std::size_t>(left.size()) - 1);
    std::size_t count = SeaField::lanes;
    while (count < most && left[idx_of(count)] > 0.3 * NearSea::relative_bound * left[0])
      count += SeaField::lanes;
    for (; count <= most; count += SeaField::lanes) {
      Kept out = kept(count);
      if (error(out) <= NearSea::relative_bound) return out;
    }
    return {};
  }

  /// The largest step of knots within the bound, in each of their numbers.
  double step(const Kept& few) const {
    double out = std::numeric_limits<double>::infinity();
    const VecXd one = VecXd::Ones(k_.size()), slow = sigma_.cwiseInverse();
    const VecXd twelfth = omega_.array().pow(12);
    const auto limit = [&](const VecXd& factor, bool sloped) {
      VecXd weight = VecXd::Ones(few.shares.rows());
      if (sloped) weight = wavenumbers(few);
      const double moves = (few.shares.cwiseAbs().transpose() * weight).cwiseProduct(factor).dot(twelfth);
      const double size = amplitude_.cwiseProduct(factor).dot(sloped ? k_ : one);
      out = std::min(out, std::pow(NearSea::knot_bound * size / (hermite_remainder * moves), 1.0 / 12.0));
    };
    for (const bool sloped : {false, true}) limit(one, sloped), limit(slow, true), limit(omega_, false);
    return out;
  }

 private:
  static Eigen::Index idx_of(std::size_t i) { return static_cast<Eigen::Index>(i); }

  VecXd wavenumbers(const Kept& few) const {
    VecXd out(idx_of(few.which.size()));
    for (std::size_t j = 0; j < few.which.size(); ++j) out[idx_of(j)] = k_[idx_of(few.which[j])];
    return out;
  }

  Kept kept(std::size_t count) const {
    const auto n = idx_of(count);
    const auto& order = qr_.colsPermutation().indices();
    MatXd solved = qr_.matrixQR().topRows(n);
    qr_.matrixQR().topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(solved);
    solved.leftCols(n).setIdentity();
    std::vector<std::size_t> rank(count);
    for (std::size_t j = 0; j < count; ++j) rank[j] = j;
    std::ranges::sort(rank,
                      [&](std::size_t a, std::size_t b) { return order[idx_of(a)] < order[idx_of(b)]; });
    Kept out{{}, MatXd(n, k_.size())};
    for (std::size_t j = 0; j < count; ++j) {
      const auto from = idx_of(rank[j]), own = static_cast<Eigen::Index>(order[from]);
      out.which.push_back(static_cast<std::size_t>(own));
      for (Eigen::Index i = 0; i < k_.size(); ++i)
        out.shares(idx_of(j), order[i]) =
            solved(from, i) * amplitude_[own] * omega_[own] / omega_[static_cast<Eigen::Index>(order[i])];
    }
    return out;
  }

  /// Largest on the edge, of each number over the sum of its magnitudes.
  double error(const Kept& few) const {
    const VecXd few_k = wavenumbers(few), one = VecXd::Ones(k_.size()), slow = sigma_.cwiseInverse();
    const Kernels all(finer_, k_, depth_), some(finer_, few_k, depth_);
    const MatXd flat = missed(all.level, some.level, one, VecXd::Ones(few_k.size()), few.shares);
    const MatXd along = missed(all.level, some.level, k_, few_k, few.shares);
    const MatXd up = missed(all.upright, some.upright, k_, few_k, few.shares);
    const auto share = [&](const MatXd& of, const VecXd& factor, const VecXd& by) {
      return VecXd(of * factor).maxCoeff() / amplitude_.cwiseProduct(factor).dot(by);
    };
    return std::max({share(flat, one, one), share(flat.topRows(finer_.top), omega_, one),
                     share(along, one, k_), share(up, one, k_), share(along, slow, k_), share(up, slow, k_)});
  }

  /// Of each component at each point, `by` factors of the kernels.
  MatXd missed(const Eigen::MatrixXcd& all, const Eigen::MatrixXcd& some, const VecXd& by,
               const VecXd& few_by, const MatXd& shares) const {
    const Eigen::MatrixXcd by_few = some * few_by.asDiagonal();
    const MatXd real = all.real() * amplitude_.cwiseProduct(by).asDiagonal() - by_few.real() * shares;
    const MatXd imaginary = all.imag() * amplitude_.cwiseProduct(by).asDiagonal() - by_few.imag() * shares;
    return (real.cwiseAbs2() + imaginary.cwiseAbs2()).cwiseSqrt();
  }

  double depth_;
  Edge edge_, finer_;
  VecXd k_, omega_, sigma_, amplitude_;
  Eigen::ColPivHouseholderQR<MatXd> qr_;
};

double largest_k(const SeaField& sea) { return sea.arrays().k[sea.size() - 1]; }

bool long_crested(const SeaField& sea) {
  const SeaField::Arrays& f = sea.arrays();
  for (std::size_t i = 1; i < sea.size(); ++i) {
    if (f.x[i] != f.x[0] || f.y[i] != f.y[0]) return false;
  }
  return true;
}

/// Every component reaches an element, so that what it feels is a mean of the kernels.
bool felt(const FlowStencil& stencil, double k) {
  return stencil.cut >= least_cut && k * stencil.width < 1.99 * std::numbers::pi &&
         k * stencil.reach <= longest;
}

}  // namespace

bool NearSea::serves(const FlowStencil& stencil) const {
  return stencil.reach <= reach_ && felt(stencil, largest_k(*all_));
}

std::shared_ptr<const NearSea> NearSea::of(const std::shared_ptr<const SeaField>& all,
                                           const std::vector<FlowStencil>& stencils) {
  constexpr std::size_t fewest = 12;
  if (!all || !(all->crest() > 0.0) || all->stretching() != Stretching::wheeler || !long_crested(*all) ||
      all->size() < least_gain * fewest) {
    return nullptr;
  }
  const double k = largest_k(*all);
  double reach = -1.0;
  for (const FlowStencil& one : stencils) {
    if (felt(one, k)) reach = std::max(reach, one.reach);
  }
  if (reach < 0.0) return nullptr;
  const double spacing = lattice / k;
  const Decomposition decomposition(*all, 0.5 * spacing * (1.0 + overlap) + reach);
  const auto kept = decomposition.least(all->size() / least_gain);
  if (kept.which.empty()) return nullptr;
  std::shared_ptr<NearSea> out(new NearSea(all, all->of_unit_height(kept.which)));
  out->reach_ = reach;
  out->spacing_ = spacing;
  out->step_ = decomposition.step(kept);
  const std::size_t n = all->padded(), few = out->few_.padded();
  out->shares_.assign(n * few, 0.0);
  for (auto& factor : out->factors_) factor.assign(n, 0.0);
  for (std::size_t i = 0; i < all->size(); ++i) {
    for (std::size_t j = 0; j < kept.which.size(); ++j)
      out->shares_[i * few + j] = kept.shares(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
    const double omega = all->arrays().omega[i], sigma = all->arrays().sigma[i];
    out->factors_[0][i] = 1.0, out->factors_[1][i] = all->gravity() / sigma, out->factors_[2][i] = omega;
  }
  return out;
}

}  // namespace seacrane
