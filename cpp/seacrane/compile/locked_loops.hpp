#pragma once

#include <vector>

#include "seacrane/model/model.hpp"

namespace seacrane {

/// Bodies that joints and constant drivers hold to each other around a loop, such as a jib, its barrel and
/// its rod under a held stroke, placed as the model is assembled.
///
/// Within each biconnected component of the graph of bodies and joints, bodies are one where every motion
/// that the rows allow moves them alike: rigid to first order is rigid. Where that is not so, as in a dead
/// centre, they stay apart. Limits count as open, and so do drivers that move.
std::vector<RigidLink> locked_loops(const Model& assembled);

}  // namespace seacrane
