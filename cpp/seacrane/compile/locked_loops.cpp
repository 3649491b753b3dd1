#include <algorithm>
#include <map>
#include <set>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/dependence.hpp"
#include "seacrane/dynamics/terms.hpp"
#include "seacrane/math/dense.hpp"

namespace seacrane {
namespace {

constexpr double kAlike = 1e-7;  // of a motion of unit size: what moves two bodies apart
constexpr int kMostBodies = 60;  // of a component: its rows are decomposed densely

struct Edge {
  int element = 0, first = 0, second = 0;
  bool holds = false;  // a constant driver
};

/// Joints and constant drivers that hold in every set of limits.
std::vector<Edge> edges_of(const Model& m) {
  std::set<int> limited;
  for (const Limit& limit : m.limits) {
    if (!limit.kind->of_coordinate) limited.insert(limit.joint);
  }
  const int joints = static_cast<int>(m.description.joints.size());
  std::vector<Edge> out;
  for (int e = 0; e < static_cast<int>(m.elements.size()); ++e) {
    const ElementModel& element = m.elements[idx(e)];
    if (element.rows == 0 || limited.count(e) > 0) continue;
    const bool driver = e >= joints;
    if (driver && (idx(e - joints) >= m.description.drivers.size() ||
                   !m.description.drivers[idx(e - joints)].curve.constant_value())) {
      continue;
    }
    out.push_back({e, element.first, element.second, driver});
  }
  return out;
}

/// The biconnected components of a graph, as lists of its edges (Hopcroft and Tarjan 1973).
class Components {
 public:
  Components(int nodes, const std::vector<Edge>& edges) : edges_(edges), at_(idx(nodes)), low_(idx(nodes)) {
    near_.resize(idx(nodes));
    for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
      near_[idx(edges[idx(e)].first)].push_back(e);
      near_[idx(edges[idx(e)].second)].push_back(e);
    }
    for (int node = 0; node < nodes; ++node) {
      if (at_[idx(node)] == 0) visit(node, -1);
    }
  }

  std::vector<std::vector<int>> found;

 private:
  void visit(int node, int by) {
    at_[idx(node)] = low_[idx(node)] = ++count_;
    for (const int e : near_[idx(node)]) {
      if (e == by) continue;
      const Edge& edge = edges_[idx(e)];
      const int next = edge.first == node ? edge.second : edge.first;
      if (at_[idx(next)] == 0) {
        open_.push_back(e);
        visit(next, e);
        low_[idx(node)] = std::min(low_[idx(node)], low_[idx(next)]);
        if (low_[idx(next)] >= at_[idx(node)]) close(e);
      } else if (at_[idx(next)] < at_[idx(node)]) {
        open_.push_back(e);
        low_[idx(node)] = std::min(low_[idx(node)], at_[idx(next)]);
      }
    }
  }

  void close(int first) {
    std::vector<int> component;
    for (int e = -1; e != first;) {
      component.push_back(e = open_.back());
      open_.pop_back();
    }
    found.push_back(component);
  }

  const std::vector<Edge>& edges_;
  std::vector<std::vector<int>> near_;
  std::vector<int> at_, low_, open_;
  int count_ = 0;
};

/// The motions that a component's rows allow, an orthonormal basis: (v, w * length) of each of its bodies.
class Motions {
 public:
  Motions(const Terms& terms, const std::vector<Edge>& edges, const std::vector<int>& component)
      : terms_(terms) {
    const int ground = terms.model().body_count();
    for (const int e : component) {
      for (const int body : {edges[idx(e)].first, edges[idx(e)].second}) nodes.insert(body);
    }
    int columns = 0;
    for (const int body : nodes) {
      if (body != ground) column_[body] = 6 * columns++;
      length_ = std::max(length_, (position(body) - position(*nodes.begin())).norm());
    }
    int rows = 0;
    for (const int e : component) rows += terms.model().elements[idx(edges[idx(e)].element)].rows;
    MatXd transposed = MatXd::Zero(6 * columns, rows);
    int row = 0;
    for (const int e : component) {
      const Edge& edge = edges[idx(e)];
      const RowBlock<double>& block = terms.blocks()[idx(edge.element)];
      const int count = terms.model().elements[idx(edge.element)].rows;
      for (int side = 0; side < 2; ++side) {
        const auto column = column_.find(side == 0 ? edge.first : edge.second);
        if (column == column_.end()) continue;
        auto part = transposed.block(column->second, row, 6, count);
        part += block.d[side].topRows(count).transpose();
        part.bottomRows<3>() /= length_;
      }
      row += count;
    }
    basis_ = perpendicular(transposed, kRedundantSingularValue);
  }

  /// Whether every motion moves both bodies as one.
  bool alike(int a, int b) const {
    const Vec3d lever = position(b) - position(a);
    for (Eigen::Index i = 0; i < basis_.cols(); ++i) {
      const Vec6d one = twist(a, i), other = twist(b, i);
      const Vec3d turning = one.tail<3>();
      const Vec3d apart = other.head<3>() - one.head<3>() - turning.cross(lever);
      if (apart.norm() > kAlike || length_ * (other - one).tail<3>().norm() > kAlike) return false;
    }
    return true;
  }

  std::set<int> nodes;

 private:
  Vec3d position(int body) const { return terms_.bodies()[idx(body)].position; }

  Vec6d twist(int body, Eigen::Index motion) const {
    const auto column = column_.find(body);
    if (column == column_.end()) return Vec6d::Zero();
    Vec6d out = basis_.block<6, 1>(column->second, motion);
    out.tail<3>() /= length_;
    return out;
  }

  const Terms& terms_;
  std::map<int, int> column_;
  double length_ = 1e-3;
  MatXd basis_;
};

/// The frame of the second body in that of the first, as they stand.
RigidLink link(const Terms& terms, int first, int second) {
  const auto origin = [&](int body) -> Vec3d {
    if (body == terms.model().body_count()) return Vec3d::Zero();
    const BodyKinematics<double>& k = terms.bodies()[idx(body)];
    return k.position - k.rotation * terms.model().bodies[idx(body)].state_point;
  };
  const Mat3d back = terms.bodies()[idx(first)].rotation.transpose();
  return {first, second, back * (origin(second) - origin(first)),
          back * terms.bodies()[idx(second)].rotation};
}

}  // namespace

std::vector<RigidLink> locked_loops(const Model& assembled) {
  std::vector<RigidLink> out;
  if (assembled.paper_kinematics) return out;
  const std::vector<Edge> edges = edges_of(assembled);
  if (std::none_of(edges.begin(), edges.end(), [](const Edge& e) { return e.holds; })) return out;
  const std::shared_ptr<const Model> view(&assembled, [](const Model*) {});
  Terms terms(view);
  terms.read(0.0, assembled.initial_state.data());
  terms.evaluate_rows(0.0);
  for (const std::vector<int>& component : Components(assembled.body_count() + 1, edges).found) {
    const bool held =
        std::any_of(component.begin(), component.end(), [&](int e) { return edges[idx(e)].holds; });
    if (!held || component.size() < 3 || static_cast<int>(component.size()) > 2 * kMostBodies) continue;
    const Motions motions(terms, edges, component);
    std::vector<int> firsts;  // of each class
    for (const int body : motions.nodes) {
      const auto first =
          std::find_if(firsts.begin(), firsts.end(), [&](int a) { return motions.alike(a, body); });
      if (first == firsts.end()) {
        firsts.push_back(body);
      } else {
        out.push_back(link(terms, *first, body));
      }
    }
  }
  return out;
}

}  // namespace seacrane
