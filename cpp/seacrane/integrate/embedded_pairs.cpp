#include "seacrane/integrate/embedded_pair.hpp"
#include "seacrane/integrate/registry.hpp"
#include "seacrane/integrate/tableaus/bogacki_shampine32.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54.hpp"
#include "seacrane/integrate/tableaus/dormand_prince853.hpp"
#include "seacrane/integrate/tableaus/heun_euler21.hpp"
#include "seacrane/integrate/tableaus/runge_kutta43.hpp"
#include "seacrane/integrate/tableaus/tsitouras54.hpp"
#include "seacrane/integrate/tableaus/verner65.hpp"
#include "seacrane/integrate/tableaus/verner76.hpp"

namespace seacrane {
namespace {

template <class Tableau>
std::unique_ptr<Integrator> make(System& system, const IntegratorOptions& options) {
  return std::make_unique<EmbeddedPair<Tableau>>(system, options);
}

}  // namespace

std::unique_ptr<Integrator> make_heun21(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::HeunEuler21>(system, options);
}
std::unique_ptr<Integrator> make_bs32(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::BogackiShampine32>(system, options);
}
std::unique_ptr<Integrator> make_rk43(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::RungeKutta43>(system, options);
}
std::unique_ptr<Integrator> make_dopri5(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::DormandPrince54>(system, options);
}
std::unique_ptr<Integrator> make_tsit5(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::Tsitouras54>(system, options);
}
std::unique_ptr<Integrator> make_verner65(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::Verner65>(system, options);
}
std::unique_ptr<Integrator> make_verner76(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::Verner76>(system, options);
}
std::unique_ptr<Integrator> make_dop853(System& system, ResidualSystem*, const IntegratorOptions& options) {
  return make<tableaus::DormandPrince853>(system, options);
}

}  // namespace seacrane
