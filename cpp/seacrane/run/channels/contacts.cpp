#include <algorithm>
#include <limits>

#include "seacrane/elements/loads/contact.hpp"
#include "seacrane/run/channels/channel.hpp"
#include "seacrane/run/channels/of_loads.hpp"

namespace seacrane {
namespace {

const Axis contact{"contact", {}, names_of<Contact>};
const Axis contact_point{"contact_point", {}, [](const Model& m) {
                           std::vector<std::string> names;
                           for (const Contact& one : m.loads.of<Contact>()) {
                             for (std::size_t i = 0; i < one.points.size(); ++i) {
                               names.push_back(one.point_name(i));
                             }
                           }
                           return names;
                         }};

using Touch = Contact::Touch<double>;

/// Writes what `read` has of each point.
template <auto read>
void write_points(const Output& o, double* out) {
  const LoadInput<double> in = input_of(o);
  for (const Contact& one : o.terms.model().loads.of<Contact>()) {
    for (std::size_t i = 0; i < one.points.size(); ++i) out = put(std::invoke(read, one.touch(in, i)), out);
  }
}

double press_of(const Touch& touch) { return touch.press.total(); }
double slip_of(const Touch& touch) { return touch.slides ? touch.slip.norm() : 0.0; }

void write_least_gap(const Output& o, double* out) {
  const LoadInput<double> in = input_of(o);
  for (const Contact& one : o.terms.model().loads.of<Contact>()) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < one.points.size(); ++i) least = std::min(least, one.touch(in, i).gap);
    *out++ = least;
  }
}

}  // namespace

std::vector<Channel> contact_channels() {
  return {
      {.name = "contact_force",
       .axes = {&contact_point, &axes::xyz},
       .unit = "N",
       .text = "of the surface on the point, inertial frame",
       .peaks = Peaks::of_states,
       .write = write_points<&Touch::force>},
      {.name = "contact_press",
       .axes = {&contact_point},
       .unit = "N",
       .text = "its part away from the surface",
       .peaks = Peaks::of_states,
       .write = write_points<press_of>},
      {.name = "contact_gap",
       .axes = {&contact_point},
       .unit = "m",
       .text = "distance of the point from the surface; negative: compression",
       .peaks = Peaks::of_states,
       .write = write_points<&Touch::gap>},
      {.name = "contact_least_gap",
       .axes = {&contact},
       .unit = "m",
       .text = "least distance of the contact's points",
       .peaks = Peaks::of_states,
       .write = write_least_gap},
      {.name = "contact_slip",
       .axes = {&contact_point},
       .unit = "m/s",
       .text = "speed of the point over the surface while it presses and slides; 0 while it sticks",
       .peaks = Peaks::of_states,
       .write = write_points<slip_of>},
  };
}

}  // namespace seacrane
