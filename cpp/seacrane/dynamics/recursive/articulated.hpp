#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/dynamics/recursive/tree_kinematics.hpp"
#include "seacrane/math/spd_inverse.hpp"

namespace seacrane {

/// Forward dynamics of a tree of clusters by articulated-body inertias [R. Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, chapter 7], with all quantities in inertial axes about the bodies' state points, and
/// several bodies that share the speeds of one cluster. Cost linear in the bodies; nothing is allocated after
/// construction. On any scalar: a dual number differentiates. Scratch of one run.
template <class T>
class ArticulatedTree {
 public:
  ArticulatedTree(const BodyTree& tree, int bodies)
      : kinematics_(tree, bodies),
        ground_(bodies),
        at_parent_(idx(tree.speeds), Wrench<T>::zero()),
        inertia_(idx(bodies) + 1, SpatialInertia<T>::zero()),
        force_(idx(bodies) + 1, Wrench<T>::zero()),
        inverse_(tree.clusters.size(), Mat6<T>::Zero()),
        torque_(tree.clusters.size(), Vec6<T>::Zero()) {}

  /// See TreeKinematics.
  void place(const T* q, const T* u, BodyKinematics<T>* bodies) { kinematics_.place(q, u, bodies); }
  const TreeKinematics<T>& kinematics() const { return kinematics_; }
  /// Positions and speeds of given poses and twists; what leaves the joints open is dropped.
  void read(const BodyKinematics<T>* bodies, T* q, T* u) const;

  /// Articulated inertias for the bodies' mass matrices (about state points), at the last place().
  void factor(const Mat6<T>* mass);
  /// Largest factor by which inertias cancelled in the last factor(mass), like S_ii / d_i in maximal
  /// coordinates, times that of the joints' own inertias: digits that joints between light and heavy bodies
  /// cost. Allocates; for reports.
  T condition(const Mat6<T>* mass) const;
  /// Accelerations of the bodies (ground last) and of the speeds under `load`, wrench less M-independent
  /// velocity terms. Without `moving` velocities count as zero: the response to an impulse.
  void solve(const Vec6<T>* load, bool moving, Vec6<T>* acceleration, T* u_rate);

 private:
  template <int n>
  using Vec = Eigen::Matrix<T, n, 1>;
  template <int n>
  using Mat = Eigen::Matrix<T, n, n>;

  template <int speeds>
  void factor_cluster(std::size_t i);
  template <int speeds>
  void gather(std::size_t i, bool moving);
  template <int speeds>
  void spread(std::size_t i, bool moving, Vec6<T>* acceleration, T* u_rate) const;

  const std::vector<Cluster>& clusters() const { return kinematics_.tree().clusters; }

  TreeKinematics<T> kinematics_;
  int ground_;
  std::vector<Wrench<T>> at_parent_;        // sum over the members of X^T I S, per speed
  std::vector<SpatialInertia<T>> inertia_;  // articulated
  std::vector<Wrench<T>> force_;            // articulated, minus the load
  std::vector<Mat6<T>> inverse_;            // (S^T I S)^-1 per cluster
  std::vector<Vec6<T>> torque_;             // -S^T p per cluster
};

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
void ArticulatedTree<T>::factor(const Mat6<T>* mass) {
  for (int b = 0; b < ground_; ++b) inertia_[idx(b)] = mass[b];
  for (std::size_t i = clusters().size(); i-- > 0;) {
    with_speeds(clusters()[i], [&]<int n>() { factor_cluster<n>(i); });
  }
}

template <class T>
T ArticulatedTree<T>::condition(const Mat6<T>* mass) const {
  // Inertias at a parent, children added in full, over what is left when these yield in their joints.
  std::vector<SpatialInertia<T>> gross(idx(ground_) + 1, SpatialInertia<T>::zero());
  for (int b = 0; b < ground_; ++b) gross[idx(b)] = SpatialInertia<T>(mass[b]);
  std::vector<T> pivots(gross.size(), T(1));  // largest of a parent's joints
  T worst = T(1);
  for (std::size_t i = 0; i < clusters().size(); ++i) {
    const Cluster& c = clusters()[i];
    if (c.kind == Cluster::floating) continue;
    T& pivot = pivots[idx(c.parent)];
    for (int k = 0; k < c.speeds; ++k) {
      T own = T(0);
      for (const Member& m : c.members) {
        const Twist<T>& column = kinematics_.columns(m)[k];
        own += dot(column, inertia_[idx(m.body)] * column);
      }
      pivot = std::max<T>(pivot, own * inverse_[i](k, k));
    }
    worst = std::max(worst, pivot);
    for (const Member& m : c.members) {
      gross[idx(c.parent)].add_shifted_from(kinematics_.reach(m.body), inertia_[idx(m.body)]);
    }
  }
  for (int b = 0; b < ground_; ++b) {
    const Mat6<T> inverse = spd_inverse(inertia_[idx(b)].matrix());
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
    inverse_[i] = spd_inverse(inertia_[idx(c.body)].matrix());
    return;
  }
  Mat<n> gram = Mat<n>::Zero();
  for (int k = 0; k < n; ++k) at_parent_[idx(c.u + k)] = Wrench<T>::zero();
  for (const Member& m : c.members) {
    const SpatialInertia<T>& inertia = inertia_[idx(m.body)];
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) {
      const Wrench<T> weighted = inertia * column[k];
      for (int l = k; l < n; ++l) gram(l, k) += dot(column[l], weighted);
      at_parent_[idx(c.u + k)].add_shifted_from(kinematics_.reach(m.body), weighted);
    }
  }
  Mat<n> inverse;
  if constexpr (n > 0) inverse = spd_inverse<n>(gram);
  inverse_[i].template topLeftCorner<n, n>() = inverse;
  if (c.parent == ground_) return;
  SpatialInertia<T>& to = inertia_[idx(c.parent)];
  for (const Member& m : c.members) to.add_shifted_from(kinematics_.reach(m.body), inertia_[idx(m.body)]);
  const Wrench<T>* const at_parent = at_parent_.data() + c.u;
  for (int k = 0; k < n; ++k) {
    Wrench<T> row = inverse(0, k) * at_parent[0];
    for (int l = 1; l < n; ++l) row += inverse(l, k) * at_parent[l];
    to.subtract_outer(at_parent[k], row);
  }
}

