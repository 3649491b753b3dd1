#include "seacrane/elements/loads/gas_spring.hpp"
#include "seacrane/elements/loads/heave_compensator.hpp"
#include "seacrane/run/channels/of_loads.hpp"

namespace seacrane {
namespace {

const Axis heave_compensator{"heave_compensator", {}, names_of<HeaveCompensator>};
const Axis gas_spring{"gas_spring", {}, names_of<GasSpring>};

using Heave = HeaveSignal::Motion<double>;
using Gas = GasSpring::Motion<double>;

template <auto read>
void write_compensators(const Output& o, double* out) {
  const LoadInput<double> in = input_of(o);
  for (const auto& one : o.terms.model().loads.of<HeaveCompensator>()) {
    *out++ = std::invoke(read, one.signal.motion(in));
  }
}

}  // namespace

std::vector<Channel> heave_channels() {
  return {
      {.name = "heave_stroke",
       .axes = {&heave_compensator},
       .unit = "m",
       .text = "stroke of the heave compensator",
       .peaks = Peaks::of_states,
       .write = write_compensators<&Heave::stroke>},
      {.name = "heave_stroke_rate",
       .axes = {&heave_compensator},
       .unit = "m/s",
       .text = "its rate",
       .peaks = Peaks::of_states,
       .write = write_compensators<&Heave::rate>},
      {.name = "heave_reference",
       .axes = {&heave_compensator},
       .unit = "m",
       .text = "the stroke that its filter, lag and drive ask for, without bounds",
       .write = write_compensators<&Heave::reference>},
      {.name = "gas_spring_tension",
       .axes = {&gas_spring},
       .unit = "N",
       .text = "tension of the gas spring, oil and end stops included; negative: it pushes",
       .peaks = Peaks::of_states,
       .write = write_motions<GasSpring, &Gas::tension>},
      {.name = "gas_spring_length",
       .axes = {&gas_spring},
       .unit = "m",
       .text = "distance of its points",
       .peaks = Peaks::of_states,
       .write = write_motions<GasSpring, &Gas::length>},
      {.name = "gas_spring_pressure",
       .axes = {&gas_spring},
       .unit = "Pa",
       .text = "pressure of its gas",
       .peaks = Peaks::of_states,
       .write = write_motions<GasSpring, &Gas::pressure>},
  };
}

}  // namespace seacrane
