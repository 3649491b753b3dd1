#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/joint.hpp"
#include "seacrane/math/curve.hpp"

/// Where descriptions differ, entry by entry.
namespace seacrane {

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
inline bool same(const Curve& one, const Curve& other) {
  const auto alike = [](const Curve::Piece& a, const Curve::Piece& b) {
    return a.start == b.start && a.coefficients == b.coefficients && a.amplitude == b.amplitude &&
           a.omega == b.omega && a.phase == b.phase;
  };
  const std::vector<Curve::Piece>&a = one.pieces(), &b = other.pieces();
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), alike);
}

/// The first entry that differs; null: none.
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

/// The first element of a kind that is another one, or has another entry; empty: none.
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

}  // namespace seacrane
