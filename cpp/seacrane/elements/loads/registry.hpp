#pragma once

#include <tuple>

namespace seacrane {

/// The one list of loads that a scene describes: a new one is a file of its name and an entry here. What
/// others follow comes before them. Each is compiled in an object of its own (cmake/Kinds.cmake): the types
/// are not complete here.
using LoadTypes =
    std::tuple<struct HeaveCompensator, struct Actuator, struct PointForce, struct SpringDamper,
               struct ForceTable, struct FunctionForce, struct FlowForce, struct Friction, struct SoftStop,
               struct Line, struct GasSpring, struct PendulumDamping, struct SpanDrag,
               struct HydraulicCylinder, struct ImmersedPart, struct EntrappedWater, struct ImmersedSpan,
               struct WoundSpan, struct SeabedNode, struct Contact>;

}  // namespace seacrane
