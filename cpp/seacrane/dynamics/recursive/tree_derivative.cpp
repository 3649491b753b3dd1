#include "seacrane/dynamics/recursive/tree_derivative.hpp"

#include <Eigen/Eigenvalues>
#include <optional>

#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"

namespace seacrane {
namespace {

constexpr double kSymmetric = 1e-14;  // of the largest entry: what rounding leaves of a symmetry

}  // namespace

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

std::optional<TreeCoordinate> find_coordinate(const CoordinateData& coordinate, const BodyTree& tree) {
  static const std::size_t revolute = find_joint_kind("revolute")->index,
                           prismatic = find_joint_kind("prismatic")->index;
  const int element = coordinate.joint.element;
  const bool angle = coordinate.kind == CoordinateKind::angle,
             way = coordinate.kind == CoordinateKind::displacement;
  for (std::size_t i = 0; i < tree.clusters.size(); ++i) {
    const Cluster& c = tree.clusters[i];
    if (c.element == element && ((angle && c.kind == revolute) || (way && c.kind == prismatic))) {
      return TreeCoordinate{i, c.q, c.u, -1, c.parent == coordinate.joint.first ? 1.0 : -1.0};
    }
    for (int s = c.first_strut; way && s < c.first_strut + c.struts; ++s) {
      const Strut& strut = tree.struts[idx(s)];
      if (strut.element == element) return TreeCoordinate{i, c.q, c.u, s, strut.slides_up ? 1.0 : -1.0};
    }
  }
  return std::nullopt;
}

TurningInertia::TurningInertia(const Mat3d& inertia) : inertia_(inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3d> principal(inertia);
  const Vec3d& values = principal.eigenvalues();
  const int other =
      values[2] - values[1] < values[1] - values[0] ? 0 : 2;  // the one apart from the two others
  axis_ = principal.eigenvectors().col(other);
  across_ = 0.5 * (values[1] + values[2 - other]);
  excess_ = values[other] - across_;
  const Mat3d symmetric = across_ * Mat3d::Identity() + excess_ * axis_ * axis_.transpose();
  has_axis_ = (inertia - symmetric).cwiseAbs().maxCoeff() <= kSymmetric * inertia.cwiseAbs().maxCoeff();
}

}  // namespace seacrane
