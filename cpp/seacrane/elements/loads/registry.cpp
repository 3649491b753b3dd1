#include "seacrane/elements/loads/registry.hpp"

#include <algorithm>
#include <type_traits>

#include "seacrane/elements/loads/load_kind.hpp"

namespace seacrane {

const std::vector<const LoadKind*>& load_kinds() {
  static const auto kinds = []<class... Load>(std::type_identity<std::tuple<Load...>>) {
    return std::vector<const LoadKind*>{&load_kind<Load>()...};
  }(std::type_identity<LoadTypes>{});
  return kinds;
}

const LoadKind* find_load_kind(const std::string& name) {
  const auto& all = load_kinds();
  const auto found = std::find_if(all.begin(), all.end(), [&](const LoadKind* k) { return k->name == name; });
  return found == all.end() ? nullptr : *found;
}

}  // namespace seacrane
