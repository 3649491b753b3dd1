#pragma once

#include <string>
#include <vector>

#include "seacrane/model/model.hpp"

/// The steps of compile(), each in a file of its name.
namespace seacrane {

/// The vessel of a description, whose body starts there. Throws SceneError where its memory does not fit, or
/// the paper's kinematics do not.
Vessel vessel_at(const VesselDescription& d, const BodyDescription& start);

/// The place of a vessel among those of a scene.
int vessel_of(const SceneDescription& scene, const std::string& name);

/// Adds the groups of a model's scene, whose bodies and vessels it has. Throws SceneError where a memory does
/// not fit, or rigid and added masses of a group at the start are not positive definite.
void add_groups(Model& model);

/// Makes the described start consistent: Newton projection of poses and velocities in the mass metric,
/// rank of D, uniqueness of reactions. Writes initial_state, assembly, redundant and unique_reaction.
/// Throws SceneError naming the joints that cannot be closed together.
void assemble(Model& model);

/// Fast motions of vessels in the initial state, as a steady drift of the velocities there leaves them.
void start_fast_motions(Model& model);

/// Checks that loads and limits can start as they are described, and gives those states that jump their first
/// value.
void start_loads(Model& model);

/// The bounces of the lines of a model at its start, with its limits open and in water without waves: what
/// of a load is wet does not depend on the phases of a sea. A line that moves nothing there has none, and
/// neither has the paper's vessel, whose masses have no response to loads.
std::vector<LineBounce> find_line_bounces(const Model& model);

/// Gives lines without a mass of their own that of their bounce.
void hang_on_lines(Model& model, const std::vector<LineBounce>& bounces);

/// Bodies that joints and constant drivers hold to each other around a loop, such as a jib, its barrel and
/// its rod under a held stroke, placed as the model is assembled.
///
/// Within each biconnected component of the graph of bodies and joints, bodies are one where every motion
/// that the rows allow moves them alike: rigid to first order is rigid. Where that is not so, as in a dead
/// centre, they stay apart. Limits count as open, and so do drivers that move.
std::vector<RigidLink> locked_loops(const Model& assembled);

/// The one list of all that curves of time do to a model: drivers and loads, by time. Accelerations are those
/// at the described start.
std::vector<Kink> find_kinks(const Model& model);

}  // namespace seacrane
