#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/gas_spring.hpp"
#include "seacrane/elements/loads/heave_compensator.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

/// Names of the described loads of a kind.
template <class Load>
std::vector<std::string> names_of_kind(const Model& m) {
  std::vector<std::string> names;
  for (const auto& d : m.description.loads.of<Load>()) {
    names.push_back(d.name);
  }
  return names;
}

const Axis heave_compensator{"heave_compensator", {}, names_of_kind<HeaveCompensator>};
const Axis gas_spring{"gas_spring", {}, names_of_kind<GasSpring>};

using Heave = HeaveSignal::Motion<double>;
double stroke_of(const Heave& m) { return m.stroke; }
double stroke_rate_of(const Heave& m) { return m.rate(); }
double reference_of(const Heave& m) { return m.reference; }

template <double (*read)(const Heave& motion)>
void write_compensators(const Output& o, double* out) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const auto& one : o.terms.model().loads.of<HeaveCompensator>()) {
    *out++ = read(one.signal.motion(in));
  }
}

using Gas = GasSpring::Motion<double>;
double gas_tension_of(const Gas& m) { return m.tension(); }
double gas_length_of(const Gas& m) { return m.length; }
double gas_pressure_of(const Gas& m) { return m.pressure; }

template <double (*read)(const Gas& motion)>
void write_gas_springs(const Output& o, double* out) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const auto& one : o.terms.model().loads.of<GasSpring>()) {
    *out++ = read(one.motion(in));
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
       .write = write_compensators<stroke_of>},
      {.name = "heave_stroke_rate",
       .axes = {&heave_compensator},
       .unit = "m/s",
       .text = "its rate",
       .peaks = Peaks::of_states,
       .write = write_compensators<stroke_rate_of>},
      {.name = "heave_reference",
       .axes = {&heave_compensator},
       .unit = "m",
       .text = "the stroke that its filter, lag and drive ask for, without bounds",
       .write = write_compensators<reference_of>},
      {.name = "gas_spring_tension",
       .axes = {&gas_spring},
       .unit = "N",
       .text = "tension of the gas spring, oil and end stops included; negative: it pushes",
       .peaks = Peaks::of_states,
       .write = write_gas_springs<gas_tension_of>},
      {.name = "gas_spring_length",
       .axes = {&gas_spring},
       .unit = "m",
       .text = "distance of its points",
       .peaks = Peaks::of_states,
       .write = write_gas_springs<gas_length_of>},
      {.name = "gas_spring_pressure",
       .axes = {&gas_spring},
       .unit = "Pa",
       .text = "pressure of its gas",
       .peaks = Peaks::of_states,
       .write = write_gas_springs<gas_pressure_of>},
  };
}

}  // namespace seacrane
