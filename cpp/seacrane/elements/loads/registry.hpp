#pragma once

#include <tuple>
#include <vector>

#include "seacrane/elements/loads/actuator.hpp"
#include "seacrane/elements/loads/flow_force.hpp"
#include "seacrane/elements/loads/force_table.hpp"
#include "seacrane/elements/loads/friction.hpp"
#include "seacrane/elements/loads/function_force.hpp"
#include "seacrane/elements/loads/gas_spring.hpp"
#include "seacrane/elements/loads/heave_compensator.hpp"
#include "seacrane/elements/loads/hydraulic_cylinder.hpp"
#include "seacrane/elements/loads/line.hpp"
#include "seacrane/elements/loads/pendulum_damping.hpp"
#include "seacrane/elements/loads/point_force.hpp"
#include "seacrane/elements/loads/soft_stop.hpp"
#include "seacrane/elements/loads/span_drag.hpp"
#include "seacrane/elements/loads/spring_damper.hpp"

namespace seacrane {

/// The one list of loads that a scene describes: a new one is its own file and an entry here. What others
/// follow comes before them.
using LoadTypes =
    std::tuple<HeaveCompensator, Actuator, PointForce, SpringDamper, ForceTable, FunctionForce, FlowForce,
               Friction, SoftStop, Line, GasSpring, PendulumDamping, SpanDrag, HydraulicCylinder>;

/// Calls f.template operator()<Load>() for every type of load.
template <class F>
constexpr void for_each_load_type(F&& f) {
  [&]<class... Load>(std::type_identity<std::tuple<Load...>>) {
    (f.template operator()<Load>(), ...);
  }(std::type_identity<LoadTypes>{});
}

template <class Types>
struct ByLoadType;
template <class... Load>
struct ByLoadType<std::tuple<Load...>> {
  using Descriptions = std::tuple<std::vector<typename Load::Description>...>;
  using Loads = std::tuple<std::vector<Load>...>;
};

struct LoadDescriptions : ByLoadType<LoadTypes>::Descriptions {};
/// Loads of one kind side by side, dispatched once per kind.
struct CompiledLoads : ByLoadType<LoadTypes>::Loads {};

}  // namespace seacrane
