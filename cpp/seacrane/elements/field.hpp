#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "seacrane/elements/check.hpp"
#include "seacrane/math/curve.hpp"

/// The entries of a description, in one place: constructor, properties, comparison, checks of type, scene
/// files, reports and stubs are made from `Description::fields()`, a tuple of these.
namespace seacrane {

/// What a text names: a body, a joint, a coordinate of the joint named before it. A joint's number may be the
/// distance of its two points, which is what it defaults to when a joint is described by points.
enum class Role { value, body, joint, coordinate, distance };
template <class Get>
struct Field {
  const char* name;
  Get get;  // std::invoke(get, description) is the entry: a pointer to a member, or a function
  const char* unit;
  const char* text;
  bool required = false;  // else it defaults to what a default description holds
  Role role = Role::value;
  Bound bound = {};
  double least = 0.0, most = 0.0;  // usual magnitudes of what is not zero; 0: of no bound

  template <class Description>
  constexpr decltype(auto) of(Description& d) const {
    return std::invoke(get, d);
  }
  constexpr Field as(Role r) const {
    Field out = *this;
    out.role = r;
    return out;
  }
  constexpr Field must_be(Bound b) const {
    Field out = *this;
    out.bound = b;
    return out;
  }
  constexpr Field positive() const { return must_be({.minimum = 0.0, .above = true}); }
  constexpr Field not_negative() const { return must_be({.minimum = 0.0}); }
  constexpr Field not_zero() const { return must_be({.not_zero = true}); }
  constexpr Field within(double minimum, double maximum) const {
    return must_be({.minimum = minimum, .maximum = maximum});
  }
  /// Magnitudes beyond these are rather a slip in the unit: told, not refused.
  constexpr Field usually(double from, double to) const {
    Field out = *this;
    out.least = from;
    out.most = to;
    return out;
  }
};

template <class Get>
constexpr Field<Get> required(const char* name, Get get, const char* unit, const char* text) {
  return {name, get, unit, text, true};
}
template <class Get>
constexpr Field<Get> optional(const char* name, Get get, const char* unit, const char* text) {
  return {name, get, unit, text};
}
/// A body's name; "ground" where the check of the element allows it.
template <class Get>
constexpr Field<Get> on_body(const char* name, Get get, const char* text = "body") {
  return {name, get, "", text, true, Role::body};
}
/// The joint and its coordinate of a description with a member `coordinate`.
template <class Description>
constexpr auto on_coordinate(bool coordinate_required = true) {
  constexpr auto joint = [](auto& d) -> auto& { return d.coordinate.joint; };
  constexpr auto coordinate = [](auto& d) -> auto& { return d.coordinate.coordinate; };
  return std::tuple(Field<decltype(joint)>{"joint", joint, "", "joint", true, Role::joint},
                    Field<decltype(coordinate)>{"coordinate", coordinate, "", "one that the joint offers",
                                                coordinate_required, Role::coordinate});
}

/// Calls f(field) for every entry of a description.
template <class Description, class F>
constexpr void for_each_field(F&& f) {
  std::apply([&](const auto&... field) { (f(field), ...); }, Description::fields());
}

/// All numbers of an entry, of a curve those where its pieces begin; those of points are near.
template <class Get, class V>
void check_value(const Field<Get>& field, const std::string& what, const V& value, const Check& c) {
  const auto each = [&](auto size) {
    for (decltype(size) i = 0; i < size; ++i) {
      check_value(field, what + "[" + std::to_string(i) + "]", value[i], c);
    }
  };
  if constexpr (std::is_same_v<V, double>) {
    c.number(what, value, field.unit, field.bound, "", field.text);
  } else if constexpr (std::is_same_v<V, Curve>) {
    for (const Curve::Piece& piece : value.pieces()) {
      c.number(what, value.at(piece.start).value, field.unit, field.bound,
               " at t = " + to_text(piece.start) + " s", field.text);
    }
  } else if constexpr (std::is_same_v<V, std::vector<double>> || std::is_same_v<V, std::vector<Vec3d>> ||
                       std::is_same_v<V, std::vector<Vec6d>>) {
    each(value.size());
  } else if constexpr (requires { V::ColsAtCompileTime; }) {
    if constexpr (std::is_same_v<V, Vec3d>) {
      if (field.unit == std::string_view("m")) return c.near(what.c_str(), value);
    }
    c.finite(what.c_str(), value);
    if constexpr (V::ColsAtCompileTime == 1) each(value.size());
  }
}

/// All entries of a description.
template <class Description>
void check_fields(const Description& d, const Check& c) {
  for_each_field<Description>([&](const auto& field) { check_value(field, field.name, field.of(d), c); });
}

}  // namespace seacrane
