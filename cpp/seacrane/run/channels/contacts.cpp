#include <algorithm>
#include <limits>

#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/contact.hpp"
#include "seacrane/run/channels/axes.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

const Axis contact{"contact", {}, [](const Model& m) {
                     std::vector<std::string> names;
                     for (const Contact& one : m.loads.of<Contact>()) names.push_back(one.d.name);
                     return names;
                   }};
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

/// put(touch, out) writes the values of a point and returns where the next one's begin.
template <double* (*put)(const Touch& touch, double* out)>
void write_points(const Output& o, double* out) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const Contact& one : o.terms.model().loads.of<Contact>()) {
    for (std::size_t i = 0; i < one.points.size(); ++i) out = put(one.touch(in, i), out);
  }
}

double* put_force(const Touch& touch, double* out) {
  view<3>(out) = touch.force();
  return out + 3;
}
double* put_press(const Touch& touch, double* out) {
  *out = touch.press.total();
  return out + 1;
}
double* put_gap(const Touch& touch, double* out) {
  *out = touch.gap;
  return out + 1;
}
double* put_slip(const Touch& touch, double* out) {
  *out = touch.slides ? touch.slip.norm() : 0.0;
  return out + 1;
}

void write_least_gap(const Output& o, double* out) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
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
       .write = write_points<put_force>},
      {.name = "contact_press",
       .axes = {&contact_point},
       .unit = "N",
       .text = "its part away from the surface",
       .peaks = Peaks::of_states,
       .write = write_points<put_press>},
      {.name = "contact_gap",
       .axes = {&contact_point},
       .unit = "m",
       .text = "distance of the point from the surface; negative: compression",
       .peaks = Peaks::of_states,
       .write = write_points<put_gap>},
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
       .write = write_points<put_slip>},
  };
}

}  // namespace seacrane
