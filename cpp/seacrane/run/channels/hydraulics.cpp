#include "seacrane/elements/loads/hydraulic_cylinder.hpp"
#include "seacrane/run/channels/of_loads.hpp"

namespace seacrane {
namespace {

const Axis hydraulic_cylinder{"hydraulic_cylinder", {}, names_of<HydraulicCylinder>};
const Axis chamber{"chamber", {"full", "rod"}};
const Axis hydraulic_power{"hydraulic_part",
                           {HydraulicCylinder::kPowers.begin(), HydraulicCylinder::kPowers.end()}};

using Hydraulics = HydraulicCylinder::Motion<double>;

template <auto read>
constexpr auto write_hydraulics = write_motions<HydraulicCylinder, read>;

}  // namespace

std::vector<Channel> hydraulic_channels() {
  return {
      {.name = "hydraulic_stroke",
       .axes = {&hydraulic_cylinder},
       .unit = "m",
       .text = "stroke of the hydraulic cylinder",
       .peaks = Peaks::of_states,
       .write = write_hydraulics<&Hydraulics::stroke>},
      {.name = "hydraulic_force",
       .axes = {&hydraulic_cylinder},
       .unit = "N",
       .text = "its push, friction and ends of the stroke included; negative: it pulls",
       .peaks = Peaks::of_states,
       .write = write_hydraulics<&Hydraulics::force>},
      {.name = "hydraulic_pressure",
       .axes = {&hydraulic_cylinder, &chamber},
       .unit = "Pa",
       .text = "absolute pressure of its full side and of its rod side",
       .peaks = Peaks::of_states,
       .write = write_hydraulics<&Hydraulics::pressure>},
      {.name = "hydraulic_void",
       .axes = {&hydraulic_cylinder, &chamber},
       .unit = "m3",
       .text = "volume that has boiled in its full side and its rod side, at the oil's vapour pressure",
       .by_default = false,
       .write = write_hydraulics<&Hydraulics::voids>},
      {.name = "hydraulic_spool",
       .axes = {&hydraulic_cylinder},
       .unit = "1",
       .text = "position of its spool; 1: pump to the full side, wide open",
       .write = write_hydraulics<&Hydraulics::spool>},
      {.name = "hydraulic_flow",
       .axes = {&hydraulic_cylinder, &chamber},
       .unit = "m3/s",
       .text = "into a side through its port",
       .write = write_hydraulics<&Hydraulics::port>},
      {.name = "hydraulic_pump_flow",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that the pump gives it",
       .write = write_hydraulics<&Hydraulics::pumped>},
      {.name = "hydraulic_tank_flow",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that returns to the tank, leakage included",
       .write = write_hydraulics<&Hydraulics::returned>},
      {.name = "hydraulic_spill",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that leaves through a burst hose",
       .write = write_hydraulics<&Hydraulics::spilled>},
      {.name = "hydraulic_accumulator_flow",
       .axes = {&hydraulic_cylinder},
       .unit = "m3/s",
       .text = "that its accumulator gives it",
       .by_default = false,
       .write = write_hydraulics<&Hydraulics::from_gas>},
      {.name = "hydraulic_power",
       .axes = {&hydraulic_cylinder, &hydraulic_power},
       .unit = "W",
       .text = "that the pump gives, against the tank's pressure, and what each part takes, negative",
       .by_default = false,
       .write = write_hydraulics<&Hydraulics::power>},
  };
}

}  // namespace seacrane
