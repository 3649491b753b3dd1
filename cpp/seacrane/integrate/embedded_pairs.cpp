#include <span>

#include "seacrane/integrate/embedded_pair.hpp"
#include "seacrane/integrate/registration.hpp"
#include "seacrane/integrate/tableaus/pairs.hpp"

namespace seacrane {
namespace {

template <class... Tableau>
std::span<const Registration> registrations(const std::tuple<Tableau...>*) {
  static constexpr Registration all[] = {registration<EmbeddedPair<Tableau>>()...};
  return all;
}

}  // namespace

std::span<const Registration> explicit_pairs() {
  return registrations(static_cast<const tableaus::Pairs*>(nullptr));
}

}  // namespace seacrane
