#include "seacrane/integrate/registry.hpp"

#include <span>
#include <stdexcept>

#include "seacrane/integrate/registration.hpp"

namespace seacrane {

// The one list of integrators, in the order of documents and tables. Each method's own file holds its
// registration; explicit pairs are listed in tableaus/pairs.hpp.
extern const Registration semi_implicit_euler, rk4, rk_low_storage;
std::span<const Registration> explicit_pairs();
extern const Registration dopri5_stiff, rosenbrock, generalized_alpha, cvode_bdf, ida;

namespace {

std::vector<Registration> all() {
  std::vector<Registration> out = {semi_implicit_euler, rk4, rk_low_storage};
  const auto pairs = explicit_pairs();
  out.insert(out.end(), pairs.begin(), pairs.end());
  out.insert(out.end(), {dopri5_stiff, rosenbrock, generalized_alpha, cvode_bdf, ida});
  return out;
}

[[noreturn]] void refuse(const std::string& name) {
  std::string known;
  for (const Registration& method : all()) {
    known += known.empty() ? "" : ", ";
    known += method.properties->name;
  }
  throw std::invalid_argument("unknown integrator \"" + name + "\"; choose one of " + known);
}

Registration find(const std::string& name) {
  for (const Registration& method : all()) {
    if (name == method.properties->name) return method;
  }
  refuse(name);
}

std::string quoted(const IntegratorProperties& method) {
  return "integrator \"" + std::string(method.name) + "\"";
}

void check(const IntegratorProperties& method, const Problem& problem, const IntegratorOptions& options) {
  if (options.spectral_radius && !method.has_spectral_radius) {
    std::string having;
    for (const Registration& other : all()) {
      if (!other.properties->has_spectral_radius) continue;
      having += having.empty() ? "\"" : " or \"";
      having += std::string(other.properties->name) + "\"";
    }
    throw std::invalid_argument("spectral_radius: " + quoted(method) +
                                " has no spectral radius to choose; leave it out, or choose " + having);
  }
  if (options.lanes > 1 && !method.lanes) {
    throw std::invalid_argument(
        quoted(method) +
        " does not step systems side by side; choose an explicit pair, rk4 or rk-low-storage");
  }
  if (method.residual_form && problem.residual == nullptr) {
    throw std::invalid_argument(quoted(method) + " needs the residual form of the system");
  }
  if (method.uses_positions && problem.positions == nullptr) {
    throw std::invalid_argument(quoted(method) + " needs a system that tells its positions");
  }
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const Problem& problem, const IntegratorOptions& options) {
  const Registration method = find(options.name);
  check(*method.properties, problem, options);
  return method.make(problem, options);
}

IntegratorProperties integrator_of(const std::string& name) { return *find(name).properties; }

std::vector<IntegratorProperties> integrators() {
  std::vector<IntegratorProperties> out;
  for (const Registration& method : all()) out.push_back(*method.properties);
  return out;
}

std::vector<double> stability_polynomial(const std::string& integrator) {
  for (const Registration& method : all()) {
    if (integrator == method.properties->name && method.stability_polynomial) {
      return method.stability_polynomial();
    }
  }
  return {};
}

}  // namespace seacrane
