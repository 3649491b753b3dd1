#include <algorithm>

#include "seacrane/elements/loads/line.hpp"
#include "seacrane/run/channels/of_loads.hpp"

namespace seacrane {
namespace {

const Axis state_name{"state_name", {}, [](const Model& m) { return names_of_all(m.load_states); }};
const Axis line{"line", {}, names_of<Line>};

bool has_drum(const Line::Description& d) { return d.winch && d.drum_inertia > 0.0; }

const Axis drum{"drum", {}, [](const Model& m) {
                  std::vector<std::string> names;
                  for (const auto& d : m.description.loads.of<Line>()) {
                    if (has_drum(d)) names.push_back(d.winch_name());
                  }
                  return names;
                }};

void write_load_state(const Output& o, double* out) {
  const StateLayout& layout = o.terms.model().layout;
  std::copy(o.state + layout.loads, o.state + layout.work, out);
}

/// What `read` takes of the motor and the brake of each drum.
template <double (*read)(const Drum& drum, const Drum::Drive& drive)>
void write_drums(const Output& o, double* out) {
  const LoadInput<double> in = input_of(o);
  for (const Line& one : o.terms.model().loads.of<Line>()) {
    if (one.winch && one.winch->drum) *out++ = read(*one.winch->drum, one.drive(in));
  }
}

double motor_torque_of(const Drum& drum, const Drum::Drive& now) { return now.motor * drum.d.drum_radius; }
double motor_power_of(const Drum& /*drum*/, const Drum::Drive& now) { return now.motor * now.rate; }
double brake_torque_of(const Drum& drum, const Drum::Drive& now) { return now.brake * drum.d.drum_radius; }
double brake_power_of(const Drum& /*drum*/, const Drum::Drive& now) { return now.brake_power; }

using Motion = Line::Motion<double>;
double winch_power_of(const Motion& m) { return m.winch_power() + m.winch_power_per_inertial() * m.inertial; }
template <auto read>
constexpr auto write_lines = write_motions<Line, read>;

}  // namespace

std::vector<Channel> load_channels() {
  return {
      {.name = "load_state",
       .axes = {&state_name},
       .unit = "SI",
       .text = "states that loads have of their own, in the unit of each",
       .write = write_load_state},
      {.name = "line_tension",
       .axes = {&line},
       .unit = "N",
       .text = "tension of the line; with friction on sheaves its mean over the length",
       .needs = {.tensions = true},
       .peaks = Peaks::of_lines,
       .write = write_lines<&Motion::tension>},
      {.name = "line_length",
       .axes = {&line},
       .unit = "m",
       .text = "length of the line's path over its points and sheaves",
       .peaks = Peaks::of_states,
       .write = write_lines<&Motion::length>},
      {.name = "line_unstretched_length",
       .axes = {&line},
       .unit = "m",
       .text = "length of the line without tension",
       .peaks = Peaks::of_states,
       .write = write_lines<&Motion::unstretched>},
      {.name = "line_stretch",
       .axes = {&line},
       .unit = "m",
       .text = "length of the path over that of the line; negative: slack",
       .peaks = Peaks::of_states,
       .write = write_lines<&Motion::stretch>},
      {.name = "line_pay_out_rate",
       .axes = {&line},
       .unit = "m/s",
       .text = "rate of the unstretched length; positive: pays out",
       .peaks = Peaks::of_states,
       .write = write_lines<&Motion::unstretched_rate>},
      {.name = "line_winch_power",
       .axes = {&line},
       .unit = "W",
       .text = "power of the winch, or of what changes the length, into the line",
       .needs = {.tensions = true},
       .write = write_lines<winch_power_of>},
      {.name = "drum_motor_torque",
       .axes = {&drum},
       .unit = "N m",
       .text = "torque of the winch's motor on its drum; positive: pays out",
       .needs = {.tensions = true},
       .write = write_drums<motor_torque_of>},
      {.name = "drum_motor_power",
       .axes = {&drum},
       .unit = "W",
       .text = "power that the winch's motor gives to its drum",
       .needs = {.tensions = true},
       .write = write_drums<motor_power_of>},
      {.name = "drum_brake_torque",
       .axes = {&drum},
       .unit = "N m",
       .text = "torque of the winch's brake, against paying out",
       .needs = {.tensions = true},
       .write = write_drums<brake_torque_of>},
      {.name = "drum_brake_power",
       .axes = {&drum},
       .unit = "W",
       .text = "power of the winch's brake, negative: heat",
       .needs = {.tensions = true},
       .write = write_drums<brake_power_of>},
  };
}

}  // namespace seacrane
