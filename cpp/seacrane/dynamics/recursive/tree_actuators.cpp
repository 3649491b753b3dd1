#include "seacrane/dynamics/recursive/tree_actuators.hpp"

#include <optional>

#include "seacrane/dynamics/recursive/tree_coordinate.hpp"

namespace seacrane {

TreeActuators::TreeActuators(const Model& model, const BodyTree& tree) {
  for (const auto& list : model.loads.lists) {
    Held<LoadList> left(list->empty());
    for (std::size_t i = 0; i < list->size(); ++i) {
      const CoordinateData* const along = list->coordinate(i);
      const std::optional<TreeCoordinate> place = along ? find_coordinate(*along, tree) : std::nullopt;
      if (place) {
        along_.push_back({&*list, i, place->q, place->u, place->strut, place->sign});
      } else {
        left->take(*list, i);
      }
    }
    if (left->size() > 0) others_.lists.push_back(std::move(left));
  }
}

}  // namespace seacrane
