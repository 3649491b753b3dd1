#include <algorithm>
#include <string_view>
#include <utility>

#include "seacrane/elements/loads/line.hpp"
#include "seacrane/run/channels/of_loads.hpp"

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

/// The line of which one is a segment, as rung "with mass" names them; else its own name.
std::string_view whole_of(const Line::Description& d) {
  const std::string_view name(d.name);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == name.size()) return name;
  if (!std::ranges::all_of(name.substr(dot + 1), [](char c) { return c >= '0' && c <= '9'; })) return name;
  const std::string_view begin = name.substr(0, dot + 1);
  const bool tied = std::ranges::any_of(d.bodies, [&](const std::string& b) { return b.starts_with(begin); });
  return tied ? name.substr(0, dot) : name;
}

/// Calls f(first, count) for the lines of each whole line.
template <class Descriptions, class F>
void for_each_whole(const Descriptions& lines, F&& f) {
  for (std::size_t i = 0, count = 1; i < lines.size(); i += count, count = 1) {
    const std::string_view whole = whole_of(lines[i]);
    while (i + count < lines.size() && whole_of(lines[i + count]) == whole) ++count;
    f(i, count);
  }
}

const Axis whole_line{
    "whole_line", {}, [](const Model& m) {
      std::vector<std::string> names;
      const auto& lines = m.description.loads.of<Line>();
      for_each_whole(lines, [&](std::size_t i, std::size_t) { names.emplace_back(whole_of(lines[i])); });
      return names;
    }};
const Axis line_end{"line_end", {"first", "last"}};

/// Calls f(line, motion, section, tension, friction, point) for each section of each line.
template <class F>
void for_each_tension(const Output& o, F&& f) {
  const LoadInput<double> in = input_of(o);
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

/// Of the first and of the last section of a line.
std::pair<double, double> ends_of(const Line& one, const LoadInput<double>& in) {
  double first = 0.0, last = 0.0;
  std::size_t sections = 0;
  one.for_each_tension<double>(
      in, one.motion(in),
      [&](const PathSection<double>&, double tension, const SheaveFriction<double>&, std::size_t) {
        if (sections++ == 0) first = tension;
        last = tension;
      });
  return {first, last};
}

/// From the tensions of the segment at an end and of the next, which are those of their middles. A line that
/// pulls does so to its end.
double beyond(double near, double far) {
  const double end = 1.5 * near - 0.5 * far;
  return near >= 0.0 ? std::max(end, 0.0) : end;
}

void write_end_tension(const Output& o, double* out) {
  const LoadInput<double> in = input_of(o);
  const std::vector<Line>& lines = lines_of(o.terms.model());
  const auto& described = o.terms.model().description.loads.of<Line>();
  for_each_whole(described, [&](std::size_t i, std::size_t count) {
    const double first = ends_of(lines[i], in).first, last = ends_of(lines[i + count - 1], in).second;
    *out++ = count == 1 ? first : beyond(first, ends_of(lines[i + 1], in).first);
    *out++ = count == 1 ? last : beyond(last, ends_of(lines[i + count - 2], in).second);
  });
}

void write_sheave_power(const Output& o, double* out) {
  for_each_tension(o, [&](const Line& one, const PathSection<double>&, double tension,
                          const SheaveFriction<double>& friction, std::size_t i) {
    if (!one.path.points()[i].turns_line()) return;
    *out++ = one.has_friction ? tension * friction.last_power() : 0.0;
  });
}

/// A number of the section before each sheave.
template <double PathSection<double>::*member>
void write_sheaves(const Output& o, double* out) {
  for_each_tension(o, [&](const Line& one, const PathSection<double>& s, double,
                          const SheaveFriction<double>&, std::size_t i) {
    if (one.path.points()[i].turns_line()) *out++ = s.*member;
  });
}

}  // namespace

std::vector<Channel> sheave_channels() {
  return {
      {.name = "section_tension",
       .axes = {&section},
       .unit = "N",
       .text = "tension of each section of lines over sheaves or with friction",
       .needs = {.tensions = true},
       .peaks = Peaks::of_lines,
       .write = write_section_tension},
      {.name = "end_tension",
       .axes = {&whole_line, &line_end},
       .unit = "N",
       .text = "tension at both ends of a line; of one with mass beyond the middles of its segments",
       .needs = {.tensions = true},
       .peaks = Peaks::of_lines,
       .by_default = false,
       .write = write_end_tension},
      {.name = "sheave_wrap",
       .axes = {&sheave},
       .unit = "rad",
       .text = "angle by which a line lies on its sheave; 0 at points with friction",
       .write = write_sheaves<&PathSection<double>::wrap>},
      {.name = "sheave_fleet_angle",
       .axes = {&sheave},
       .unit = "rad",
       .text = "larger angle of both spans at a sheave with the plane of its rim",
       .peaks = Peaks::of_states,
       .write = write_sheaves<&PathSection<double>::fleet>},
      {.name = "sheave_friction_power",
       .axes = {&sheave},
       .unit = "W",
       .text = "power of the friction on a sheave, never positive",
       .write = write_sheave_power},
  };
}

}  // namespace seacrane
