#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/dynamics/recursive/body_tree.hpp"

namespace seacrane {

/// Forward kinematics of a tree of clusters, inertial axes: ArticulatedTree::place() as a template on the
/// scalar, so that the recursions can be differentiated. Writes what the recursions need: per column the
/// body's velocity per unit speed, per body the way from the parent's state point and the acceleration with
/// udot = 0 and the parent at rest.
template <class T>
struct TreeKinematics {
  const BodyTree& tree;
  std::vector<Vec6<T>>& column;
  std::vector<Vec3<T>>& reach;
  std::vector<Vec6<T>>& bias;

  /// Poses and twists of all bodies from positions q and speeds u; `bodies` ends with the ground.
  void place(const T* q, const T* u, BodyKinematics<T>* bodies) const {
    for (const Cluster& c : tree.clusters) {
      if (c.kind == Cluster::floating) {
        place_floating(c, q + c.q, u + c.u, bodies[c.body]);
      } else {
        place_joint(c, q + c.q, u + c.u, bodies);
      }
    }
  }

  /// Rates of the positions for speeds u and the bodies' angular velocities.
  void position_rates(const T* q, const T* u, const BodyKinematics<T>* bodies, T* q_rate) const {
    for (const Cluster& c : tree.clusters) {
      if (c.kind == Cluster::floating) {
        std::copy_n(u + c.u, 3, q_rate + c.q);
        branch::turn<T>(q + c.q + 3, branch::vector(u + c.u + 3), q_rate + c.q + 3);
      } else {
        with_joint_type(c.kind, [&]<class Type>() {
          Type::Branch::rates(bodies[c.parent], q + c.q, u + c.u, q_rate + c.q);
        });
      }
    }
  }

 private:
  void place_floating(const Cluster& c, const T* q, const T* u, BodyKinematics<T>& k) const {
    k.position = branch::vector(q);
    k.rotation = rotation_from_quaternion<T>(branch::quaternion(q + 3));
    k.velocity = branch::vector(u);
    k.angular_velocity = branch::vector(u + 3);
    for (int i = 0; i < 6; ++i) column[idx(c.members[0].column + i)] = Vec6<T>::Unit(i);
  }

  void place_joint(const Cluster& c, const T* q, const T* u, BodyKinematics<T>* bodies) const {
    const BodyKinematics<T>& parent = bodies[c.parent];
    BranchMotionOf<T> motion;
    with_joint_type(c.kind, [&]<class Type>() { Type::Branch::move(c.joint, parent, q, u, motion); });
    const Vec3<T> lever = motion.rotation * -c.joint.child_point.template cast<T>();
    place_member(c.members[0], parent, motion, lever, c.speeds, u, bodies[c.body]);
    if (c.struts > 0) place_struts(c, motion, u[0], bodies);
  }

  /// Both parts of a strut turn alike; the lower one is held at its end, the upper one moves with the arm.
  void place_struts(const Cluster& c, const BranchMotionOf<T>& hinge, const T& rate,
                    BodyKinematics<T>* bodies) const {
    const BodyKinematics<T>& parent = bodies[c.parent];
    for (int i = 0; i < c.struts; ++i) {
      const Strut& s = tree.struts[idx(c.first_strut + i)];
      const Vec3d on_arm = s.arm_point - c.joint.child_point;
      const Vec3<T> arm = hinge.rotation * on_arm.cast<T>();
      const StrutMotionOf<T> m =
          move_strut<T>(s, parent.rotation, hinge.rotation, hinge.reach, hinge.turn[0], arm);
      BranchMotionOf<T> part;
      part.turn[0] = m.turn;
      part.turn_bias = rate * rate * m.turn_bend;
      part.rotation = m.rotation * s.lower_axes.transpose().cast<T>();
      part.reach = parent.rotation * s.base_point.cast<T>();
      part.slide[0] = Vec3<T>::Zero();
      const Vec3<T> lower_lever = part.rotation * -s.lower_end.cast<T>();
      place_member(c.members[idx(1 + 2 * i)], parent, part, lower_lever, 1, &rate, bodies[s.lower]);
      part.rotation = m.rotation * s.upper_axes.transpose().cast<T>();
      part.reach = m.end;
      part.slide[0] = m.end_rate;
      part.slide_bias = rate * rate * m.end_bend;
      const Vec3<T> upper_lever = part.rotation * -s.upper_end.cast<T>();
      place_member(c.members[idx(2 + 2 * i)], parent, part, upper_lever, 1, &rate, bodies[s.upper]);
    }
  }

  void place_member(const Member& m, const BodyKinematics<T>& parent, const BranchMotionOf<T>& motion,
                    const Vec3<T>& lever, int speeds, const T* u, BodyKinematics<T>& body) const {
    Vec3<T> slide = Vec3<T>::Zero(), turn = Vec3<T>::Zero();
    for (int i = 0; i < speeds; ++i) {
      Vec6<T>& s = column[idx(m.column + i)];
      const Vec3<T> linear = motion.slide[i] + cross<T>(motion.turn[i], lever);
      s << linear, motion.turn[i];
      slide += u[i] * linear;
      turn += u[i] * motion.turn[i];
    }
    const Vec3<T>& w = parent.angular_velocity;
    const Vec3<T> way = motion.reach + lever;
    reach[idx(m.body)] = way;
    body.rotation = motion.rotation;
    body.position = parent.position + way;
    const Vec3<T> swept = cross<T>(w, way);
    body.velocity = parent.velocity + swept + slide;
    body.angular_velocity = w + turn;
    // Centripetal, Coriolis, and what the joint's own directions turn.
    const Vec3<T> carried = swept + T(2) * slide, swung = cross<T>(turn, lever);
    bias[idx(m.body)] << cross<T>(w, carried) + motion.slide_bias + cross<T>(motion.turn_bias, lever) +
                             cross<T>(turn, swung),
        cross<T>(w, turn) + motion.turn_bias;
  }
};

}  // namespace seacrane
