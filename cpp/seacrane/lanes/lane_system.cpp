#include "seacrane/lanes/lane_system.hpp"

#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/elements/loads/load_kind.hpp"

namespace seacrane {
namespace {

std::string kept_out_by_waves(const WaveLoad& wave) {
  const WaveLoadDescription& s = wave.sources;
  if (s.positioned) return "its wave loads are those of the actual position";
  if (!s.table) return "its wave loads are exact sums";
  if (s.drift && !s.drift_table) return "its slow drift is an exact sum";
  return "";
}

}  // namespace

std::string kept_out_of_lanes(const Model& model) {
  const Model& m = model.stepped();
  if (m.paper_kinematics) return "it has the paper's kinematics";
  if (m.description.baumgarte > 0.0) return "it stabilises its joints";
  if (!m.limits.empty() || !model.limits.empty()) return "it has limits";
  for (const Vessel& vessel : m.vessels) {
    if (std::holds_alternative<Convolution>(vessel.memory)) return "its fluid memory is a convolution";
  }
  for (const auto& list : m.loads.lists) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      if (list->jumps(i, Side(), ~Side()))
        return "states of " + name_of(*list, i) + " jump where it is touched";
    }
  }
  for (const WaveLoad& wave : m.wave_loads) {
    const std::string why = kept_out_by_waves(wave);
    if (!why.empty()) return why;
  }
  const BodyTree tree = build_tree(m);
  if (!tree.refused.empty()) return tree.refused;
  if (tree.loop_rows > 0) return "it has loops that constraints close";
  return tree.speeds == tree.driven ? "nothing moves" : "";
}

}  // namespace seacrane
