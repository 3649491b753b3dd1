#pragma once

#include <tuple>
#include <utility>

#include "seacrane/elements/joints/cylindrical.hpp"
#include "seacrane/elements/joints/distance.hpp"
#include "seacrane/elements/joints/free.hpp"
#include "seacrane/elements/joints/planar.hpp"
#include "seacrane/elements/joints/prismatic.hpp"
#include "seacrane/elements/joints/revolute.hpp"
#include "seacrane/elements/joints/spherical.hpp"
#include "seacrane/elements/joints/universal.hpp"
#include "seacrane/elements/joints/weld.hpp"

namespace seacrane {

/// The list of joint types: a new type is its own file and an entry here. In their comments a and b are the
/// joint frames on the first and on the second body, and d leads from the point of a to that of b.
using JointTypes =
    std::tuple<Weld, Revolute, Prismatic, Cylindrical, Universal, Spherical, Planar, Distance, Free>;

/// Calls f.template operator()<Type>(index) for every joint type.
template <class F>
constexpr void for_each_joint_type(F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f.template operator()<std::tuple_element_t<I, JointTypes>>(I), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<JointTypes>>{});
}

}  // namespace seacrane
