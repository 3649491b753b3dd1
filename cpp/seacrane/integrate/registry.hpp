#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/integrate/integrator.hpp"
#include "seacrane/integrate/system.hpp"

namespace seacrane {

/// Builds the integrator options.name asks for. `system` and `residual` must outlive it; `residual` may be
/// null for all methods but those that integrate the implicit form. Throws std::invalid_argument on an
/// unknown name (the message lists the known ones) and on options that make no sense.
std::unique_ptr<Integrator> make_integrator(System& system, ResidualSystem* residual,
                                            const IntegratorOptions& options);

/// Names make_integrator() knows, in the order of the list.
std::vector<std::string> integrator_names();

}  // namespace seacrane
