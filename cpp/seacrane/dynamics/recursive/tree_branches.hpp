#pragma once

#include <algorithm>
#include <ranges>
#include <vector>

#include "seacrane/dynamics/recursive/articulated.hpp"
#include "seacrane/elements/joints/registry.hpp"

/// What of a tree knows the types of joints: for those who instantiate its templates.
namespace seacrane {

/// Calls f.template operator()<Type>() for the joint type of a cluster with a joint.
template <class F>
void with_joint_type(std::size_t kind, F&& f) {
  for_each_joint_type([&]<class Type>(std::size_t i) {
    if constexpr (requires { typename Type::Branch; }) {
      static_assert(Type::Branch::speeds < kMostSpeeds, "a joint that holds nothing is no branch");
      if (i == kind) f.template operator()<Type>();
    }
  });
}

template <class T>
inline void TreeKinematics<T>::position_rates(const T* q, const T* u, const BodyKinematics<T>* bodies,
                                              T* q_rate) const {
  for (const Cluster& c : tree_.clusters) {
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

template <class T>
inline void TreeKinematics<T>::place_joint(const Cluster& c, const T* q, const T* u,
                                           BodyKinematics<T>* bodies) {
  const BodyKinematics<T>& parent = bodies[c.parent];
  BranchMotionOf<T> motion;
  with_joint_type(c.kind, [&]<class Type>() {
    Type::Branch::move(c.joint, parent, q, u, motion);
    const Vec3d inwards = -c.joint.child_point;
    const Vec3<T> lever = times<T>(motion.rotation, inwards);
    if constexpr (requires { Type::Branch::turns_alone; }) {
      place_hinged(c.members[0], parent, motion, lever, u[0], bodies[c.body]);
    } else {
      place_member<Type::Branch::speeds>(c.members[0], parent, motion, lever, u, bodies[c.body]);
    }
  });
  if (c.struts > 0) place_struts(c, motion, u[0], bodies);
}

/// Calls f.template operator()<n>() for the number of speeds of a cluster: kMostSpeeds for a body that
/// floats, fewer for a joint.
template <class F>
void with_speeds(const Cluster& c, F&& f) {
  static_assert(kMostSpeeds == 6);
  if (c.kind == Cluster::floating) return f.template operator()<6>();
  switch (c.speeds) {
    case 0:
      return f.template operator()<0>();
    case 1:
      return f.template operator()<1>();
    case 2:
      return f.template operator()<2>();
    case 3:
      return f.template operator()<3>();
    case 4:
      return f.template operator()<4>();
    case 5:
      return f.template operator()<5>();
  }
}

/// A joint type whose branch tells the one direction that it holds.
template <class Branch>
concept HoldsOneDirection = requires {
  Branch::holds_one_direction;
};

/// Calls f.template operator()<Branch>() for a cluster whose joint holds one direction; whether it is one.
template <class F>
bool with_held(const Cluster& c, F&& f) {
  if (c.speeds != kMostSpeeds - 1) return false;
  bool found = false;
  with_joint_type(c.kind, [&]<class Type>() {
    if constexpr (HoldsOneDirection<typename Type::Branch>) {
      f.template operator()<typename Type::Branch>();
      found = true;
    }
  });
  return found;
}

template <class T>
void ArticulatedTree<T>::read(const BodyKinematics<T>* bodies, T* q, T* u) const {
  for (const Cluster& c : clusters()) {
    const BodyKinematics<T>& k = bodies[c.body];
    if (c.kind == Cluster::floating) {
      view<3>(q + c.q) = k.position;
      view<4>(q + c.q + 3) = quaternion_from_rotation(k.rotation);
      view<3>(u + c.u) = k.velocity;
      view<3>(u + c.u + 3) = k.angular_velocity;
    } else {
      with_joint_type(
          c.kind, [&]<class Type>() { Type::Branch::read(c.joint, bodies[c.parent], k, q + c.q, u + c.u); });
    }
  }
}

template <class T>
void ArticulatedTree<T>::factor(bool coupled) {
  for (std::size_t i = clusters().size(); i-- > 0;) {
    const Cluster& c = clusters()[i];
    Joint& joint = joints_[i];
    if (with_held(c, [&]<class Branch>() { factor_held<Branch>(c, joint); })) continue;
    with_speeds(c, [&]<int n>() { factor_cluster<n>(c, joint); });
  }
  for (Coupled& roots : coupled_) factor(roots, coupled);
}

template <class T>
void ArticulatedTree<T>::factor(Coupled& roots, bool with_water) {
  const int count = roots.mass.count();
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      if (with_water) {
        roots.mass.set(i, j, roots.coupling[idx(i * count + j)]);
      } else {
        roots.mass.set(i, j, Mat6<T>::Zero());
      }
    }
    roots.mass.set(i, i, bodies_[idx(clusters()[roots.clusters[idx(i)]].body)].whole().matrix());
  }
  roots.mass.factor();
}

/// Accelerations of the roots for the loads that gather() left in their joints.
template <class T>
void ArticulatedTree<T>::solve(Coupled& roots) {
  for (std::size_t i = 0; i < roots.clusters.size(); ++i) roots.motion[i] = joints_[roots.clusters[i]].torque;
  roots.mass.solve(roots.motion.data());
  for (std::size_t i = 0; i < roots.clusters.size(); ++i) joints_[roots.clusters[i]].torque = roots.motion[i];
}

template <class T>
T ArticulatedTree<T>::condition(const Mat6<T>* mass) const {
  // Inertias at a parent, children added in full, over what is left when these yield in their joints.
  std::vector<SpatialInertia<T>> gross(idx(ground_) + 1, SpatialInertia<T>::zero());
  for (int b = 0; b < ground_; ++b) gross[idx(b)] = SpatialInertia<T>(mass[b]);
  std::vector<T> pivots(gross.size(), T(1));  // largest of a parent's joints
  T worst = T(1);
  for (const Cluster& c : clusters()) {
    if (c.kind == Cluster::floating) continue;
    T& pivot = pivots[idx(c.parent)];
    with_speeds(c, [&]<int n>() {
      Mat<n> gram = Mat<n>::Zero();
      for (const Member& m : c.members) {
        const SpatialInertia<T> own = bodies_[idx(m.body)].whole();
        const Twist<T>* const column = kinematics_.columns(m);
        for (int k = 0; k < n; ++k) {
          for (int l = k; l < n; ++l) gram(l, k) += dot(column[l], own * column[k]);
        }
      }
      if constexpr (n > 0) {
        if (c.is_driven()) return;
        const Mat<n> inverse = spd_inverse<n>(gram);
        for (int k = 0; k < n; ++k) pivot = std::max<T>(pivot, gram(k, k) * inverse(k, k));
      }
    });
    worst = std::max(worst, pivot);
    for (const Member& m : c.members) {
      gross[idx(c.parent)].add_shifted_from(kinematics_.over_parent(m.body).reach,
                                            bodies_[idx(m.body)].whole());
    }
  }
  for (int b = 0; b < ground_; ++b) {
    const Mat6<T> inverse = spd_inverse(bodies_[idx(b)].whole().matrix());
    const T cancelled = gross[idx(b)].matrix().diagonal().cwiseProduct(inverse.diagonal()).maxCoeff();
    worst = std::max<T>(worst, pivots[idx(b)] * cancelled);
  }
  return worst;
}

template <class T>
template <int n>
void ArticulatedTree<T>::factor_cluster(const Cluster& c, Joint& joint) {
  if constexpr (n == 6) {
    if (!c.is_driven() && joint.root.coupled < 0) {
      bodies_[idx(c.body)].with_inertia([&](const auto& inertia) { joint.free.take(inertia); });
    }
    return;
  }
  Mat<n> gram = Mat<n>::Zero();
  Wrench<T>* const at_parent = at_parent_.data() + c.u;
  for (int k = 0; k < n; ++k) at_parent[k] = Wrench<T>::zero();
  SpatialInertia<T>& to = bodies_[idx(c.parent)].inertia;
  const bool on_ground = c.parent == ground_;
  bool any_leaf = false;
  LeverInertia<T> leaves = LeverInertia<T>::zero();
  for (const Member& m : c.members) {
    const Twist<T>* const column = kinematics_.columns(m);
    const Vec3<T>& reach = kinematics_.over_parent(m.body).reach;
    const auto weigh = [&](const auto& inertia) {
      for (int k = 0; k < n; ++k) {
        const Wrench<T> weighted = inertia * column[k];
        for (int l = k; l < n; ++l) gram(l, k) += dot(column[l], weighted);
        at_parent[k].add_shifted_from(reach, weighted);
      }
    };
    const Body& body = bodies_[idx(m.body)];
    if (body.leaf) {
      weigh(body.compact);
      leaves.add(reach, body.compact);
      any_leaf = true;
    } else {
      weigh(body.inertia);
      if (!on_ground) to.add_shifted_from(reach, body.inertia);
    }
  }
  if (!on_ground && any_leaf) to += leaves;
  Mat<n> inverse;
  if constexpr (n > 0) inverse = c.is_driven() ? gram : spd_inverse<n>(gram);
  joint.inverse.template topLeftCorner<n, n>() = inverse;
  if (on_ground || c.is_driven()) return;
  for (int k = 0; k < n; ++k) {
    Wrench<T> row = inverse(0, k) * at_parent[0];
    for (int l = 1; l < n; ++l) row += inverse(l, k) * at_parent[l];
    to.subtract_outer(at_parent[k], row);
  }
}

/// The child yields to its parent in all directions but one: seen from there its inertia is of rank one.
template <class T>
template <class Branch>
void ArticulatedTree<T>::factor_held(const Cluster& c, Joint& joint) {
  bodies_[idx(c.body)].with_inertia([&](const auto& inertia) { joint.free.take(inertia); });
  Held& held = joint.held;
  held.on_child = Branch::template held<T>(c.joint, kinematics_.columns(c.members[0]));
  held.on_parent = held.on_child.shifted_from(kinematics_.over_parent(c.body).reach);
  held.response = joint.free.solve(held.on_child);
  held.stiffness = T(1) / dot(held.response, held.on_child);
  if (c.parent == ground_) return;
  bodies_[idx(c.parent)].inertia.subtract_outer(held.on_parent, -(held.stiffness * held.on_parent));
}

template <class T>
void ArticulatedTree<T>::solve(bool moving, T* u_rate, const T* torque, const T* driven) {
  solve(std::views::iota(std::size_t{0}, clusters().size()), moving, u_rate, torque, driven);
}

template <class T>
void ArticulatedTree<T>::respond(const std::vector<std::size_t>& clusters, T* u_rate) {
  solve(clusters, false, u_rate, nullptr, nullptr);
}

/// Inwards and outwards over clusters, parents first.
template <class T>
template <class Places>
void ArticulatedTree<T>::solve(const Places& places, bool moving, T* u_rate, const T* torque,
                               const T* driven) {
  Body& ground = bodies_[idx(ground_)];
  ground.force = Wrench<T>::zero();
  for (auto at = places.end(); at != places.begin();) {
    const std::size_t i = *--at;
    const Cluster& c = clusters()[i];
    Joint& joint = joints_[i];
    if (with_held(c, [&]<class Branch>() { gather_held(c, joint, moving); })) continue;
    with_speeds(c, [&]<int n>() { gather<n>(c, joint, moving, torque, driven); });
  }
  ground.acceleration = Twist<T>::zero();
  for (const std::size_t i : places) {
    const Cluster& c = clusters()[i];
    Joint& joint = joints_[i];
    if (joint.root.leads) solve(coupled_[idx(joint.root.coupled)]);
    if (with_held(c, [&]<class Branch>() { spread_held<Branch>(c, joint, moving, u_rate); })) continue;
    with_speeds(c, [&]<int n>() { spread<n>(c, joint, moving, u_rate); });
  }
}

template <class T>
template <int n>
void ArticulatedTree<T>::gather(const Cluster& c, Joint& joint, bool moving, const T* torque,
                                const T* driven) {
  if constexpr (n == 6) {
    if (c.is_driven()) {
      for (int k = 0; k < 6; ++k) joint.torque[k] = driven ? driven[c.u + k] : T(0);
      return;
    }
    Wrench<T> sum = -bodies_[idx(c.body)].force;
    if (torque) sum += {branch::vector(torque + c.u), branch::vector(torque + c.u + 3)};
    joint.torque = joint.root.coupled < 0 ? joint.free.solve(sum).vector() : sum.vector();
    return;
  }
  T sum[n + 1];  // one more than none
  for (int k = 0; k < n; ++k) sum[k] = torque ? torque[c.u + k] : T(0);
  Wrench<T>& to = bodies_[idx(c.parent)].force;
  for (const Member& m : c.members) {
    const Body& body = bodies_[idx(m.body)];
    const auto& over = kinematics_.over_parent(m.body);
    Wrench<T> force = body.force;
    if (moving) body.with_inertia([&](const auto& inertia) { force += inertia * over.bias; });
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) sum[k] -= dot(column[k], force);
    to.add_shifted_from(over.reach, force);
  }
  if constexpr (n == 1) {
    if (c.is_driven()) {
      const T rate = driven ? driven[c.u] : T(0);
      joint.torque[0] = rate;
      joint.torque[1] = sum[0];
      to += rate * at_parent_[idx(c.u)];
      return;
    }
  }
  for (int k = 0; k < n; ++k) {
    T rate = joint.inverse(k, 0) * sum[0];
    for (int l = 1; l < n; ++l) rate += joint.inverse(k, l) * sum[l];
    joint.torque[k] = rate;
    to += rate * at_parent_[idx(c.u + k)];
  }
}

