#include "seacrane/integrate/integration_error.hpp"

#include <sstream>
#include <utility>

namespace seacrane {
namespace {

std::string describe(const std::string& method, double time, double step_size, std::size_t component,
                     const std::string& reason) {
  std::ostringstream text;
  text.precision(17);
  text << method << " stopped at t = " << time << " s: " << reason << " (step size " << step_size << " s";
  if (component != IntegrationError::no_component) text << ", state component " << component;
  text << ")";
  return text.str();
}

}  // namespace

IntegrationError::IntegrationError(std::string method, double time, double step_size, std::size_t component,
                                   std::string reason)
    : std::runtime_error(describe(method, time, step_size, component, reason)),
      method_(std::move(method)),
      time_(time),
      step_size_(step_size),
      component_(component),
      reason_(std::move(reason)) {}

}  // namespace seacrane
