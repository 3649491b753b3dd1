#pragma once

#include <vector>

#include "seacrane/dynamics/recursive/body_tree.hpp"

namespace seacrane {

/// Forward kinematics of a tree of clusters, inertial axes, on any scalar. Keeps what the recursions of the
/// dynamics need: each body's twist per unit speed, its reach, the way to its state point from its parent's,
/// and its bias, the acceleration that it has with udot = 0 and the parent at rest. Nothing is allocated
/// after construction.
template <class T>
class TreeKinematics {
 public:
  TreeKinematics(const BodyTree& tree, int bodies)
      : tree_(tree),
        column_(idx(tree.columns), Twist<T>::zero()),
        over_parent_(idx(bodies), {Vec3<T>::Zero(), Twist<T>::zero()}),
        stroke_(tree.struts.size()) {}

  /// Poses and twists of all bodies from positions q and speeds u; `bodies` ends with the ground.
  void place(const T* q, const T* u, BodyKinematics<T>* bodies) {
    for (const Cluster& c : tree_.clusters) {
      if (c.kind == Cluster::floating) {
        place_floating(c, q + c.q, u + c.u, bodies[c.body]);
      } else {
        place_joint(c, q + c.q, u + c.u, bodies);
      }
    }
  }

  /// Rates of the positions for speeds u (which need not be those of place()) and the bodies' angular
  /// velocities that go with them.
  void position_rates(const T* q, const T* u, const BodyKinematics<T>* bodies, T* q_rate) const;

  const BodyTree& tree() const { return tree_; }
  /// Twists of a body per unit speed of its cluster, its parent at rest, at the last place().
  const Twist<T>* columns(const Member& m) const { return column_.data() + m.column; }
  /// Of a body over its parent, at the last place(): the way from state point to state point, and its bias.
  struct OverParent {
    Vec3<T> reach;
    Twist<T> bias;
  };
  const OverParent& over_parent(int body) const { return over_parent_[idx(body)]; }
  /// The stroke of a strut, and its derivative in the hinge angle, at the last place().
  struct Stroke {
    T value, slope;
  };
  const Stroke& stroke(int strut) const { return stroke_[idx(strut)]; }

 private:
  void place_floating(const Cluster& c, const T* q, const T* u, BodyKinematics<T>& k) {
    k.position = branch::vector(q);
    k.rotation = rotation_from_quaternion<T>(branch::quaternion(q + 3));
    k.velocity = branch::vector(u);
    k.angular_velocity = branch::vector(u + 3);
    for (int i = 0; i < 6; ++i) column_[idx(c.members[0].column + i)] = Twist<T>::unit(i);
  }

  void place_joint(const Cluster& c, const T* q, const T* u, BodyKinematics<T>* bodies);

  void place_struts(const Cluster& c, const BranchMotionOf<T>& hinge, const T& rate,
                    BodyKinematics<T>* bodies) {
    const BodyKinematics<T>& parent = bodies[c.parent];
    for (int i = 0; i < c.struts; ++i) {
      const Strut& s = tree_.struts[idx(c.first_strut + i)];
      const Vec3d on_arm = s.arm_point - c.joint.child_point;
      const Vec3<T> arm = times<T>(hinge.rotation, on_arm);
      const Vec3<T> lower = times<T>(parent.rotation, s.base_point);
      const Member* const parts = &c.members[idx(1 + 2 * i)];
      Stroke& stroke = stroke_[idx(c.first_strut + i)];
      if (s.slender) {
        const auto m = move_slender_strut<T>(s, lower, hinge.reach, hinge.turn[0], arm);
        stroke = {m.stroke, m.stroke_rate};
        place_parts(s, parts, parent, m, hinge.turn[0], lower, rate, bodies);
      } else {
        const auto m = move_strut<T>(s, parent.rotation, hinge.rotation, hinge.reach, hinge.turn[0], arm);
        stroke = {m.stroke, m.stroke_rate};
        place_parts(s, parts, parent, m, lower, rate, bodies);
      }
    }
  }

