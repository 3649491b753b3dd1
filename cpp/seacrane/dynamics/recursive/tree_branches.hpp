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
    place_member<Type::Branch::speeds>(c.members[0], parent, motion, lever, u, bodies[c.body]);
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
std::vector<char> ArticulatedTree<T>::leaves_of(const BodyTree& tree, int bodies) {
  std::vector<char> out(idx(bodies), 0);
  for (const Cluster& c : tree.clusters) {
    for (const Member& m : c.members) out[idx(m.body)] = m.leaf;
  }
  return out;
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
    if (with_held(c, [&]<class Branch>() { factor_held<Branch>(i); })) continue;
    with_speeds(c, [&]<int n>() { factor_cluster<n>(i); });
  }
  for (Coupled& roots : coupled_) factor(roots, coupled);
}

template <class T>
void ArticulatedTree<T>::factor(Coupled& roots, bool with_water) {
  const int count = roots.mass.count();
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      if (with_water) {
        roots.mass.at(i, j) = roots.coupling[idx(i * count + j)];
      } else {
        roots.mass.at(i, j).setZero();
      }
    }
    roots.mass.at(i, i) = inertia(clusters()[roots.clusters[idx(i)]].body).matrix();
  }
  roots.mass.factor();
}

/// Accelerations of the roots for the loads that gather() left in torque_.
template <class T>
void ArticulatedTree<T>::solve(Coupled& roots) {
  for (std::size_t i = 0; i < roots.clusters.size(); ++i) roots.motion[i] = torque_[roots.clusters[i]];
  roots.mass.solve(roots.motion.data());
  for (std::size_t i = 0; i < roots.clusters.size(); ++i) torque_[roots.clusters[i]] = roots.motion[i];
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
        const SpatialInertia<T> own = inertia(m.body);
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
      gross[idx(c.parent)].add_shifted_from(kinematics_.reach(m.body), inertia(m.body));
    }
  }
  for (int b = 0; b < ground_; ++b) {
    const Mat6<T> inverse = spd_inverse(inertia(b).matrix());
    const T cancelled = gross[idx(b)].matrix().diagonal().cwiseProduct(inverse.diagonal()).maxCoeff();
    worst = std::max<T>(worst, pivots[idx(b)] * cancelled);
  }
  return worst;
}

template <class T>
template <int n>
void ArticulatedTree<T>::factor_cluster(std::size_t i) {
  const Cluster& c = clusters()[i];
  if constexpr (n == 6) {
    if (!c.is_driven() && root_of_[i].coupled < 0) free_[i] = SpdFactor<6, T>(inertia(c.body).matrix());
    return;
  }
  Mat<n> gram = Mat<n>::Zero();
  Wrench<T>* const at_parent = at_parent_.data() + c.u;
  for (int k = 0; k < n; ++k) at_parent[k] = Wrench<T>::zero();
  for (const Member& m : c.members) {
    const Twist<T>* const column = kinematics_.columns(m);
    with_inertia(m.body, [&](const auto& inertia) {
      for (int k = 0; k < n; ++k) {
        const Wrench<T> weighted = inertia * column[k];
        for (int l = k; l < n; ++l) gram(l, k) += dot(column[l], weighted);
        at_parent[k].add_shifted_from(kinematics_.reach(m.body), weighted);
      }
    });
  }
  Mat<n> inverse;
  if constexpr (n > 0) inverse = c.is_driven() ? gram : spd_inverse<n>(gram);
  inverse_[i].template topLeftCorner<n, n>() = inverse;
  if (c.parent == ground_) return;
  SpatialInertia<T>& to = inertia_[idx(c.parent)];
  for (const Member& m : c.members) {
    with_inertia(m.body,
                 [&](const auto& inertia) { to.add_shifted_from(kinematics_.reach(m.body), inertia); });
  }
  if (c.is_driven()) return;
  for (int k = 0; k < n; ++k) {
    Wrench<T> row = inverse(0, k) * at_parent[0];
    for (int l = 1; l < n; ++l) row += inverse(l, k) * at_parent[l];
    to.subtract_outer(at_parent[k], row);
  }
}

