#include "seacrane/run/switches.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {
namespace {

constexpr double kAtEnd = 1e-6;  // of a step: a crossing that near to its ends is at them

const std::vector<SoftStop>& stops_of(const Model& model) {
  return std::get<std::vector<SoftStop>>(*model.loads);
}

const std::vector<SpringDamper>& springs_of(const Model& model) {
  return std::get<std::vector<SpringDamper>>(*model.loads);
}

/// How far the bound of a side (1: minimum, -1: maximum) is passed; negative also where the stop would pull.
double pressed(const SoftStop& stop, const LoadInput<double>& in, int side) {
  const auto &ka = in.bodies[stop.coordinate.joint.first], &kb = in.bodies[stop.coordinate.joint.second];
  const CoordinateRow<double> row = evaluate_coordinate<double>(stop.coordinate, ka, kb);
  const double depth = side * ((side > 0 ? stop.minimum : stop.maximum) - row.value);
  return std::min(depth, 1.0 - side * stop.damping * coordinate_rate<double>(row, ka, kb));
}

double length_of(const SpringDamper& spring, const LoadInput<double>& in) {
  const auto &ka = in.bodies[spring.first], &kb = in.bodies[spring.second];
  return (kb.position + kb.rotation * spring.second_point - ka.position - ka.rotation * spring.first_point)
      .norm();
}

}  // namespace

bool Switches::any(const Model& model) {
  const auto& springs = springs_of(model);
  return !stops_of(model).empty() || std::any_of(springs.begin(), springs.end(),
                                                 [](const SpringDamper& s) { return !s.lengths.empty(); });
}

void Switches::read(Stepper& at, double t, const double* y) {
  bodies_.resize(at.system.size());
  at.write_bodies(t, y, bodies_.data());
  at.system.terms().read(t, bodies_.data());
}

void Switches::find_sides(Stepper& at, double t, const double* y, std::vector<int>& sides) {
  read(at, t, y);
  const LoadInput<double> in = at.system.terms().load_input(t);
  sides.clear();
  for (const SoftStop& stop : stops_of(*at.model)) {
    sides.push_back(pressed(stop, in, 1) > 0.0 ? 1 : (pressed(stop, in, -1) > 0.0 ? -1 : 0));
  }
  for (const SpringDamper& spring : springs_of(*at.model)) {
    if (spring.lengths.empty()) continue;
    const auto next = std::upper_bound(spring.lengths.begin(), spring.lengths.end(), length_of(spring, in));
    sides.push_back(static_cast<int>(next - spring.lengths.begin()));
  }
}

double Switches::across(Stepper& at, std::size_t load, int from, int to) const {
  const LoadInput<double> in = at.system.terms().load_input(0.0);
  const auto& stops = stops_of(*at.model);
  if (load < stops.size()) return pressed(stops[load], in, from != 0 ? from : to);
  std::size_t left = load - stops.size();
  for (const SpringDamper& spring : springs_of(*at.model)) {
    if (spring.lengths.empty()) continue;
    if (left-- == 0) return length_of(spring, in) - spring.lengths[idx(to > from ? from : from - 1)];
  }
  return 1.0;
}

void Switches::watch(Stepper& at, double t, const double* y) { find_sides(at, t, y, before_); }

std::optional<double> Switches::find(Stepper& at) {
  Integrator& integrator = *at.integrator;
  find_sides(at, integrator.time(), integrator.state(), after_);
  const double start = integrator.previous_time(), end = integrator.time(),
               margin = std::max(kAtEnd * (end - start), 100.0 * smallest_step(end));
  std::optional<double> first;
  for (std::size_t i = 0; i < after_.size(); ++i) {
    if (after_[i] == before_[i]) continue;
    const std::optional<double> found = integrator.locate([&](double t, const double* y) {
      read(at, t, y);
      return across(at, i, before_[i], after_[i]);
    });
    if (!found || *found - start <= margin || end - *found <= margin) continue;
    if (!first || *found < *first) first = found;
  }
  if (!first) before_.swap(after_);
  return first;
}

}  // namespace seacrane
