#include "seacrane/dynamics/time_parts.hpp"

#include <chrono>

namespace seacrane {

std::vector<std::pair<std::string, double>> time_parts(MaximalSystem& system, double t, const double* y,
                                                       long count) {
  Terms& terms = system.terms();
  const int memory = terms.model().layout.memory;
  std::vector<double> rate(system.size());
  std::vector<std::pair<std::string, double>> out;
  const auto measure = [&](const char* name, auto&& part) {
    const auto start = std::chrono::steady_clock::now();
    for (long i = 0; i < count; ++i) part(t + 1e-3 * static_cast<double>(i));
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
    out.emplace_back(name, elapsed.count() / static_cast<double>(count));
  };
  system.derivative(t, y, rate.data());
  measure("kinematics", [&](double) { terms.read(t, y); });
  measure("inertia", [&](double) { terms.evaluate_inertia(); });
  measure("constraint rows", [&](double) { terms.evaluate_rows(t); });
  measure("loads, waves, memory",
          [&](double time) { terms.evaluate_wrenches(time, y + memory, rate.data() + memory); });
  if (!terms.histories().empty()) {
    VesselHistories copies = terms.histories();
    measure("sample of a convolution, per its step", [&](double) {
      for (auto& h : copies) h.memory.sample(terms.frames()[h.vessel].twist);
    });
  }
  measure("assembly and factorisation", [&](double) { system.solver().factor(); });
  measure("solution", [&](double) { system.solve_acceleration(); });
  measure("rates", [&](double) { system.write_rates(y, rate.data()); });
  measure("whole evaluation", [&](double time) { system.derivative(time, y, rate.data()); });
  return out;
}

}  // namespace seacrane
