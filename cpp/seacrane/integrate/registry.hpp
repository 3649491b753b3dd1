#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/problem.hpp"

namespace seacrane {

/// Builds the integrator options.name asks for. All of `problem` must outlive it. Throws
/// std::invalid_argument on an unknown name (the message lists the known ones), on options that make no
/// sense, and where the method needs what the problem does not have.
std::unique_ptr<Integrator> make_integrator(const Problem& problem, const IntegratorOptions& options);

/// What the method of that name is. Throws std::invalid_argument on an unknown name, as make_integrator()
/// does.
IntegratorProperties integrator_of(const std::string& name);

/// All methods that make_integrator() knows, in the order of the list.
std::vector<IntegratorProperties> integrators();

/// Coefficients of the stability polynomial R(z) of an explicit Runge-Kutta method, lowest power first: a
/// step h of y' = lambda y multiplies y by R(h lambda) [Hairer, Wanner, Solving Ordinary Differential
/// Equations II, IV.2]. Empty for a method that has none, and for an unknown name.
std::vector<double> stability_polynomial(const std::string& integrator);

}  // namespace seacrane
