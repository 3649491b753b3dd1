#include "seacrane/dynamics/recursive/body_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "seacrane/dynamics/recursive/driven_stroke.hpp"
#include "seacrane/dynamics/recursive/tree_branches.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/math/rotation.hpp"

namespace seacrane {
namespace {

struct Edge {
  std::size_t kind = 0;
  JointData joint;
  int rows = 0;
  bool branch = false;  // the type can be a branch
  bool driven = false;
};

/// Share of a strut's length within which a point counts as on its line, and the like of directions.
constexpr double kOnLine = 1e-6;

/// Share of lengths within which a strut counts as slender: what rounding leaves.
constexpr double kRounding = 1e-13;

/// How well the universal joint holds the strut's spin: zero where the strut lies in the plane of both axes.
double spin_hold(const Strut& s, const BodyKinematics<double>& base, const BodyKinematics<double>& arm) {
  const Vec3d d = arm.position + arm.rotation * s.arm_point - base.position - base.rotation * s.base_point;
  const double squared = d.squaredNorm(), across = s.offset.head<2>().squaredNorm();
  const double along = s.extension_sign * std::sqrt(std::max(squared - across, 0.0));
  const double tilt = s.strut_axis.dot(Vec3d(s.offset[0], s.offset[1], along)) / std::sqrt(squared);
  const double lean =
      ((s.universal_at_base ? base : arm).rotation * s.fixed_axis).dot(d) / std::sqrt(squared);
  return 1.0 - tilt * tilt - lean * lean;
}

/// Whether the strut turns about the hinge's axis alone, see Strut.
bool is_slender(const Strut& s, const TreeJoint& hinge) {
  const Vec3d base = s.base_point - hinge.parent_point, arm = s.arm_point - hinge.child_point;
  const Vec3d on_parent = hinge.parent_axes.col(2), on_child = hinge.child_axes.col(2);
  const Vec3d& axis = s.universal_at_base ? on_parent : on_child;
  const double length = std::max(base.norm(), arm.norm());
  return std::abs(base.dot(on_parent) - arm.dot(on_child)) <= kRounding * length &&
         s.offset.head<2>().norm() <= kRounding * length && std::abs(s.strut_axis[2]) <= kRounding &&
         s.fixed_axis.cross(axis).norm() <= kRounding;
}

/// Turns the frame of a slender strut to its line and the hinge's axis.
void make_slender(Strut& s, const TreeJoint& hinge) {
  const Vec3d& axis = s.universal_at_base ? hinge.parent_axes.col(2) : hinge.child_axes.col(2);
  const Vec3d line(0.0, 0.0, s.extension_sign);
  Mat3d frame;
  frame.col(0) = line;
  frame.col(2) = -s.side * s.fixed_axis.dot(axis) * line.cross(s.strut_axis).normalized();
  frame.col(1) = frame.col(2).cross(line);
  frame.col(2) = line.cross(frame.col(1)).normalized();
  s.lower_axes *= frame;
  s.upper_axes *= frame;
  s.lower_lever = s.lower_axes.transpose() * -s.lower_end;
  s.upper_lever = s.upper_axes.transpose() * -s.upper_end;
  s.alike = s.lower_axes == s.upper_axes;
  s.slender = true;
}

class TreeBuilder {
 public:
  explicit TreeBuilder(const Model& model) : model_(model), ground_(model.body_count()) {
    for (const JointKind& kind : joint_kinds()) {
      for (const JointData& joint : model.joints[kind.index]) {
        if (kind.rows > 0) edges_.push_back({kind.index, joint, kind.rows, kind.branch, is_driven(joint)});
      }
    }
    std::sort(edges_.begin(), edges_.end(),
              [](const Edge& a, const Edge& b) { return a.joint.element < b.joint.element; });
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      at_[edges_[e].joint.first].push_back(e);
      at_[edges_[e].joint.second].push_back(e);
    }
  }

  BodyTree run() {
    find_struts();
    while (!span()) {
    }
    number();
    drive();
    couple();
    find_leaves();
    return std::move(tree_);
  }

 private:
  struct Pattern {
    std::size_t hinge, slide, ends[2];  // ends: at the first and at the second body of the slide
    bool used = true;
  };

