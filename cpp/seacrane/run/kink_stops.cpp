#include "seacrane/run/kink_stops.hpp"

#include <algorithm>
#include <limits>

namespace seacrane {

double KinkStops::next(const std::vector<Kink>& kinks, const Integrator& integrator, double now) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  while (next_ < kinks.size() && kinks[next_].time <= now) ++next_;
  if (next_ == kinks.size()) return kNone;
  const double h = integrator.step_in_use(), lost = integrator.steps_lost_by_reset();
  const auto from = kinks.begin() + static_cast<std::ptrdiff_t>(next_);
  const auto stop = std::find_if(from, kinks.end(), [&](const Kink& k) {
    return k.time - now > 2.0 * h || k.matters(h, scaled_tolerance_, lost);
  });
  return stop != kinks.end() && stop->time - now <= 2.0 * h ? stop->time : kNone;
}

}  // namespace seacrane