/// The child yields to its parent in all directions but one: seen from there its inertia is of rank one.
template <class T>
template <class Branch>
void ArticulatedTree<T>::factor_held(std::size_t i) {
  const Cluster& c = clusters()[i];
  if (leaf_[idx(c.body)]) {
    inverse_[i].template topLeftCorner<3, 3>() = spd_inverse<3>(compact_[idx(c.body)].turning.full());
  } else {
    free_[i] = SpdFactor<6, T>(inertia_[idx(c.body)].matrix());
  }
  Held& held = held_[i];
  held.on_child = Branch::template held<T>(c.joint, kinematics_.columns(c.members[0]));
  held.on_parent = held.on_child.shifted_from(kinematics_.reach(c.body));
  held.response = response(i, held.on_child);
  held.stiffness = T(1) / dot(held.response, held.on_child);
  if (c.parent == ground_) return;
  inertia_[idx(c.parent)].subtract_outer(held.on_parent, -(held.stiffness * held.on_parent));
}

template <class T>
Twist<T> ArticulatedTree<T>::response(std::size_t i, const Wrench<T>& wrench) const {
  const int body = clusters()[i].body;
  if (!leaf_[idx(body)]) return Twist<T>(free_[i].solve(wrench.vector()));
  const Vec3<T> linear = wrench.force() / compact_[idx(body)].mass;
  const Vec3<T> angular = inverse_[i].template topLeftCorner<3, 3>() * wrench.moment();
  return {linear, angular};
}

template <class T>
void ArticulatedTree<T>::solve(bool moving, T* u_rate, const T* torque, const T* driven) {
  solve(std::views::iota(std::size_t{0}, clusters().size()), moving, u_rate, torque, driven);
}

template <class T>
void ArticulatedTree<T>::respond(const std::vector<std::size_t>& clusters, const Push& first,
                                 const Push& second, T* u_rate) {
  for (const std::size_t i : clusters) {
    for (const Member& m : this->clusters()[i].members) force_[idx(m.body)] = Wrench<T>::zero();
  }
  for (const Push* push : {&first, &second}) {
    if (push->body != ground_) force_[idx(push->body)] += -push->wrench;
  }
  solve(clusters, false, u_rate, nullptr, nullptr);
}

/// Inwards and outwards over clusters, parents first.
template <class T>
template <class Places>
void ArticulatedTree<T>::solve(const Places& places, bool moving, T* u_rate, const T* torque,
                               const T* driven) {
  force_[idx(ground_)] = Wrench<T>::zero();
  for (auto at = places.end(); at != places.begin();) {
    const std::size_t i = *--at;
    const Cluster& c = clusters()[i];
    if (with_held(c, [&]<class Branch>() { gather_held(i, moving); })) continue;
    with_speeds(c, [&]<int n>() { gather<n>(i, moving, torque, driven); });
  }
  acceleration_[idx(ground_)] = Twist<T>::zero();
  for (const std::size_t i : places) {
    const Cluster& c = clusters()[i];
    if (root_of_[i].leads) solve(coupled_[idx(root_of_[i].coupled)]);
    if (with_held(c, [&]<class Branch>() { spread_held<Branch>(i, moving, u_rate); })) continue;
    with_speeds(c, [&]<int n>() { spread<n>(i, moving, u_rate); });
  }
}