template <class T>
void ArticulatedTree<T>::gather_held(const Cluster& c, Joint& joint, bool moving) {
  const Held& held = joint.held;
  const Twist<T> yield = joint.free.solve(bodies_[idx(c.body)].force);
  joint.torque = yield.vector();
  T along = dot(yield, held.on_child);
  if (moving) along += dot(kinematics_.over_parent(c.body).bias, held.on_child);
  bodies_[idx(c.parent)].force += (held.stiffness * along) * held.on_parent;
}

template <class T>
template <int n>
void ArticulatedTree<T>::spread(const Cluster& c, const Joint& joint, bool moving, T* u_rate) {
  if constexpr (n == 6) {
    bodies_[idx(c.body)].acceleration = Twist<T>(joint.torque);
    for (int k = 0; k < 6; ++k) u_rate[c.u + k] = joint.torque[k];
    return;
  }
  const Twist<T>& parent = bodies_[idx(c.parent)].acceleration;
  const Wrench<T>* const at_parent = at_parent_.data() + c.u;
  T carried[n + 1], rate[n + 1];  // one more than none
  for (int k = 0; k < n; ++k) carried[k] = dot(parent, at_parent[k]);
  for (int k = 0; k < n; ++k) {
    rate[k] = joint.torque[k];
    if (!c.is_driven()) {
      for (int l = 0; l < n; ++l) rate[k] -= joint.inverse(k, l) * carried[l];
    }
    u_rate[c.u + k] = rate[k];
  }
  for (const Member& m : c.members) {
    const auto& over = kinematics_.over_parent(m.body);
    Twist<T> a = parent.shifted_to(over.reach);
    if (moving) a += over.bias;
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) a += rate[k] * column[k];
    bodies_[idx(m.body)].acceleration = a;
  }
}

template <class T>
template <class Branch>
void ArticulatedTree<T>::spread_held(const Cluster& c, Joint& joint, bool moving, T* u_rate) {
  Held& held = joint.held;
  const auto& over = kinematics_.over_parent(c.body);
  Twist<T> carried = bodies_[idx(c.parent)].acceleration.shifted_to(over.reach);
  if (moving) carried += over.bias;
  const Twist<T> yield(joint.torque);
  held.force = held.stiffness * (dot(carried, held.on_child) + dot(yield, held.on_child));
  Twist<T>& out = bodies_[idx(c.body)].acceleration;
  out = held.force * held.response - yield;
  Branch::template speed_rates<T>(c.joint, kinematics_.columns(c.members[0]), out - carried, u_rate + c.u);
}

}  // namespace seacrane
