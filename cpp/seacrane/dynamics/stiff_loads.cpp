#include "seacrane/dynamics/stiff_loads.hpp"

#include <algorithm>

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {
StiffLoads::StiffLoads(Formulation& system)
    : system_(system),
      rate_(system.size()),
      power_(system.size()),
      response_(system.size()),
      unit_(idx(system.terms().model().body_count()) + 1, Vec6d::Zero()) {
  system.terms().model().loads.for_each([&](const LoadList& list, std::size_t i) {
    if (const int count = list.stiff_states(i).count) rank_ += 1 + idx(count);
  });
}

void StiffLoads::linearise(double t, const double* y, double* in, double* out) {
  const Terms& terms = system_.terms();
  const StateLayout& layout = terms.model().layout;
  const std::size_t n = system_.size(), first_state = n - 2 - terms.model().load_states.size();
  std::fill_n(in, rank_ * n, 0.0);
  std::fill_n(out, rank_ * n, 0.0);
  system_.derivative(t, y, rate_.data());
  const LoadInput<double> input = terms.load_input(t, y + n - 2 - idx(layout.work - layout.memory));
  terms.model().loads.for_each([&](const LoadList& list, std::size_t place) {
    const StateRange states = list.stiff_states(place);
    if (states.count == 0) return;
    std::fill(unit_.begin(), unit_.end(), Vec6d::Zero());
    list.add_unit(place, 0, input, unit_.data());
    unit_.back() = Vec6d::Zero();
    system_.load_direction(unit_, power_.data(), response_.data());
    const StiffSlopes slopes = list.stiff_slopes(place, input);
    const std::size_t own = first_state + idx(states.first);
    for (int j = 0; j <= states.count; ++j, in += n, out += n) {
      if (j == 0) {
        std::copy(power_.begin(), power_.end(), in);
      } else {
        in[own + idx(j - 1)] = 1.0;
      }
      for (std::size_t i = 0; i < n; ++i) out[i] = slopes(0, j) * response_[i];
      for (int i = 1; i <= states.count; ++i) out[own + idx(i - 1)] = slopes(i, j);
    }
  });
}

}  // namespace seacrane
