#pragma once

#include <memory>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/problem.hpp"

namespace seacrane {

/// What the list of integrators holds of a method.
struct Registration {
  const IntegratorProperties* properties;
  std::unique_ptr<Integrator> (*make)(const Problem&, const IntegratorOptions&);
  /// Null for a method without a stability polynomial.
  std::vector<double> (*stability_polynomial)();
};

/// Registers a class with `static constexpr IntegratorProperties properties`, a constructor from a Problem
/// and options, and perhaps `static std::vector<double> stability_polynomial()`.
template <class Method>
constexpr Registration registration() {
  Registration out{
      &Method::properties,
      [](const Problem& problem, const IntegratorOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Method>(problem, options);
      },
      nullptr};
  if constexpr (requires { Method::stability_polynomial(); }) {
    out.stability_polynomial = &Method::stability_polynomial;
  }
  return out;
}

}  // namespace seacrane
