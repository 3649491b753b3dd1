#include "seacrane/dynamics/energy.hpp"

namespace seacrane {

double kinetic_energy(const Terms& terms, const double* y) {
  double sum = 0.0;
  for (int b = 0; b < terms.model().body_count(); ++b) {
    const auto v = view<6>(y + terms.model().layout.twist(b));
    sum += 0.5 * v.dot(terms.mass_matrix(b) * v);
  }
  for (const MassCoupling& c : terms.couplings()) {
    const StateLayout& s = terms.model().layout;
    sum += view<6>(y + s.twist(c.first)).dot(c.mass * view<6>(y + s.twist(c.second)));
  }
  return sum;
}

double mechanical_energy(const Terms& terms, double t, const double* y) {
  const Model& m = terms.model();
  const LoadInput<double> input = terms.load_input(t, y + m.layout.memory);
  double sum = kinetic_energy(terms, y);
  for (const auto& load : m.gravity) sum += load.potential(input);
  for (const auto& list : m.loads.lists) list->add_potential(input, sum);
  for (const auto& vessel : m.vessels) sum += vessel.potential(terms.bodies()[idx(vessel.body)]);
  return sum;
}

double mechanical_energy_at(Terms& terms, double t, const double* y) {
  terms.read(t, y);
  terms.evaluate_inertia(t, y + terms.model().layout.memory);
  return mechanical_energy(terms, t, y);
}

}  // namespace seacrane
