#include <cmath>
#include <stdexcept>
#include <string>

#include "seacrane/dynamics/redundant.hpp"
#include "seacrane/elements/check.hpp"
#include "seacrane/elements/loads/registry.hpp"
#include "seacrane/integrate/error_norm.hpp"

/// Names for what is not finite, for the report of a run that had to stop; none of it is in the loop.
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

}  // namespace

std::string RedundantSystem::describe_memory(int state) const {
  for (std::size_t v = 0; v < model_->vessels.size(); ++v) {
    const Vessel& vessel = model_->vessels[v];
    const int own = state - (vessel.memory_offset - model_->layout.memory);
    if (own < 0 || own >= vessel.memory_states()) continue;
    const std::string of = " of vessel " + in_quotes(model_->description.vessels[v].name);
    const int fluid = vessel.fluid_states();
    if (own >= fluid) return "state " + std::to_string(own - fluid) + " of the fast motion" + of;
    return "memory state " + std::to_string(own) + of;
  }
  return "memory state " + std::to_string(state);
}

/// One load at a time, each alone.
std::string RedundantSystem::non_finite_load(double t, const double* y) {
  const Model& m = *model_;
  const LoadInput<double> input = load_input(t);
  std::string found;
  const auto check = [&](const std::string& name, auto&& apply) {
    if (!found.empty()) return;
    for (auto& w : wrench_) w = BodyLoad<double>();
    LoadSum<double> sum{wrench_.data()};
    apply(sum);
    const std::string bad = bad_wrench(m, wrench_);
    if (!bad.empty()) {
      found = name + ": " + bad;
    } else if (!std::isfinite(sum.power)) {
      found = name + ": its power is " + to_text(sum.power) + " W";
    }
  };
  for (const auto& load : m.gravity) check("gravity", [&](auto& sum) { load.apply<double>(input, sum); });
  for_each_load_type([&]<class Load>() {
    const auto& loads = std::get<std::vector<Load>>(*m.loads);
    const auto& described = std::get<std::vector<typename Load::Description>>(*m.description.loads);
    for (std::size_t i = 0; i < loads.size(); ++i) {
      // A load that moves nothing is not compiled, and the others then stand at other places.
      const bool same = loads.size() == described.size();
      check(std::string(Load::kind) + " " + (same ? in_quotes(described[i].name) : "(one of several)"),
            [&](auto& sum) { loads[i].template apply<double>(input, sum); });
    }
  });
  std::vector<double> memory_rate(idx(m.layout.work - m.layout.memory));
  check("hydrodynamics",
        [&](auto& sum) { apply_hydrodynamics(input, y + m.layout.memory, memory_rate.data(), sum); });
  const std::size_t bad = first_non_finite(memory_rate.data(), memory_rate.size());
  if (found.empty() && bad < memory_rate.size()) {
    found = "rate of " + describe_memory(static_cast<int>(bad)) + ": it is " + to_text(memory_rate[bad]);
  }
  check("waves", [&](auto& sum) { apply_waves(t, y + m.layout.memory, sum); });
  return found;
}

std::string RedundantSystem::non_finite_rows() const {
  for (std::size_t e = 0; e < blocks_.size(); ++e) {
    const ElementModel& element = model_->elements[e];
    const RowBlock<double>& b = blocks_[e];
    for (int r = 0; r < element.rows; ++r) {
      if (std::isfinite(b.phi[r]) && std::isfinite(b.gamma[r]) && std::isfinite(b.nu[r])) continue;
      return std::string(element.driver ? "driver " : "joint ") + in_quotes(element.name) + ": open by " +
             to_text(b.phi[r]) + " m or rad, wants a rate of " + to_text(b.nu[r]);
    }
  }
  return "";
}

std::string RedundantSystem::non_finite(double t, const double* y) {
  const std::size_t bad = first_non_finite(y, size());
  if (bad < size()) return describe(bad) + ": it is " + to_text(y[bad]);
  std::vector<double> rate(size());
  read_state(t, y);
  evaluate_inertia();
  evaluate_rows(t);
  std::string found = non_finite_load(t, y);
  if (found.empty()) found = non_finite_rows();
  if (!found.empty()) return found;
  derivative(t, y, rate.data());
  const std::size_t rate_bad = first_non_finite(rate.data(), size());
  return rate_bad < size() ? "rate of the " + describe(rate_bad) + ": it is " + to_text(rate[rate_bad]) : "";
}

}  // namespace seacrane