template <class T>
void ArticulatedTree<T>::solve(const Vec6<T>* load, bool moving, Vec6<T>* acceleration, T* u_rate) {
  for (int b = 0; b < ground_; ++b) force_[idx(b)] = Wrench<T>(-load[b]);
  for (std::size_t i = clusters().size(); i-- > 0;) {
    with_speeds(clusters()[i], [&]<int n>() { gather<n>(i, moving); });
  }
  acceleration[ground_].setZero();
  for (std::size_t i = 0; i < clusters().size(); ++i) {
    with_speeds(clusters()[i], [&]<int n>() { spread<n>(i, moving, acceleration, u_rate); });
  }
}

template <class T>
template <int n>
void ArticulatedTree<T>::gather(std::size_t i, bool moving) {
  const Cluster& c = clusters()[i];
  if constexpr (n == 6) {
    torque_[i] = -force_[idx(c.body)].vector();
    return;
  }
  Vec<n> torque = Vec<n>::Zero();
  for (const Member& m : c.members) {
    Wrench<T>& force = force_[idx(m.body)];
    if (moving) force += inertia_[idx(m.body)] * kinematics_.bias(m.body);
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) torque[k] -= dot(column[k], force);
  }
  torque_[i].template head<n>() = inverse_[i].template topLeftCorner<n, n>() * torque;
  if (c.parent == ground_) return;
  Wrench<T>& to = force_[idx(c.parent)];
  for (const Member& m : c.members) to.add_shifted_from(kinematics_.reach(m.body), force_[idx(m.body)]);
  for (int k = 0; k < n; ++k) to += torque_[i][k] * at_parent_[idx(c.u + k)];
}

template <class T>
template <int n>
void ArticulatedTree<T>::spread(std::size_t i, bool moving, Vec6<T>* acceleration, T* u_rate) const {
  const Cluster& c = clusters()[i];
  if constexpr (n == 6) {
    const Vec6<T> rate = inverse_[i] * torque_[i];
    acceleration[c.body] = rate;
    for (int k = 0; k < 6; ++k) u_rate[c.u + k] = rate[k];
    return;
  }
  const Twist<T> parent(acceleration[c.parent]);
  Vec<n> carried;
  for (int k = 0; k < n; ++k) carried[k] = dot(parent, at_parent_[idx(c.u + k)]);
  const Vec<n> rate = torque_[i].template head<n>() - inverse_[i].template topLeftCorner<n, n>() * carried;
  for (int k = 0; k < n; ++k) u_rate[c.u + k] = rate[k];
  for (const Member& m : c.members) {
    Twist<T> a = parent.shifted_to(kinematics_.reach(m.body));
    if (moving) a += kinematics_.bias(m.body);
    const Twist<T>* const column = kinematics_.columns(m);
    for (int k = 0; k < n; ++k) a += rate[k] * column[k];
    acceleration[m.body] = a.vector();
  }
}

extern template class ArticulatedTree<double>;

}  // namespace seacrane
