#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "seacrane/elements/loads/span.hpp"

namespace seacrane {

struct SpringDescription : SpanDescription {
  double stiffness = 0.0, damping = 0.0, natural_length = 0.0;
  std::vector<double> lengths, forces;  // tabulated tension over length, instead of stiffness

  static constexpr const char* type = "Spring";
  static constexpr const char* text =
      "Tension between two body-fixed points: stiffness times elongation, or a table of tension over length, "
      "plus damping times the rate of length.";
  static constexpr auto fields() {
    using D = SpringDescription;
    return std::tuple_cat(
        SpanDescription::fields(),
        std::tuple(
            optional("stiffness", &D::stiffness, "N/m", "").not_negative(),
            optional("damping", &D::damping, "N s/m", "").not_negative(),
            optional("natural_length", &D::natural_length, "m", "").not_negative().usually(0.0, 5000.0),
            optional("lengths", &D::lengths, "m", "of a table of tension, in place of stiffness")
                .usually(0.0, 5000.0),
            optional("forces", &D::forces, "N", "tension at the lengths")));
  }
};

/// Tension between two points: stiffness (length - natural_length), or a table of tension over length
/// (linear between its points, held outside), plus damping times the rate of length.
struct SpringDamper {
  static constexpr const char* kind = "spring";
  static constexpr bool packs = true;
  static constexpr bool holds = true;
  using Description = SpringDescription;

  Description d;
  Span span;

  static void check(const Description& d, const Check& c, SceneNames& names) {
    d.check(c, names);
    if (d.lengths.size() != d.forces.size() || d.lengths.size() == 1) {
      c.fail("the table has " + std::to_string(d.lengths.size()) + " lengths and " +
             std::to_string(d.forces.size()) + " forces; give at least two of each");
    }
    c.increases("lengths", d.lengths);
  }

  static Description example() {
    auto d = example_span<Description>();
    d.stiffness = 30.0;
    d.damping = 0.5;
    d.natural_length = 0.8;
    return d;
  }

  template <class Context>
  static SpringDamper compile(const Description& d, Context& context) {
    return {d, Span::compile(d, context)};
  }

  /// A table over length has its kinks in the state.
  static std::vector<LoadKinks> kinks() { return {}; }

  std::array<int, 2> bodies() const { return span.bodies(); }

  template <class T>
  void apply(const LoadInput<T>& in, LoadSum<T>& out) const {
    const SpanMotion<T> m = span.motion(in);
    const T viscous = T(d.damping) * m.rate;
    span.pull(m, T(elastic(m.length) + viscous), out);
    if (d.damping != 0.0) out.add_power(-viscous * m.rate);
  }

  template <class T>
  T elastic(const T& length) const {
    if (d.lengths.empty()) return T(d.stiffness) * (length - T(d.natural_length));
    T out = T(d.forces.front());
    for (std::size_t i = 0; i + 1 < d.lengths.size(); ++i) {
      const double slope = (d.forces[i + 1] - d.forces[i]) / (d.lengths[i + 1] - d.lengths[i]);
      const T here = T(d.forces[i]) + T(slope) * (length - T(d.lengths[i]));
      out = select(length >= T(d.lengths[i]), here, out);
    }
    return select(length < T(d.lengths.back()), out, T(d.forces.back()));
  }

  bool has_sides() const { return !d.lengths.empty(); }
  /// The segment of the table; 0 before its first length.
  Side side(const LoadInput<double>& in) const {
    const auto next = std::upper_bound(d.lengths.begin(), d.lengths.end(), span.length(in));
    return Side(static_cast<std::size_t>(next - d.lengths.begin()));
  }
  double across(const LoadInput<double>& in, const Side& from, const Side& to) const {
    const std::size_t at = from.to_ulong();
    return span.length(in) - d.lengths[to.to_ulong() > at ? at : at - 1];
  }
  /// The corners of its table beside its length.
  Sight look(const LoadInput<double>& in) const {
    const SpanMotion<double> now = span.motion(in);
    Sight out{.side = side(in), .watched = ~Side(), .pace = std::abs(now.rate), .at = {now.length, 0.0, 0.0}};
    const std::size_t next = out.side.to_ulong();
    if (next < d.lengths.size()) out.clear = d.lengths[next] - now.length;
    if (next > 0) out.clear = std::min(out.clear, now.length - d.lengths[next - 1]);
    return out;
  }

  double potential(const LoadInput<double>& in) const {
    const double length = span.length(in);
    if (d.lengths.empty())
      return 0.5 * d.stiffness * (length - d.natural_length) * (length - d.natural_length);
    double energy = std::min(0.0, length - d.lengths.front()) * d.forces.front();
    for (std::size_t i = 0; i + 1 < d.lengths.size() && d.lengths[i] < length; ++i) {
      const double end = std::min(length, d.lengths[i + 1]);
      energy += 0.5 * (d.forces[i] + elastic(end)) * (end - d.lengths[i]);
    }
    return energy + std::max(0.0, length - d.lengths.back()) * d.forces.back();
  }
};

}  // namespace seacrane
