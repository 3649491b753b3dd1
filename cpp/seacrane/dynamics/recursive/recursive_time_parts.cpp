#include "seacrane/dynamics/recursive/recursive.hpp"
#include "seacrane/dynamics/time_parts.hpp"

namespace seacrane {

std::vector<std::pair<std::string, double>> RecursiveSystem::time_parts(double t, const double* y,
                                                                        long count) {
  std::vector<double> rate(size());
  PartTimes out(count);
  const auto later = [&](long i) { return t + 1e-3 * static_cast<double>(i); };
  evaluate(t, y, rate.data(), false);  // keeps the masses
  out.measure("kinematics", [&](long) {
    place(t, y);
    terms_->follow_yaw();
  });
  out.measure("inertia", [&](long) { evaluate_inertia(t, y); });
  out.measure("articulated inertias", [&](long) { articulated_.factor(mass_.data()); });
  out.measure("loads, waves, memory", [&](long i) { evaluate_wrenches(later(i), y, rate.data(), true); });
  out.measure("solution", [&](long) { solve_acceleration(rate.data() + layout_.speeds); });
  out.measure("rates", [&](long) {
    articulated_.kinematics().position_rates(y, y + layout_.speeds, terms_->bodies().data(), rate.data());
  });
  out.measure("whole evaluation", [&](long i) { derivative(later(i), y, rate.data()); });
  return out.values();
}

}  // namespace seacrane
