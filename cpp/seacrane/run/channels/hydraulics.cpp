#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/hydraulic_cylinder.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

const Axis hydraulic_cylinder{"hydraulic_cylinder", {}, [](const Model& m) {
                                std::vector<std::string> names;
                                for (const auto& d : m.description.loads.of<HydraulicCylinder>()) {
                                  names.push_back(d.name);
                                }
                                return names;
                              }};
const Axis chamber{"chamber", {"full", "rod"}};
const Axis hydraulic_power{"hydraulic_part",
                           {HydraulicCylinder::kPowers.begin(), HydraulicCylinder::kPowers.end()}};

using Hydraulics = HydraulicCylinder::Motion<double>;

/// put(motion, out) writes the values of a cylinder and returns where the next one's begin.
template <double* (*put)(const Hydraulics& motion, double* out)>
void write_hydraulics(const Output& o, double* out) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const auto& one : o.terms.model().loads.of<HydraulicCylinder>()) {
    out = put(one.motion(in), out);
  }
}

template <double Hydraulics::*member>
double* put_one(const Hydraulics& m, double* out) {
  *out++ = m.*member;
  return out;
}
template <auto member>
double* put_each(const Hydraulics& m, double* out) {
  for (const double value : m.*member) *out++ = value;
  return out;
}

}  // namespace

std::vector<Channel> hydraulic_channels() {
  return {
      {.name = "hydraulic_stroke",
       .axes = {&hydraulic_cylinder},
       .unit = "m",
       .text = "stroke of the hydraulic cylinder",
       .peaks = Peaks::of_states,
       .write = write_hydraulics<put_one<&Hydraulics::stroke>>},
      {.name = "hydraulic_force",
       .axes = {&hydraulic_cylinder},
       .unit = "N",
       .text = "its push, friction and ends of the stroke included; negative: it pulls",
       .peaks = Peaks::of_states,
       .write = write_hydraulics<put_one<&Hydraulics::force>>},
      {.name = "hydraulic_pressure",
       .axes = {&hydraulic_cylinder, &chamber},
       .unit = "Pa",
       .text = "absolute pressure of its full side and of its rod side",
       .peaks = Peaks::of_states,
       .write = write_hydraulics<put_each<&Hydraulics::pressure>>},
      {.name = "hydraulic_void",
       .axes = {&hydraulic_cylinder, &chamber},
       .unit = "m3",
       .text = "volume that has boiled in its full side and its rod side, at the oil's vapour pressure",
       .by_default = false,
       .write = write_hydraulics<put_each<&Hydraulics::voids>>},
      {.name = "hydraulic_spool",
       .axes = {&hydraulic_cylinder},
       .unit = "1",
       .text = "position of its spool; 1: pump to the full side, wide open",
       .write = write_hydraulics<put_one<&Hydraulics::spool>>},
      {.name = "hydraulic_flow",
       .axes = {&hydraulic_cylinder, &chamber},
       .unit = "m3/s",
       .text = "into a side through its port",
       .write = write_hydraulics<put_each<&Hydraulics::port>>},
      {.name = "hydraulic_pump_flow",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that the pump gives it",
       .write = write_hydraulics<put_one<&Hydraulics::pumped>>},
      {.name = "hydraulic_tank_flow",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that returns to the tank, leakage included",
       .write = write_hydraulics<put_one<&Hydraulics::returned>>},
      {.name = "hydraulic_spill",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that leaves through a burst hose",
       .write = write_hydraulics<put_one<&Hydraulics::spilled>>},
      {.name = "hydraulic_accumulator_flow",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that its accumulator gives it",
       .by_default = false,
       .write = write_hydraulics<put_one<&Hydraulics::from_gas>>},
      {.name = "hydraulic_power",
       .axes = {&hydraulic_cylinder, &hydraulic_power},
       .unit = "W",
       .text = "that the pump gives, against the tank's pressure, and what each part takes, negative",
       .by_default = false,
       .write = write_hydraulics<put_each<&Hydraulics::power>>},
  };
}

}  // namespace seacrane
