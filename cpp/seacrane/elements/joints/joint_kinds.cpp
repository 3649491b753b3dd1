#include "seacrane/elements/joints/joint_kinds.hpp"

#include <algorithm>

#include "seacrane/elements/joints/registry.hpp"

namespace seacrane {
namespace {

template <class Type>
JointKind kind_of(std::size_t index) {
  using Parameters = typename Type::Parameters;
  static_assert(std::tuple_size_v<decltype(Parameters::fields())> <= kMostParameters);
  JointKind out{.name = Type::kind,
                .index = index,
                .rows = Type::rows,
                .coordinates = Type::coordinates,
                .usual = Type::usual,
                .slides = Type::slides,
                .own_axis = Type::own_axis,
                .own_point = Type::own_point,
                .branch = requires {typename Type::Branch;
}
, .parameters = {}, .example = &Type::example
};  // namespace
const Parameters usual;
for_each_field<Parameters>([&](const auto& f) {
  out.parameters.push_back({f.name, f.unit, f.text, f.role, f.bound, f.required, f.of(usual)});
});
return out;
}  // namespace seacrane

}  // namespace

ParameterValues JointKind::values(const JointDescription& joint) const {
  ParameterValues out{};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto given = joint.parameters.find(parameters[i].name);
    out[i] = given == joint.parameters.end() ? parameters[i].usual : given->second;
  }
  return out;
}

const std::vector<JointKind>& joint_kinds() {
  static const std::vector<JointKind> kinds = [] {
    std::vector<JointKind> out;
    for_each_joint_type([&]<class Type>(std::size_t i) { out.push_back(kind_of<Type>(i)); });
    return out;
  }();
  return kinds;
}

const JointKind* find_joint_kind(const std::string& name) {
  const auto& all = joint_kinds();
  const auto found = std::find_if(all.begin(), all.end(), [&](const JointKind& k) { return k.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace seacrane
