#include "seacrane/integrate/difference_jacobian.hpp"

#include <cmath>
#include <limits>

namespace seacrane {

double difference_increment(double y, double step_change, double typical) {
  const double scale = std::max({std::abs(y), std::abs(step_change), typical});
  const double increment = std::sqrt(std::numeric_limits<double>::epsilon()) * scale;
  const double moved = y + (step_change < 0.0 ? -increment : increment);
  return moved - y;
}

bool exact_jacobian(System& system, double t, const double* y, double* out, Counters& counters) {
  if (!system.jacobian(t, y, out)) return false;
  ++counters.evaluations;
  return all_finite(out, system.size() * system.size());
}

}  // namespace seacrane