template <class T>
template <int n>
void ArticulatedTree<T>::gather(std::size_t i, bool moving, const T* torque, const T* driven) {
  const Cluster& c = clusters()[i];
  if constexpr (n == 6) {
    if (c.is_driven()) {
      for (int k = 0; k < 6; ++k) torque_[i][k] = driven ? driven[c.u + k] : T(0);
      return;
    }
    Vec6<T> sum = -force_[idx(c.body)].vector();
    if (torque) sum += Eigen::Map<const Vec6<T>>(torque + c.u);
    torque_[i] = root_of_[i].coupled < 0 ? free_[i].solve(sum) : sum;
    return;
  }
  T sum[n + 1];  // one more than none
  for (int k = 0; k < n; ++k) sum[k] = torque ? torque[c.u + k] : T(0);
  Wrench<T>& to = force_[idx(c.parent)];
  for (const Member& m : c.members) {
    Wrench<T> force = force_[idx(m.body)];
    if (moving) {
      with_inertia(m.body, [&](const auto& inertia) { force += inertia * kinematics_.bias(m.body); });
    }
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) sum[k] -= dot(column[k], force);
    to.add_shifted_from(kinematics_.reach(m.body), force);
  }
  if constexpr (n == 1) {
    if (c.is_driven()) {
      const T rate = driven ? driven[c.u] : T(0);
      torque_[i][0] = rate;
      torque_[i][1] = sum[0];
      to += rate * at_parent_[idx(c.u)];
      return;
    }
  }
  for (int k = 0; k < n; ++k) {
    T rate = inverse_[i](k, 0) * sum[0];
    for (int l = 1; l < n; ++l) rate += inverse_[i](k, l) * sum[l];
    torque_[i][k] = rate;
    to += rate * at_parent_[idx(c.u + k)];
  }
}

template <class T>
void ArticulatedTree<T>::gather_held(std::size_t i, bool moving) {
  const Cluster& c = clusters()[i];
  const Held& held = held_[i];
  const Wrench<T>& force = force_[idx(c.body)];
  const Twist<T> yield = response(i, force);
  torque_[i] = yield.vector();
  T along = dot(yield, held.on_child);
  if (moving) along += dot(kinematics_.bias(c.body), held.on_child);
  force_[idx(c.parent)] += (held.stiffness * along) * held.on_parent;
}

template <class T>
template <int n>
void ArticulatedTree<T>::spread(std::size_t i, bool moving, T* u_rate) {
  const Cluster& c = clusters()[i];
  if constexpr (n == 6) {
    acceleration_[idx(c.body)] = Twist<T>(torque_[i]);
    for (int k = 0; k < 6; ++k) u_rate[c.u + k] = torque_[i][k];
    return;
  }
  const Twist<T>& parent = acceleration_[idx(c.parent)];
  const Wrench<T>* const at_parent = at_parent_.data() + c.u;
  T carried[n + 1], rate[n + 1];  // one more than none
  for (int k = 0; k < n; ++k) carried[k] = dot(parent, at_parent[k]);
  for (int k = 0; k < n; ++k) {
    rate[k] = torque_[i][k];
    if (!c.is_driven()) {
      for (int l = 0; l < n; ++l) rate[k] -= inverse_[i](k, l) * carried[l];
    }
    u_rate[c.u + k] = rate[k];
  }
  for (const Member& m : c.members) {
    Twist<T> a = parent.shifted_to(kinematics_.reach(m.body));
    if (moving) a += kinematics_.bias(m.body);
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) a += rate[k] * column[k];
    acceleration_[idx(m.body)] = a;
  }
}

template <class T>
template <class Branch>
void ArticulatedTree<T>::spread_held(std::size_t i, bool moving, T* u_rate) {
  const Cluster& c = clusters()[i];
  const Held& held = held_[i];
  Twist<T> carried = acceleration_[idx(c.parent)].shifted_to(kinematics_.reach(c.body));
  if (moving) carried += kinematics_.bias(c.body);
  const Twist<T> yield(torque_[i]);
  const T force = held.stiffness * (dot(carried, held.on_child) + dot(yield, held.on_child));
  Twist<T>& out = acceleration_[idx(c.body)];
  out = force * held.response - yield;
  Branch::template speed_rates<T>(c.joint, kinematics_.columns(c.members[0]), out - carried, u_rate + c.u);
}

}  // namespace seacrane
