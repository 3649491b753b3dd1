#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "seacrane/elements/driver.hpp"
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

/// The one list of joint types: a new type is its own file and an entry here.
using JointTypes =
    std::tuple<Weld, Revolute, Prismatic, Cylindrical, Universal, Spherical, Planar, Distance, Free>;

inline constexpr std::size_t kJointKinds = std::tuple_size_v<JointTypes>;

/// Calls f.template operator()<Type>(index) for every joint type.
template <class F>
constexpr void for_each_joint_type(F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f.template operator()<std::tuple_element_t<I, JointTypes>>(I), ...);
  }
  (std::make_index_sequence<kJointKinds>{});
}

/// Joints of one kind side by side, evaluated with one dispatch per kind.
using JointsByKind = std::array<std::vector<JointData>, kJointKinds>;

}  // namespace seacrane
