#include <algorithm>

#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/elements/loads/immersed_part.hpp"
#include "seacrane/elements/loads/immersed_span.hpp"
#include "seacrane/run/channels/channel.hpp"
#include "seacrane/run/channels/of_loads.hpp"

namespace seacrane {
namespace {

const Axis part{"part", {}, names_of<ImmersedPart>};
const Axis wet{"wet", {}, [](const Model& m) {
                 std::vector<std::string> names = names_of<ImmersedPart>(m);
                 for (std::string& name : names_of<ImmersedSpan>(m)) names.push_back(std::move(name));
                 return names;
               }};
const Axis cause{"cause", {"buoyancy", "waves", "added mass", "drag", "slam"}};  // WaterCause

/// Calls f(what the water does to a part by cause) for each.
template <class F>
void for_each_part(const Output& o, F&& f) {
  const LoadInput<double> in = input_of(o);
  for (const ImmersedPart& one : o.terms.model().loads.of<ImmersedPart>()) {
    f(one.by_cause(in, o.accelerations[idx(one.body)]));
  }
}

void write_immersed_force(const Output& o, double* out) {
  for_each_part(o, [&](const WaterByCause& water) {
    for (const Vec3d& force : water.forces) {
      view<3>(out) = force;
      out += 3;
    }
  });
}

/// A vector of each part.
template <Vec3d WaterByCause::*vector>
void write_vectors(const Output& o, double* out) {
  for_each_part(o, [&](const WaterByCause& water) {
    view<3>(out) = water.*vector;
    out += 3;
  });
}

void write_water_power(const Output& o, double* out) {
  const auto write = [&](const WaterByCause& water) {
    out = std::copy(water.powers.begin(), water.powers.end(), out);
  };
  for_each_part(o, write);
  const LoadInput<double> in = input_of(o);
  for (const ImmersedSpan& one : o.terms.model().loads.of<ImmersedSpan>()) write(one.by_cause(in));
}

}  // namespace

std::vector<Channel> water_channels() {
  return {
      {.name = "immersed_force",
       .axes = {&part, &cause, &axes::xyz},
       .unit = "N",
       .text = "force of the water on the part by cause, that of its added mass included; inertial frame",
       .needs = {.accelerations = true},
       .by_default = false,
       .write = write_immersed_force},
      {.name = "immersed_momentum",
       .axes = {&part, &axes::xyz},
       .unit = "N s",
       .text = "momentum of the water that goes along with the part, inertial frame",
       .needs = {.accelerations = true},
       .by_default = false,
       .write = write_vectors<&WaterByCause::momentum>},
      {.name = "immersed_shed",
       .axes = {&part, &axes::xyz},
       .unit = "N",
       .text = "momentum that stays behind in the water each second as the part leaves it, inertial frame",
       .needs = {.accelerations = true},
       .by_default = false,
       .write = write_vectors<&WaterByCause::shed>},
      {.name = "water_power",
       .axes = {&wet, &cause},
       .unit = "W",
       .text = "power by cause of the water on a part or a span of a line into the energy of energy_balance",
       .needs = {.accelerations = true},
       .by_default = false,
       .write = write_water_power},
  };
}

}  // namespace seacrane
