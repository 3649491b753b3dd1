#include "seacrane/dynamics/non_finite.hpp"

#include <cmath>

#include "seacrane/dynamics/state_names.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/integrate/error_norm.hpp"

namespace seacrane {
namespace {

std::string in_quotes(const std::string& name) { return "'" + name + "'"; }

std::string vector_text(const Vec3d& v) {
  std::string out = "(";
  out.append(to_text(v[0])).append(", ").append(to_text(v[1])).append(", ");
  return out.append(to_text(v[2])).append(")");
}

/// "force ... N, moment ... N m on body ..." of the first wrench that is not finite; empty: all are.
std::string bad_wrench(const Model& m, const std::vector<BodyLoad<double>>& wrench) {
  for (int b = 0; b < m.body_count(); ++b) {
    const BodyLoad<double>& w = wrench[idx(b)];
    if (w.force.allFinite() && w.moment.allFinite()) continue;
    return "force " + vector_text(w.force) + " N and moment " + vector_text(w.moment) + " N m on body " +
           in_quotes(m.bodies[idx(b)].name);
  }
  return "";
}

std::string bad_rows(const Terms& terms) {
  for (std::size_t e = 0; e < terms.blocks().size(); ++e) {
    const ElementModel& element = terms.model().elements[e];
    const RowBlock<double>& b = terms.blocks()[e];
    for (int r = 0; r < element.rows; ++r) {
      if (std::isfinite(b.phi[r]) && std::isfinite(b.gamma[r]) && std::isfinite(b.nu[r])) continue;
      return std::string(element.driver ? "driver " : "joint ") + in_quotes(element.name) + ": open by " +
             to_text(b.phi[r]) + " m or rad, wants a rate of " + to_text(b.nu[r]);
    }
  }
  return "";
}

}  // namespace

std::string non_finite_load(Terms& terms, double t, const double* y) {
  const Model& m = terms.model();
  const LoadInput<double> input = terms.load_input(t, y + m.layout.memory);
  std::vector<double> memory_rate(idx(m.layout.work - m.layout.memory));
  double* const state_rates = memory_rate.data() + (m.layout.loads - m.layout.memory);
  std::vector<BodyLoad<double>>& wrench = terms.wrench_;
  std::string found;
  const auto check = [&](const std::string& name, auto&& apply) {
    if (!found.empty()) return;
    for (auto& w : wrench) w = BodyLoad<double>();
    LoadSum<double> sum{wrench.data(), state_rates};
    apply(sum);
    const std::string bad = bad_wrench(m, wrench);
    if (!bad.empty()) {
      found = name + ": " + bad;
    } else if (!std::isfinite(sum.power)) {
      found = name + ": its power is " + to_text(sum.power) + " W";
    }
  };
  for (const auto& load : m.gravity) check("gravity", [&](auto& sum) { load.apply<double>(input, sum); });
  m.loads.for_each([&](const LoadList& list, std::size_t i) {
    check(std::string(list.kind.name) + " " + in_quotes(list.names[i]),
          [&](auto& sum) { list.apply(i, input, sum); });
  });
  check("hydrodynamics",
        [&](auto& sum) { terms.apply_hydrodynamics(input, y + m.layout.memory, memory_rate.data(), sum); });
  const std::size_t bad = first_non_finite(memory_rate.data(), memory_rate.size());
  if (found.empty() && bad < memory_rate.size()) {
    found = "rate of " + describe_memory(m, static_cast<int>(bad)) + ": it is " + to_text(memory_rate[bad]);
  }
  check("waves", [&](auto& sum) { terms.apply_waves(t, y + m.layout.memory, sum); });
  return found;
}

std::string name_non_finite(MaximalSystem& system, double t, const double* y) {
  const std::size_t size = system.size(), bad = first_non_finite(y, size);
  if (bad < size) return system.describe(bad) + ": it is " + to_text(y[bad]);
  Terms& terms = system.terms();
  terms.read(t, y);
  terms.evaluate_inertia(t, y + terms.model().layout.memory);
  terms.evaluate_rows(t);
  std::string found = non_finite_load(terms, t, y);
  if (found.empty()) found = bad_rows(terms);
  if (!found.empty()) return found;
  std::vector<double> rate(size);
  system.derivative(t, y, rate.data());
  const std::size_t rate_bad = first_non_finite(rate.data(), size);
  return rate_bad < size ? "rate of the " + system.describe(rate_bad) + ": it is " + to_text(rate[rate_bad])
                         : "";
}

}  // namespace seacrane
