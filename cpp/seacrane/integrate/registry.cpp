#include "seacrane/integrate/registry.hpp"

#include <stdexcept>

// The one list of integrators: the name a user gives, and the function of the method's own file that makes
// it. A new method is added here and nowhere else.
// clang-format off
#define SEACRANE_INTEGRATORS(entry)                                \
  entry("semi-implicit-euler", make_semi_implicit_euler)           \
  entry("rk4", make_rk4)                                           \
  entry("rk4-exact-memory", make_rk4_exact_memory)                 \
  entry("rk-low-storage", make_rk_low_storage)                     \
  entry("heun21", make_heun21)                                     \
  entry("bs32", make_bs32)                                         \
  entry("rk43", make_rk43)                                         \
  entry("dopri5", make_dopri5)                                     \
  entry("tsit5", make_tsit5)                                       \
  entry("verner65", make_verner65)                                 \
  entry("verner76", make_verner76)                                 \
  entry("dop853", make_dop853)                                     \
  entry("rosenbrock", make_rosenbrock)                             \
  entry("generalized-alpha", make_generalized_alpha)               \
  entry("generalized-alpha-index2", make_generalized_alpha_index2) \
  entry("ark-erk", make_ark_erk)                                   \
  entry("ark-dirk", make_ark_dirk)                                 \
  entry("ark-imex", make_ark_imex)                                 \
  entry("ark-mri", make_ark_mri)                                   \
  entry("cvode-adams", make_cvode_adams)                           \
  entry("cvode-bdf", make_cvode_bdf)                               \
  entry("ida", make_ida)
// clang-format on

namespace seacrane {

#define SEACRANE_DECLARE(name, make) \
  std::unique_ptr<Integrator> make(System&, ResidualSystem*, const IntegratorOptions&);
SEACRANE_INTEGRATORS(SEACRANE_DECLARE)
#undef SEACRANE_DECLARE

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Integrator> (*make)(System&, ResidualSystem*, const IntegratorOptions&);
};

#define SEACRANE_LIST(name, make) Entry{name, make},
constexpr Entry entries[] = {SEACRANE_INTEGRATORS(SEACRANE_LIST)};
#undef SEACRANE_LIST

void require_spectral_radius(const std::string& name) {
  if (name.starts_with("generalized-alpha")) return;
  throw std::invalid_argument("spectral_radius: integrator \"" + name +
                              "\" has no spectral radius to choose; leave it out, or choose "
                              "\"generalized-alpha\" or \"generalized-alpha-index2\"");
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(System& system, ResidualSystem* residual,
                                            const IntegratorOptions& options) {
  std::string known;
  for (const Entry& entry : entries) {
    if (options.name == entry.name) {
      if (options.spectral_radius) require_spectral_radius(options.name);
      return entry.make(system, residual, options);
    }
    known += known.empty() ? "" : ", ";
    known += entry.name;
  }
  throw std::invalid_argument("unknown integrator \"" + options.name + "\"; choose one of " + known);
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  return names;
}

}  // namespace seacrane