  /// Both parts of a strut turn alike; the lower one is held at its end, the upper one moves with the arm.
  void place_parts(const Strut& s, const Member* parts, const BodyKinematics<T>& parent,
                   const StrutMotionOf<T>& m, const Vec3<T>& lower, const T& rate,
                   BodyKinematics<T>* bodies) {
    BranchMotionOf<T> part;
    part.turn[0] = m.turn;
    part.turn_bias = rate * rate * m.turn_bend;
    part.rotation = times_transpose<T>(m.rotation, s.lower_axes);
    part.reach = lower;
    part.slide[0] = Vec3<T>::Zero();
    const Vec3d to_lower = -s.lower_end, to_upper = -s.upper_end;
    const Vec3<T> lower_lever = times<T>(part.rotation, to_lower);
    place_member<1>(parts[0], parent, part, lower_lever, &rate, bodies[s.lower]);
    part.rotation = times_transpose<T>(m.rotation, s.upper_axes);
    part.reach = m.end;
    part.slide[0] = m.end_rate;
    part.slide_bias = rate * rate * m.end_bend;
    const Vec3<T> upper_lever = times<T>(part.rotation, to_upper);
    place_member<1>(parts[1], parent, part, upper_lever, &rate, bodies[s.upper]);
  }
  void place_parts(const Strut& s, const Member* parts, const BodyKinematics<T>& parent,
                   const SlenderMotionOf<T>& m, const Vec3<T>& axis, const Vec3<T>& lower, const T& rate,
                   BodyKinematics<T>* bodies) {
    BodyKinematics<T>&at_lower = bodies[s.lower], &at_upper = bodies[s.upper];
    Mat3<T> rotation;
    for (int i = 0; i < 3; ++i) {
      rotation(i, 0) = m.along[i], rotation(i, 1) = m.across[i], rotation(i, 2) = axis[i];
    }
    at_lower.rotation = times_transpose<T>(rotation, s.lower_axes);
    at_upper.rotation = s.alike ? at_lower.rotation : times_transpose<T>(rotation, s.upper_axes);
    const T square = rate * rate;
    const auto place = [&](const Member& part, const Vec3<T>& from, const Vec3d& to_part, bool moves,
                           BodyKinematics<T>& body) {
      const Vec3<T> lever = times<T>(rotation, to_part), sideways = cross<T>(axis, lever);
      Twist<T>& column = column_[idx(part.column)];
      column = {m.turn * sideways, m.turn * axis};
      Twist<T> bias{square * (m.turn_bend * sideways + m.turn * m.turn * cross<T>(axis, sideways)),
                    (square * m.turn_bend) * axis};
      if (moves) {
        column.linear() += m.end_rate;
        bias.linear() += square * m.end_bend;
      }
      const Vec3<T> slide = rate * column.linear(), turn = rate * column.angular();
      carry(part, parent, from + lever, slide, turn, bias, body);
    };
    place(parts[0], lower, s.lower_lever, false, at_lower);
    place(parts[1], m.end, s.upper_lever, true, at_upper);
  }

  /// A body whose joint point moves over its parent as `motion` says; `lever` leads from there to its state
  /// point.
  template <int speeds>
  void place_member(const Member& m, const BodyKinematics<T>& parent, const BranchMotionOf<T>& motion,
                    const Vec3<T>& lever, const T* u, BodyKinematics<T>& body) {
    Vec3<T> slide = Vec3<T>::Zero(), turn = Vec3<T>::Zero();
    for (int i = 0; i < speeds; ++i) {
      Twist<T>& column = column_[idx(m.column + i)];
      column.linear() = motion.slide[i] + cross<T>(motion.turn[i], lever);
      column.angular() = motion.turn[i];
      slide += u[i] * column.linear();
      turn += u[i] * motion.turn[i];
    }
    // What the joint's own directions turn.
    const Vec3<T> swung = cross<T>(turn, lever);
    const Twist<T> bias{motion.slide_bias + cross<T>(motion.turn_bias, lever) + cross<T>(turn, swung),
                        motion.turn_bias};
    body.rotation = motion.rotation;
    carry(m, parent, motion.reach + lever, slide, turn, bias, body);
  }

  /// The child of a hinge.
  void place_hinged(const Member& m, const BodyKinematics<T>& parent, const BranchMotionOf<T>& motion,
                    const Vec3<T>& lever, const T& rate, BodyKinematics<T>& body) {
    const Vec3<T>& axis = motion.turn[0];
    Twist<T>& column = column_[idx(m.column)];
    column = {cross<T>(axis, lever), axis};
    const Vec3<T> slide = rate * column.linear(), turn = rate * axis;
    const Twist<T> bias{cross<T>(turn, slide), Vec3<T>::Zero()};
    body.rotation = motion.rotation;
    carry(m, parent, motion.reach + lever, slide, turn, bias, body);
  }

  /// A body at `reach` from its parent that moves over it at the rates `slide` and `turn`; its bias is
  /// `own` with the parent at rest, centripetal and Coriolis terms beside.
  [[gnu::always_inline]] void carry(const Member& m, const BodyKinematics<T>& parent, const Vec3<T>& reach,
                                    const Vec3<T>& slide, const Vec3<T>& turn, const Twist<T>& own,
                                    BodyKinematics<T>& body) {
    const Vec3<T>& w = parent.angular_velocity;
    const Vec3<T> swept = cross<T>(w, reach), carried = swept + T(2) * slide;
    body.position = parent.position + reach;
    body.velocity = parent.velocity + swept + slide;
    body.angular_velocity = w + turn;
    OverParent& over = over_parent_[idx(m.body)];
    over.reach = reach;
    over.bias = {cross<T>(w, carried) + own.linear(), cross<T>(w, turn) + own.angular()};
  }

  const BodyTree& tree_;
  std::vector<Twist<T>> column_;         // by Member::column
  std::vector<OverParent> over_parent_;  // by body
  std::vector<Stroke> stroke_;
};

}  // namespace seacrane