  static std::size_t kind_of(const char* name) { return find_joint_kind(name)->index; }

  int other(std::size_t edge, int body) const {
    const JointData& j = edges_[edge].joint;
    return j.first == body ? j.second : j.first;
  }

  /// The only other joint of a strut's part; none when there are several.
  std::optional<std::size_t> only_other(int body, std::size_t slide) const {
    if (body == ground_) return std::nullopt;
    const auto& edges = at_.at(body);
    if (edges.size() != 2) return std::nullopt;
    return edges[0] == slide ? edges[1] : edges[0];
  }

  void find_struts() {
    static const std::size_t prismatic = kind_of("prismatic"), universal = kind_of("universal"),
                             spherical = kind_of("spherical"), revolute = kind_of("revolute");
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (edges_[e].kind != prismatic) continue;
      const JointData& slide = edges_[e].joint;
      const auto first = only_other(slide.first, e), second = only_other(slide.second, e);
      if (!first || !second) continue;
      const std::set<std::size_t> kinds = {edges_[*first].kind, edges_[*second].kind};
      if (kinds != std::set<std::size_t>{universal, spherical}) continue;
      const int a = other(*first, slide.first), b = other(*second, slide.second);
      for (std::size_t h : at_.at(a)) {
        if (edges_[h].kind != revolute || a == b || other(h, a) != b) continue;
        const Pattern p{h, e, {*first, *second}};
        if (angle_tells(p, a, b)) patterns_.push_back(p);
        break;
      }
    }
  }

  /// Whether the hinge angle tells the strut's pose in every position. Three cases are excluded. The ends
  /// come as near as they lie off the slide's line: there the stroke continues while the hinge turns back.
  /// The ends meet: the line between them has no direction. The universal joint starts with the strut in the
  /// plane of its axes: the strut is free to spin.
  bool angle_tells(const Pattern& p, int parent, int body) const {
    const Strut s = make_strut(p, parent, body);
    const TreeJoint hinge = oriented(edges_[p.hinge].joint, parent);
    const auto around = [](const Vec3d& lever, const Vec3d& axis) {
      return Eigen::Vector2d(lever.cross(axis).norm(), lever.dot(axis));
    };
    const Eigen::Vector2d base = around(s.base_point - hinge.parent_point, hinge.parent_axes.col(2)),
                          arm = around(s.arm_point - hinge.child_point, hinge.child_axes.col(2));
    const double nearest = (base - arm).norm(), farthest = std::hypot(base[0] + arm[0], base[1] - arm[1]);
    const double across = s.offset.head<2>().norm();
    return nearest > kOnLine * farthest && (across < kOnLine * s.offset.norm() || across < nearest) &&
           spin_hold(s, start(parent), start(body)) > kOnLine;
  }

  bool is_strut_part(int body) const {
    return std::any_of(patterns_.begin(), patterns_.end(), [&](const Pattern& p) {
      const JointData& slide = edges_[p.slide].joint;
      return p.used && (slide.first == body || slide.second == body);
    });
  }

  bool carries_struts(std::size_t edge) const {
    return std::any_of(patterns_.begin(), patterns_.end(),
                       [&](const Pattern& p) { return p.used && p.hinge == edge; });
  }

  /// Grows the tree. False when a hinge with struts did not become a branch: then its struts are ordinary
  /// bodies, and the tree must be grown again.
  bool span() {
    tree_ = BodyTree();
    taken_.clear();
    placed_ = {ground_};
    grow();
    for (int root = next_root(); root >= 0; root = next_root()) {
      Cluster cluster;
      cluster.parent = ground_;
      cluster.body = root;
      cluster.members = {{root, 0}};
      tree_.clusters.push_back(cluster);
      placed_.insert(root);
      grow();
    }
    bool good = true;
    for (Pattern& p : patterns_) {
      if (p.used && !taken_.count(p.hinge)) p.used = good = false;
    }
    return good;
  }

