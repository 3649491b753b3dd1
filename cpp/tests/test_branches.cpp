#include <doctest/doctest.h>

#include "multibody_scenes.hpp"
#include "seacrane/dynamics/recursive/body_tree.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/elements/joints/registry.hpp"

namespace seacrane::test {
namespace {

/// A pin of the second body in a slot of the first, along x_a: d . y_a = d . z_a = 0, z_b parallel to z_a.
/// The slot turns with the first body alone: seen from the pin, the other body slides along its own axis.
template <bool knows_direction>
struct PinInSlot : JointDefaults {
  static constexpr const char* kind = "pin in a slot";
  static constexpr int rows = 4;

  static JointDescription example(Random& random) { return example_joint<PinInSlot>(random); }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& /*joint*/, RowBlock<T>& out) {
    rows::along<T>(g, g.a.col(1), out, 0);
    rows::along<T>(g, g.a.col(2), out, 1);
    rows::parallel_z(g, out, 2);
  }

  struct Branch : branch::ScalarRates<2> {
    static constexpr int positions = 2, speeds = 2;
    static constexpr const char *position_kinds = "la", *speed_kinds = "la";

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* u,
                     BranchMotionOf<T>& out) {
      const Mat3<T> a = branch::parent_axes(j, parent), b = branch::turn_about_z<T>(a, q[1]);
      const Vec3<T> z = a.col(2), lever = branch::parent_lever(j, parent);
      out.rotation = b * j.child_axes.transpose().template cast<T>();
      out.turn[0] = out.slide[1] = Vec3<T>::Zero();
      out.turn[1] = z;
      if (knows_direction && j.reversed) {
        const Vec3<T> slot = b.col(0), across = cross<T>(z, slot);
        out.reach = lever - q[0] * slot;
        out.slide[0] = -slot;
        out.slide[1] = -q[0] * across;
        out.slide_bias = q[0] * u[1] * u[1] * slot - T(2) * u[0] * u[1] * across;
      } else {
        out.reach = lever + q[0] * a.col(0);
        out.slide[0] = a.col(0);
      }
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const Mat3d a = branch::parent_axes(j, parent), b = branch::child_axes(j, child);
      const branch::Gap gap(j, parent, child);
      const bool back = knows_direction && j.reversed;
      const Vec3d slot = back ? Vec3d(-b.col(0)) : Vec3d(a.col(0));
      q[0] = slot.dot(gap.offset);
      q[1] = branch::turned(a, b);
      u[0] = slot.dot(gap.rate);
      u[1] = a.col(2).dot(gap.turning);
    }
  };
};

/// A closed joint of a type, and as the tree has it with either body as its parent.
template <class Type>
struct Joined {
  JointData rows;
  TreeJoint tree;

  Joined(Random& random, bool reversed) {
    const JointDescription d = Type::example(random);
    const JointKind* const kind = find_joint_kind(Type::kind);
    const Frame &parent = reversed ? d.second_frame : d.first_frame,
                &child = reversed ? d.first_frame : d.second_frame;
    rows = {0, 1, d.first_frame.point, d.second_frame.point, d.first_frame.axes, d.second_frame.axes};
    if (kind != nullptr) rows.parameters = kind->values(d);
    tree = {0, 1, parent.point, child.point, parent.axes, child.axes, rows.parameters, reversed};
  }
};

template <class Type>
BranchMotion motion(const TreeJoint& joint, const BodyKinematics<double>& parent, const VecXd& q,
                    const VecXd& u) {
  BranchMotion out;
  Type::Branch::template move<double>(joint, parent, q.data(), u.data(), out);
  return out;
}

Vec3d sum(const Vec3d* columns, const VecXd& u) {
  Vec3d out = Vec3d::Zero();
  for (Eigen::Index k = 0; k < u.size(); ++k) out += u[k] * columns[k];
  return out;
}

BodyKinematics<double> child_of(const TreeJoint& joint, const BodyKinematics<double>& parent,
                                const BranchMotion& m, const VecXd& u) {
  BodyKinematics<double> out = BodyKinematics<double>::ground();
  out.rotation = m.rotation;
  const Vec3d lever = m.rotation * joint.child_point;
  out.position = parent.position + m.reach - lever;
  out.angular_velocity = parent.angular_velocity + sum(m.turn, u);
  out.velocity = parent.velocity + parent.angular_velocity.cross(m.reach) + sum(m.slide, u) -
                 out.angular_velocity.cross(lever);
  return out;
}

