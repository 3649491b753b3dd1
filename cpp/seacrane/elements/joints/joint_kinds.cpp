#include "seacrane/elements/joints/joint_kinds.hpp"

#include <algorithm>

#include "seacrane/elements/joints/registry.hpp"

namespace seacrane {
namespace {

template <class T, class Type>
void evaluate(const JointData& joint, const BodyKinematics<T>* bodies, RowBlock<T>& block) {
  const JointGeometry<T> geometry(joint, bodies[joint.first], bodies[joint.second]);
  Type::template evaluate<T>(geometry, joint, block);
}

template <class Type>
JointKind kind_of(std::size_t index) {
  using Parameters = typename Type::Parameters;
  static_assert(std::tuple_size_v<decltype(Parameters::fields())> <= kMostParameters);
  constexpr bool has_branch = requires { typename Type::Branch; };
  JointKind out{
      .name = Type::kind,
      .index = index,
      .rows = Type::rows,
      .coordinates = Type::coordinates,
      .usual = Type::usual,
      .slides = Type::slides,
      .own_axis = Type::own_axis,
      .own_point = Type::own_point,
      .branch = has_branch,
      .parallel_axes = Type::parallel_axes,
      .aligned_axes = Type::aligned_axes,
      .parameters = {},
      .example = &Type::example,
      .evaluate =
          [](const std::vector<JointData>& joints, const BodyKinematics<double>* bodies,
             RowBlock<double>* blocks) {
            for (const JointData& joint : joints)
              evaluate<double, Type>(joint, bodies, blocks[joint.element]);
          },
      .evaluate_slopes = &evaluate<Dual<12>, Type>,
  };
  const Parameters usual;
  for_each_field<Parameters>([&](const auto& f) {
    out.parameters.push_back({f.name, f.unit, f.text, f.role, f.bound, f.required, f.of(usual)});
  });
  return out;
}

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
