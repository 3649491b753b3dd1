#include <chrono>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

std::vector<std::pair<std::string, double>> RedundantSystem::time_parts(double t, const double* y,
                                                                        long count) {
  std::vector<double> rate(size());
  std::vector<std::pair<std::string, double>> out;
  const auto measure = [&](const char* name, auto&& part) {
    const auto start = std::chrono::steady_clock::now();
    for (long i = 0; i < count; ++i) part(t + 1e-3 * static_cast<double>(i));
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
    out.emplace_back(name, elapsed.count() / static_cast<double>(count));
  };
  derivative(t, y, rate.data());
  measure("kinematics", [&](double) { read_state(t, y); });
  measure("inertia", [&](double) { evaluate_inertia(); });
  measure("constraint rows", [&](double) { evaluate_rows(t); });
  measure("loads, waves, memory", [&](double time) { evaluate_loads(time, y, rate.data()); });
  if (!convolutions_.empty()) {
    auto copies = convolutions_;
    measure("sample of a convolution, per its step", [&](double) {
      for (auto& [v, memory] : copies) memory.sample(frames_[v].twist);
    });
  }
  measure("assembly and factorisation", [&](double) { factor(); });
  measure("solution", [&](double) { solve_acceleration(); });
  measure("rates", [&](double) { write_rates(y, rate.data()); });
  measure("whole evaluation", [&](double time) { derivative(time, y, rate.data()); });
  return out;
}

}  // namespace seacrane