  /// A body whose motion is given, a vessel, else the heaviest body not reached yet.
  int next_root() const {
    int best = -1;
    for (int b = 0; b < ground_; ++b) {
      if (placed_.count(b) || is_strut_part(b)) continue;
      const auto rank = [&](int i) {
        const BodyModel& body = model_.bodies[idx(i)];
        return std::tuple(!motion_of(i).empty(), body.vessel >= 0, body.mass);
      };
      if (best < 0 || rank(b) > rank(best)) best = b;
    }
    return best;
  }

  void grow() {
    for (;;) {
      std::optional<std::size_t> best;
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        if (edges_[e].branch && reaches_out(e) && (!best || rank(e) > rank(*best))) best = e;
      }
      if (!best) return;
      add(*best);
    }
  }

  int rank(std::size_t e) const {
    return 2 * (edges_[e].rows + (carries_struts(e) ? kMaxRows : 0)) + (edges_[e].driven ? 1 : 0);
  }

  bool is_driven(const JointData& joint) const {
    return std::ranges::any_of(model_.drivers, [&](const DriverData& driver) {
      return driver.coordinate.joint.element == joint.element;
    });
  }

  bool reaches_out(std::size_t e) const {
    const JointData& j = edges_[e].joint;
    if (is_strut_part(j.first) || is_strut_part(j.second)) return false;
    return placed_.count(j.first) != placed_.count(j.second);
  }

  static TreeJoint oriented(const JointData& j, int parent) {
    const bool forward = j.first == parent;
    return {parent,
            forward ? j.second : j.first,
            forward ? j.first_point : j.second_point,
            forward ? j.second_point : j.first_point,
            forward ? j.first_axes : j.second_axes,
            forward ? j.second_axes : j.first_axes,
            j.parameters,
            !forward};
  }

  void add(std::size_t e) {
    const JointData& j = edges_[e].joint;
    const int parent = placed_.count(j.first) ? j.first : j.second;
    Cluster cluster;
    cluster.kind = edges_[e].kind;
    cluster.joint = oriented(j, parent);
    cluster.parent = parent;
    cluster.body = cluster.joint.child;
    cluster.element = j.element;
    cluster.members = {{cluster.body, 0}};
    with_joint_type(cluster.kind, [&]<class Type>() {
      cluster.positions = Type::Branch::positions;
      cluster.speeds = Type::Branch::speeds;
    });
    cluster.first_strut = static_cast<int>(tree_.struts.size());
    for (const Pattern& p : patterns_) {
      if (p.used && p.hinge == e) add_strut(p, cluster);
    }
    taken_.insert(e);
    placed_.insert(cluster.body);
    tree_.clusters.push_back(cluster);
  }

  Strut make_strut(const Pattern& p, int parent, int body) const {
    const JointData& slide = edges_[p.slide].joint;
    const bool forward = other(p.ends[0], slide.first) == parent;
    const TreeJoint guide = oriented(slide, forward ? slide.first : slide.second);
    const std::size_t at_base = p.ends[forward ? 0 : 1], at_arm = p.ends[forward ? 1 : 0];
    const TreeJoint base = oriented(edges_[at_base].joint, parent),
                    arm = oriented(edges_[at_arm].joint, body);
    Strut s;
    s.name = model_.elements[idx(slide.element)].name;
    s.lower = guide.parent;
    s.upper = guide.child;
    s.base_point = base.parent_point;
    s.arm_point = arm.parent_point;
    s.lower_end = base.child_point;
    s.upper_end = arm.child_point;
    s.lower_axes = guide.parent_axes;
    s.upper_axes = guide.child_axes;
    s.offset = guide.child_axes.transpose() * (arm.child_point - guide.child_point) -
               guide.parent_axes.transpose() * (base.child_point - guide.parent_point);
    s.universal_at_base =
        std::string(model_.elements[idx(edges_[at_base].joint.element)].kind) == "universal";
    const TreeJoint& universal = s.universal_at_base ? base : arm;
    s.fixed_axis = universal.parent_axes.col(2);
    const Mat3d& axes = s.universal_at_base ? guide.parent_axes : guide.child_axes;
    s.strut_axis = axes.transpose() * universal.child_axes.col(2);
    choose_branches(s, start(parent), start(body), start(s.lower));
    return s;
  }

  void add_strut(const Pattern& p, Cluster& cluster) {
    Strut s = make_strut(p, cluster.parent, cluster.body);
    s.element = edges_[p.slide].joint.element;
    s.slides_up = edges_[p.slide].joint.first == s.lower;
    if (is_slender(s, cluster.joint)) make_slender(s, cluster.joint);
    tree_.struts.push_back(s);
    ++cluster.struts;
    cluster.members.push_back({s.lower, 0});
    cluster.members.push_back({s.upper, 0});
    for (std::size_t e : {p.slide, p.ends[0], p.ends[1]}) taken_.insert(e);
    placed_.insert(s.lower);
    placed_.insert(s.upper);
  }

  BodyKinematics<double> start(int body) const {
    BodyKinematics<double> k = BodyKinematics<double>::ground();
    if (body == ground_) return k;
    const double* pose = model_.initial_state.data() + model_.layout.pose(body);
    k.position = view<3>(pose);
    k.rotation = model_.description.orientation == Orientation::quaternion
                     ? rotation_from_quaternion<double>(view<4>(pose + 3))
                     : rotation_from_euler_xyz<double>(view<3>(pose + 3));
    return k;
  }

  void number() {
    for (Cluster& c : tree_.clusters) {
      c.q = tree_.positions;
      c.u = tree_.speeds;
      tree_.positions += c.positions;
      tree_.speeds += c.speeds;
      for (Member& m : c.members) {
        m.column = tree_.columns;
        tree_.columns += c.speeds;
      }
    }
    std::set<int> branches;
    for (std::size_t e : taken_) branches.insert(edges_[e].joint.element);
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      const int element = static_cast<int>(e);
      if (model_.elements[e].rows == 0 || branches.count(element)) continue;
      tree_.loops.push_back(element);
      tree_.loop_rows += model_.elements[e].rows;
    }
  }

  /// Takes drivers of the tree's own coordinates from the rows, the first of two that drive one cluster,
  /// unless nothing else moves: an integrator needs an unknown.
  void drive() {
    const BodyTree rows = tree_;
    for (std::size_t d = 0; d < model_.drivers.size(); ++d) {
      const std::optional<TreeCoordinate> place = find_coordinate(model_.drivers[d].coordinate, tree_);
      if (!place) continue;
      Cluster& c = tree_.clusters[place->cluster];
      if (c.is_driven() || (place->strut >= 0 && !tells_angle(c, place->strut))) continue;
      lead(c, {{static_cast<int>(d)}, place->strut, place->sign});
    }
    for (Cluster& c : tree_.clusters) {
      if (c.kind != Cluster::floating) continue;
      std::vector<int> drivers = motion_of(c.body);
      if (!drivers.empty()) lead(c, {std::move(drivers), -1, 1.0});
    }
    if (tree_.driven == tree_.speeds) tree_ = rows;
  }

  /// The drivers of all six motions of a body over the ground; none unless all are driven.
  std::vector<int> motion_of(int body) const {
    for (const JointData& joint : model_.joints[kind_of("free")]) {
      if (joint.first != ground_ || joint.second != body) continue;
      std::vector<int> drivers = drivers_of(joint);
      if (std::ranges::none_of(drivers, [](int d) { return d < 0; })) return drivers;
    }
    return {};
  }

  void lead(Cluster& c, Drive drive) {
    c.drive = std::move(drive);
    tree_.driven += c.speeds;
    for (const int d : c.drive.drivers) {
      const int element = model_.drivers[idx(d)].element;
      tree_.loop_rows -= model_.elements[idx(element)].rows;
      std::erase(tree_.loops, element);
    }
  }

  /// Of x, y, z, roll, pitch, yaw; -1: none.
  std::vector<int> drivers_of(const JointData& free) const {
    std::vector<int> out(6, -1);
    for (std::size_t d = 0; d < model_.drivers.size(); ++d) {
      const CoordinateData& of = model_.drivers[d].coordinate;
      const int place = static_cast<int>(of.kind) - static_cast<int>(CoordinateKind::x);
      if (of.joint.element == free.element && place >= 0) out[idx(place)] = static_cast<int>(d);
    }
    return out;
  }

  /// Whether a strut's stroke tells the hinge angle where it starts: not at a dead centre.
  bool tells_angle(const Cluster& c, int strut) const {
    constexpr double kDeadCentre = 1e-3;  // rad
    const BodyKinematics<double> parent = start(c.parent), child = start(c.body);
    double angle = 0.0, rate = 0.0;
    with_joint_type(c.kind, [&]<class Type>() {
      if constexpr (Type::Branch::speeds == 1) Type::Branch::read(c.joint, parent, child, &angle, &rate);
    });
    return std::abs(DrivenStroke(tree_.struts[idx(strut)], c.joint).sine(angle)) > kDeadCentre;
  }

  /// The vessels of a group float by themselves, each the root of its tree.
  void couple() {
    for (std::size_t g = 0; g < model_.groups.size(); ++g) {
      if (model_.groups[g].pairs.empty()) continue;
      CoupledRoots roots{g, {}};
      for (const int v : model_.groups[g].vessels) {
        const int body = model_.vessels[idx(v)].body;
        const auto root = std::ranges::find_if(tree_.clusters, [&](const Cluster& c) {
          return c.kind == Cluster::floating && c.body == body && !c.is_driven();
        });
        if (root == tree_.clusters.end()) {
          tree_.refused = "vessel '" + model_.description.vessels[idx(v)].name + "' of group '" +
                          model_.description.groups[g].name +
                          "' does not float freely: its motion is given, or a joint ties it to another body";
          return;
        }
        roots.clusters.push_back(static_cast<std::size_t>(root - tree_.clusters.begin()));
      }
      tree_.coupled.push_back(roots);
    }
  }

  void find_leaves() {
    std::set<int> parents;
    for (const Cluster& c : tree_.clusters) parents.insert(c.parent);
    for (Cluster& c : tree_.clusters) {
      for (Member& m : c.members) m.leaf = !model_.bodies[idx(m.body)].full && !parents.count(m.body);
    }
  }

  const Model& model_;
  int ground_;
  std::vector<Edge> edges_;
  std::map<int, std::vector<std::size_t>> at_;  // edges by body
  std::vector<Pattern> patterns_;
  std::set<std::size_t> taken_;
  std::set<int> placed_;
  BodyTree tree_;
};

}  // namespace

