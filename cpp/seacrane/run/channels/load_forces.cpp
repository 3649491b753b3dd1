#include "seacrane/dynamics/maximal.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

/// Calls f(what the load puts on its last body, that body), one load after the other.
template <class F>
void for_each_load(const Output& o, F&& f) {
  const Model& model = o.system.model();
  const LoadInput<double> input = o.terms.load_input(o.time, o.state + model.layout.memory);
  model.loads.for_each([&](const LoadList& list, std::size_t i) {
    LoadSum<double> sum{o.one_load.data(), o.load_rates};
    list.apply(i, input, sum);
    f(o.one_load[idx(list.bodies[i].back())], list.bodies[i].back());
    for (const int body : list.bodies[i]) o.one_load[idx(body)] = {};
  });
}

void write_load_force(const Output& o, double* out) {
  for_each_load(o, [&](const BodyLoad<double>& load, int) {
    view<3>(out) = load.force;
    out += 3;
  });
}

/// About the origin of the body: that of its description.
void write_load_moment(const Output& o, double* out) {
  const Model& model = o.system.model();
  for_each_load(o, [&](const BodyLoad<double>& load, int body) {
    const bool ground = body == model.body_count();
    const Vec3d lever =
        ground ? Vec3d(Vec3d::Zero())
               : Vec3d(o.terms.bodies()[idx(body)].rotation * model.bodies[idx(body)].state_point);
    view<3>(out) = load.moment + lever.cross(load.force);
    out += 3;
  });
}

}  // namespace

std::vector<Channel> load_force_channels() {
  return {
      {.name = "load_force",
       .axes = {&axes::load, &axes::xyz},
       .unit = "N",
       .text = "force of a described load on the last body that it names, inertial frame",
       .needs = {.tensions = true},
       .by_default = false,
       .write = write_load_force},
      {.name = "load_moment",
       .axes = {&axes::load, &axes::xyz},
       .unit = "N m",
       .text = "its moment about the origin of that body, inertial frame",
       .needs = {.tensions = true},
       .by_default = false,
       .write = write_load_moment},
  };
}

}  // namespace seacrane