struct Violation {
  double rows = 0.0;   // residual, and its rate
  double bias = 0.0;   // of the rates, beside differences
  double again = 0.0;  // pose and twist, after reading the coordinates from them
};

VecXd random_numbers(Random& random, int count) {
  VecXd out(count);
  for (double& value : out) value = random.number();
  return out;
}

/// The largest over random coordinates, by which a branch violates the rows of its joint, or itself.
template <class Type>
Violation violation(Random& random, bool reversed) {
  using Branch = typename Type::Branch;
  Violation out;
  for (int trial = 0; trial < 10; ++trial) {
    const Joined<Type> joint(random, reversed);
    const BodyKinematics<double> parent = random.kinematics();
    const VecXd q = random_numbers(random, Branch::positions), u = random_numbers(random, Branch::speeds);
    const BodyKinematics<double> child =
        child_of(joint.tree, parent, motion<Type>(joint.tree, parent, q, u), u);
    const BodyKinematics<double>&a = reversed ? child : parent, &b = reversed ? parent : child;
    RowBlock<double> rows;
    Type::template evaluate<double>(JointGeometry<double>(joint.rows, a, b), joint.rows, rows);
    out.rows = std::max({out.rows, rows.phi.norm(), (rows.d[0] * twist(a) + rows.d[1] * twist(b)).norm()});

    BodyKinematics<double> still = parent;
    still.velocity = still.angular_velocity = Vec3d::Zero();
    VecXd q_rate(q.size());
    Branch::rates(still, q.data(), u.data(), q_rate.data());
    const BranchMotion m = motion<Type>(joint.tree, still, q, u);
    const auto rates = [&](double t) -> Vec6d {
      const BranchMotion there = motion<Type>(joint.tree, still, VecXd(q + t * q_rate), u);
      return (Vec6d() << sum(there.slide, u), sum(there.turn, u)).finished();
    };
    const Vec6d bias = (Vec6d() << m.slide_bias, m.turn_bias).finished();
    out.bias = std::max(out.bias, (slope(rates) - bias).norm());

    VecXd q_back(q.size()), u_back(u.size());
    Branch::read(joint.tree, parent, child, q_back.data(), u_back.data());
    const auto again = child_of(joint.tree, parent, motion<Type>(joint.tree, parent, q_back, u_back), u_back);
    out.again = std::max({out.again, (again.position - child.position).norm(),
                          (again.rotation - child.rotation).norm(), (twist(again) - twist(child)).norm()});
  }
  return out;
}

template <class Type>
void check_both_ways(Random& random) {
  CAPTURE(std::string(Type::kind));
  CHECK(Type::Branch::speeds == 6 - Type::rows);
  for (const bool reversed : {false, true}) {
    CAPTURE(reversed);
    const Violation found = violation<Type>(random, reversed);
    CHECK(found.rows < 1e-12);
    CHECK(found.bias < kDifference);
    CHECK(found.again < 1e-12);
  }
}

}  // namespace

TEST_CASE("every branch holds the rows of its joint, whichever of the two bodies is its parent") {
  Random random(21);
  for_each_joint_type([&]<class Type>(std::size_t) {
    if constexpr (requires { typename Type::Branch; }) check_both_ways<Type>(random);
  });
}

TEST_CASE("a branch of a joint whose bodies are not alike holds both ways where it asks for the direction") {
  Random random(22);
  check_both_ways<PinInSlot<true>>(random);
  CHECK(violation<PinInSlot<false>>(random, false).rows < 1e-12);
  CHECK(violation<PinInSlot<false>>(random, true).rows > 0.1);
}

TEST_CASE("the tree tells a branch that its parent is the joint's second body") {
  Random random(23);
  for (const bool reversed : {false, true}) {
    SceneDescription scene;
    scene.bodies = {body_at("base", 9.0, Vec3d::Zero()), body_at("arm", 1.0, {1.0, 0.0, 0.0})};
    join(scene, "revolute", "pin", reversed ? "arm" : "base", reversed ? "base" : "arm", {0.5, 0.0, 0.0});
    const BodyTree tree = build_tree(*compile(scene));
    CHECK(tree.clusters.back().body == 1);
    CHECK(tree.clusters.back().joint.reversed == reversed);
  }
}

}  // namespace seacrane::test
