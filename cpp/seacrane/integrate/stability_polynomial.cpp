#include "seacrane/integrate/stability_polynomial.hpp"

#include <cstddef>

#include "seacrane/integrate/tableaus/bogacki_shampine32.hpp"
#include "seacrane/integrate/tableaus/carpenter_kennedy.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54.hpp"
#include "seacrane/integrate/tableaus/dormand_prince853.hpp"
#include "seacrane/integrate/tableaus/heun_euler21.hpp"
#include "seacrane/integrate/tableaus/runge_kutta43.hpp"
#include "seacrane/integrate/tableaus/tsitouras54.hpp"
#include "seacrane/integrate/tableaus/verner65.hpp"
#include "seacrane/integrate/tableaus/verner76.hpp"

namespace seacrane {
namespace {

using Polynomial = std::vector<long double>;

/// sum += factor z p
void add_times_z(Polynomial& sum, long double factor, const Polynomial& p) {
  for (std::size_t power = 0; power + 1 < sum.size(); ++power) sum[power + 1] += factor * p[power];
}

std::vector<double> rounded(const Polynomial& p) { return {p.begin(), p.end()}; }

/// Stage i is 1 + z sum_j a_ij stage_j, and the step is the row after the last stage.
template <class Tableau>
std::vector<double> of_pair() {
  std::vector<Polynomial> stage;
  for (std::size_t i = 0; i <= Tableau::stages; ++i) {
    Polynomial own(Tableau::stages + 1, 0.0L);
    own[0] = 1.0L;
    for (std::size_t j = 0; j < i; ++j) add_times_z(own, Tableau::a[i][j], stage[j]);
    stage.push_back(own);
  }
  return rounded(stage.back());
}

std::vector<double> of_low_storage() {
  using Scheme = tableaus::CarpenterKennedy;
  Polynomial u(Scheme::stages + 1, 0.0L), du = u;
  u[0] = 1.0L;
  for (std::size_t i = 0; i < Scheme::stages; ++i) {
    for (long double& c : du) c *= Scheme::a[i];
    add_times_z(du, 1.0L, u);
    for (std::size_t power = 0; power < u.size(); ++power) u[power] += Scheme::b[i] * du[power];
  }
  return rounded(u);
}

}  // namespace

std::vector<double> stability_polynomial(const std::string& integrator) {
  using namespace tableaus;
  // rk43 steps with the classical weights; what it adds to them is an estimate of the error.
  if (integrator == "rk4" || integrator == RungeKutta43::name) return of_pair<RungeKutta43>();
  if (integrator == "rk-low-storage") return of_low_storage();
  if (integrator == HeunEuler21::name) return of_pair<HeunEuler21>();
  if (integrator == BogackiShampine32::name) return of_pair<BogackiShampine32>();
  if (integrator == DormandPrince54::name) return of_pair<DormandPrince54>();
  if (integrator == Tsitouras54::name) return of_pair<Tsitouras54>();
  if (integrator == Verner65::name) return of_pair<Verner65>();
  if (integrator == Verner76::name) return of_pair<Verner76>();
  if (integrator == DormandPrince853::name) return of_pair<DormandPrince853>();
  return {};
}

}  // namespace seacrane
