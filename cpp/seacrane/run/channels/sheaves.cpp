#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/line.hpp"
#include "seacrane/run/channels/channel.hpp"

namespace seacrane {
namespace {

const std::vector<Line>& lines_of(const Model& m) { return m.loads.of<Line>(); }

/// "hoist 2" for point 2 of the line, at the end of section 2.
std::string label(const Line& one, std::size_t i) { return one.d.name + " " + std::to_string(i); }

const Axis section{"section", {}, [](const Model& m) {
                     std::vector<std::string> names;
                     for (const Line& one : lines_of(m)) {
                       if (!one.has_sheaves && !one.has_friction) continue;
                       for (std::size_t i = 1; i < one.path.points().size(); ++i) {
                         names.push_back(label(one, i));
                       }
                     }
                     return names;
                   }};

const Axis sheave{"sheave", {}, [](const Model& m) {
                    std::vector<std::string> names;
                    for (const Line& one : lines_of(m)) {
                      for (std::size_t i = 1; i < one.path.points().size(); ++i) {
                        if (one.path.points()[i].turns_line()) names.push_back(label(one, i));
                      }
                    }
                    return names;
                  }};

/// Calls f(line, motion, section, tension, friction, point) for each section of each line.
template <class F>
void for_each_tension(const Output& o, F&& f) {
  const LoadInput<double> in = o.terms.load_input(o.time, o.state + o.terms.model().layout.memory);
  for (const Line& one : lines_of(o.terms.model())) {
    one.for_each_tension<double>(
        in, one.motion(in),
        [&](const PathSection<double>& s, double tension, const SheaveFriction<double>& friction,
            std::size_t i) { f(one, s, tension, friction, i); });
  }
}

void write_section_tension(const Output& o, double* out) {
  for_each_tension(o, [&](const Line& one, const PathSection<double>&, double tension,
                          const SheaveFriction<double>&, std::size_t) {
    if (one.has_sheaves || one.has_friction) *out++ = tension;
  });
}

void write_sheave_power(const Output& o, double* out) {
  for_each_tension(o, [&](const Line& one, const PathSection<double>&, double tension,
                          const SheaveFriction<double>& friction, std::size_t i) {
    if (!one.path.points()[i].turns_line()) return;
    *out++ = one.has_friction ? tension * friction.last_power() : 0.0;
  });
}

/// What `read` takes of the section before each sheave.
template <double (*read)(const PathSection<double>& section)>
void write_sheaves(const Output& o, double* out) {
  for_each_tension(o, [&](const Line& one, const PathSection<double>& s, double,
                          const SheaveFriction<double>&, std::size_t i) {
    if (one.path.points()[i].turns_line()) *out++ = read(s);
  });
}

double wrap_of(const PathSection<double>& s) { return s.wrap; }
double fleet_of(const PathSection<double>& s) { return s.fleet; }

}  // namespace

std::vector<Channel> sheave_channels() {
  return {
      {.name = "section_tension",
       .axes = {&section},
       .unit = "N",
       .text = "tension of each section of lines over sheaves or with friction",
       .needs = {.solution = true},
       .write = write_section_tension},
      {.name = "sheave_wrap",
       .axes = {&sheave},
       .unit = "rad",
       .text = "angle by which a line lies on its sheave; 0 at points with friction",
       .write = write_sheaves<wrap_of>},
      {.name = "sheave_fleet_angle",
       .axes = {&sheave},
       .unit = "rad",
       .text = "larger angle of both spans at a sheave with the plane of its rim",
       .write = write_sheaves<fleet_of>},
      {.name = "sheave_friction_power",
       .axes = {&sheave},
       .unit = "W",
       .text = "power of the friction on a sheave, never positive",
       .write = write_sheave_power},
  };
}

}  // namespace seacrane
