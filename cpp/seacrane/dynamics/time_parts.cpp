#include "seacrane/dynamics/time_parts.hpp"

namespace seacrane {

std::vector<std::pair<std::string, double>> time_parts(MaximalSystem& system, double t, const double* y,
                                                       long count) {
  Terms& terms = system.terms();
  const int memory = terms.model().layout.memory;
  std::vector<double> rate(system.size());
  PartTimes out(count);
  const auto later = [&](long i) { return t + 1e-3 * static_cast<double>(i); };
  system.derivative(t, y, rate.data());
  out.measure("kinematics", [&](long) { terms.read(t, y); });
  out.measure("inertia", [&](long) { terms.evaluate_inertia(t, y + memory); });
  out.measure("constraint rows", [&](long) { terms.evaluate_rows(t); });
  out.measure("loads, waves, memory",
              [&](long i) { terms.evaluate_wrenches(later(i), y + memory, rate.data() + memory); });
  if (!terms.histories().empty()) {
    VesselHistories copies = terms.histories();
    out.measure("sample of a convolution, per its step", [&](long) {
      for (auto& h : copies) h.memory.sample(terms.frames()[h.vessel].twist);
    });
  }
  out.measure("assembly and factorisation", [&](long) { system.solver().factor(); });
  out.measure("solution", [&](long) { system.solve_acceleration(); });
  out.measure("rates", [&](long) { system.write_rates(y, rate.data()); });
  out.measure("whole evaluation", [&](long i) { system.derivative(later(i), y, rate.data()); });
  return out.values();
}

}  // namespace seacrane