std::vector<double> BodyTree::scales(double length, double angle) const {
  std::vector<double> out(idx(positions + speeds));
  const auto fill = [&](int at, const char* kinds) {
    for (; *kinds; ++kinds) out[idx(at++)] = *kinds == 'l' ? length : angle;
  };
  for (const Cluster& c : clusters) {
    if (c.kind == Cluster::floating) {
      fill(c.q, "lllaaaa");
      fill(positions + c.u, "lllaaa");
      continue;
    }
    with_joint_type(c.kind, [&]<class Type>() {
      fill(c.q, Type::Branch::position_kinds);
      fill(positions + c.u, Type::Branch::speed_kinds);
    });
  }
  return out;
}

BodyTree build_tree(const Model& model) { return TreeBuilder(model).run(); }

std::vector<std::size_t> links_of(const BodyTree& tree) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < tree.clusters.size(); ++i) {
    if (with_held(tree.clusters[i], []<class Branch>() {})) out.push_back(i);
  }
  return out;
}

std::vector<int> roots_of(const BodyTree& tree, int bodies) {
  std::vector<int> out(idx(bodies) + 1, -1);
  int count = 0;
  const auto coupled = [&](std::size_t cluster) {
    for (const CoupledRoots& roots : tree.coupled) {
      if (std::ranges::find(roots.clusters, cluster) == roots.clusters.end()) continue;
      for (const std::size_t other : roots.clusters) {
        if (other < cluster) return out[idx(tree.clusters[other].body)];
      }
    }
    return -1;
  };
  for (std::size_t i = 0; i < tree.clusters.size(); ++i) {
    const Cluster& c = tree.clusters[i];
    const bool root = c.kind == Cluster::floating || c.parent == bodies;
    int of = root ? coupled(i) : out[idx(c.parent)];
    if (root && of < 0) of = count++;
    for (const Member& m : c.members) out[idx(m.body)] = of;
  }
  return out;
}

}  // namespace seacrane
