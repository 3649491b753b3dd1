#include "seacrane/model/difference.hpp"

#include <algorithm>
#include <functional>
#include <type_traits>
#include <vector>

#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {
namespace {

template <class D>
concept Described = requires {
  D::fields();
};
template <class V>
concept OfEigen = std::is_base_of_v<Eigen::EigenBase<V>, V>;

template <Described D>
const char* different_field(const D& one, const D& other);

template <class V>
bool same(const V& one, const V& other) {
  return one == other;
}
template <Described D>
bool same(const D& one, const D& other) {
  return different_field(one, other) == nullptr;
}
template <OfEigen M>
bool same(const M& one, const M& other) {
  return one.rows() == other.rows() && one.cols() == other.cols() && one == other;
}
template <class V>
bool same(const std::vector<V>& one, const std::vector<V>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const V& a, const V& b) { return same(a, b); });
}
bool same(const Curve& one, const Curve& other) {
  const auto alike = [](const Curve::Piece& a, const Curve::Piece& b) {
    return a.start == b.start && a.coefficients == b.coefficients && a.amplitude == b.amplitude &&
           a.omega == b.omega && a.phase == b.phase;
  };
  const std::vector<Curve::Piece>&a = one.pieces(), &b = other.pieces();
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), alike);
}
bool same(const StateSpaceBlock& one, const StateSpaceBlock& other) {
  return one.inputs == other.inputs && one.outputs == other.outputs && same(one.a, other.a) &&
         same(one.b, other.b) && same(one.c, other.c) && same(one.d, other.d) &&
         same(one.state_scale, other.state_scale);
}
bool same(const RetardationFunctions& one, const RetardationFunctions& other) {
  const auto alike = [](const Mat6d& a, const Mat6d& b) { return a == b; };
  return one.step == other.step &&
         std::equal(one.kernel.begin(), one.kernel.end(), other.kernel.begin(), other.kernel.end(), alike);
}
template <class... V>
bool same(const std::variant<V...>& one, const std::variant<V...>& other) {
  if (one.index() != other.index()) return false;
  return std::visit(
      [&]<class Held>(const Held& held) {
        if constexpr (std::is_same_v<Held, std::vector<StateSpaceBlock>>) {
          const auto& there = std::get<Held>(other);
          return std::equal(held.begin(), held.end(), there.begin(), there.end(),
                            [](const StateSpaceBlock& a, const StateSpaceBlock& b) { return same(a, b); });
        } else {
          return same(held, std::get<Held>(other));
        }
      },
      one);
}

/// The name of the first entry in which two descriptions differ; null: none.
template <Described D>
const char* different_field(const D& one, const D& other) {
  const char* out = nullptr;
  for_each_field<D>([&](const auto& field) {
    if (out == nullptr && !same(field.of(one), field.of(other))) out = field.name;
  });
  if constexpr (std::is_same_v<D, JointDescription>) {
    if (out == nullptr && one.parameters != other.parameters) out = "parameters";
    if (out == nullptr && one.open != other.open) out = "open";
  }
  return out;
}

template <Described D>
std::string difference(const std::string& kind, const std::vector<D>& one, const std::vector<D>& other) {
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
    if (one[i].name != other[i].name)
      return kind + " '" + one[i].name + "', which is '" + other[i].name + "'";
    const char* const field = different_field(one[i], other[i]);
    if (field != nullptr) return kind + " '" + one[i].name + "' (" + field + ")";
  }
  if (one.size() == other.size()) return "";
  return kind + " '" + (one.size() > other.size() ? one[other.size()] : other[one.size()]).name +
         "', which one of them has";
}

std::string difference_of_loads(const LoadDescriptions& one, const LoadDescriptions& other) {
  std::string out;
  for_each_load_type([&]<class Load>() {
    using Loads = std::vector<typename Load::Description>;
    if (out.empty()) out = difference(Load::kind, std::get<Loads>(one), std::get<Loads>(other));
  });
  return out;
}

std::string difference_of_waves(const Model& one, const Model& other) {
  const std::vector<WaveLoad>&a = one.stepped().wave_loads, &b = other.stepped().wave_loads;
  if (a.size() != b.size()) return "the vessels that waves load";
  for (std::size_t i = 0; i < a.size(); ++i) {
    const WaveLoadDescription &here = a[i].sources, &there = b[i].sources;
    if (here.body != there.body || a[i].body != b[i].body || a[i].vessel != b[i].vessel) {
      return "the vessels that waves load";
    }
    if (here.has_drift() != there.has_drift()) return "the slow drift of '" + here.body + "'";
    if ((here.table != nullptr) != (there.table != nullptr) ||
        (here.positioned != nullptr) != (there.positioned != nullptr)) {
      return "how waves load '" + here.body + "'";
    }
  }
  return "";
}

std::string difference_of_scenes(const SceneDescription& one, const SceneDescription& other) {
  if (one.gravity != other.gravity) return "gravity";
  if (one.orientation != other.orientation) return "orientation";
  if (one.baumgarte != other.baumgarte) return "baumgarte";
  if (one.length_scale != other.length_scale) return "length_scale";
  std::string out = difference("body", one.bodies, other.bodies);
  if (out.empty()) out = difference("joint", one.joints, other.joints);
  if (out.empty()) out = difference("driver", one.drivers, other.drivers);
  if (out.empty()) out = difference_of_loads(*one.loads, *other.loads);
  if (out.empty()) out = difference("vessel", one.vessels, other.vessels);
  if (out.empty()) out = difference("limit", one.limits, other.limits);
  return out;
}

}  // namespace

std::string difference(const Model& one, const Model& other) {
  const std::string described = difference_of_scenes(one.description, other.description);
  if (!described.empty()) return described;
  if (one.merges != other.merges) return "whether bodies are merged";
  if (one.closed != other.closed) return "the limits that hold";
  return difference_of_waves(one, other);
}

}  // namespace seacrane
