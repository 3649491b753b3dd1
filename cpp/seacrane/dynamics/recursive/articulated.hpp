#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/dynamics/recursive/tree_kinematics.hpp"
#include "seacrane/math/spd_inverse.hpp"

namespace seacrane {

/// Forward dynamics of a tree of clusters by articulated-body inertias [R. Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, chapter 7], with all quantities in inertial axes about the bodies' state points, and
/// several bodies that share the speeds of one cluster. Inertias are symmetric in blocks; bodies that carry
/// nothing stay a mass and a 3 x 3. A joint that holds one direction is eliminated by the force along it.
/// Cost linear in the bodies; nothing is allocated after construction. On any scalar: a dual number
/// differentiates. Scratch of one run.
template <class T>
class ArticulatedTree {
 public:
  ArticulatedTree(const BodyTree& tree, int bodies)
      : kinematics_(tree, bodies),
        ground_(bodies),
        leaf_(leaves_of(tree, bodies)),
        at_parent_(idx(tree.speeds), Wrench<T>::zero()),
        inertia_(idx(bodies) + 1, SpatialInertia<T>::zero()),
        compact_(idx(bodies), {T(0), Symmetric3<T>::zero()}),
        force_(idx(bodies) + 1, Wrench<T>::zero()),
        inverse_(tree.clusters.size(), Mat6<T>::Zero()),
        free_(tree.clusters.size()),
        torque_(tree.clusters.size(), Vec6<T>::Zero()),
        held_(tree.clusters.size()),
        acceleration_(idx(bodies) + 1, Twist<T>::zero()) {}

  /// See TreeKinematics.
  void place(const T* q, const T* u, BodyKinematics<T>* bodies) { kinematics_.place(q, u, bodies); }
  const TreeKinematics<T>& kinematics() const { return kinematics_; }
  /// Positions and speeds of given poses and twists; what leaves the joints open is dropped.
  void read(const BodyKinematics<T>* bodies, T* q, T* u) const;

  /// Inertia of a body about its state point, for the next factor(); of a mass matrix of a leaf only the mass
  /// and the inertia are read.
  void set_inertia(int body, const CompactInertia<T>& inertia) {
    if (leaf_[idx(body)]) {
      compact_[idx(body)] = inertia;
    } else {
      inertia_[idx(body)] = inertia;
    }
  }
  void set_inertia(int body, const Mat6<T>& mass) {
    if (leaf_[idx(body)]) {
      compact_[idx(body)] = {mass(0, 0), Symmetric3<T>::lower(mass.template bottomRightCorner<3, 3>())};
    } else {
      inertia_[idx(body)] = mass;
    }
  }
  /// Articulated inertias for those of all bodies, at the last place(). They are used up: set them again.
  void factor();
  /// Takes the bodies' mass matrices, then factors.
  void factor(const Mat6<T>* mass) {
    for (int b = 0; b < ground_; ++b) set_inertia(b, mass[b]);
    factor();
  }
  /// Largest factor by which inertias cancelled in the last factor(mass), like S_ii / d_i in maximal
  /// coordinates, times that of the joints' own inertias: digits that joints between light and heavy bodies
  /// cost. Allocates; for reports.
  T condition(const Mat6<T>* mass) const;
  /// What acts on a body in the next solve(): its wrench less M-independent velocity terms.
  void set_load(int body, const Wrench<T>& load) { force_[idx(body)] = -load; }
  /// Accelerations of the bodies and of the speeds under the loads of all bodies, and `torque` on every speed
  /// (null: none; of joints with a direction held, none). Without `moving` velocities count as zero: the
  /// response to an impulse. Loads are used up: set them again.
  void solve(bool moving, T* u_rate, const T* torque = nullptr);
  /// At the last solve(); of the ground too.
  const Twist<T>& acceleration(int body) const { return acceleration_[idx(body)]; }
  /// Solves for loads of the bodies, and writes accelerations of the bodies, ground last.
  void solve(const Vec6<T>* load, bool moving, Vec6<T>* acceleration, T* u_rate, const T* torque = nullptr) {
    for (int b = 0; b < ground_; ++b) set_load(b, Wrench<T>(load[b]));
    solve(moving, u_rate, torque);
    for (int b = 0; b <= ground_; ++b) acceleration[b] = acceleration_[idx(b)].vector();
  }

 private:
  template <int n>
  using Vec = Eigen::Matrix<T, n, 1>;
  template <int n>
  using Mat = Eigen::Matrix<T, n, n>;

  /// What a joint holds of its child: the force h along one direction (`on_child`, `on_parent` per unit of
  /// it), and the child's acceleration for it alone, I^-1 h.
  struct Held {
    Wrench<T> on_child, on_parent;
    Twist<T> response;
    T stiffness;  // 1 / (h^T I^-1 h)
  };

  static std::vector<char> leaves_of(const BodyTree& tree, int bodies);

  template <int speeds>
  void factor_cluster(std::size_t i);
  template <int speeds>
  void gather(std::size_t i, bool moving, const T* torque);
  template <int speeds>
  void spread(std::size_t i, bool moving, T* u_rate);
  template <class Branch>
  void factor_held(std::size_t i);
  void gather_held(std::size_t i, bool moving);
  template <class Branch>
  void spread_held(std::size_t i, bool moving, T* u_rate);

  /// Calls f(inertia) with what a body's articulated inertia is kept as.
  template <class F>
  void with_inertia(int body, F&& f) const {
    if (leaf_[idx(body)]) {
      f(compact_[idx(body)]);
    } else {
      f(inertia_[idx(body)]);
    }
  }
  SpatialInertia<T> inertia(int body) const {
    SpatialInertia<T> out;
    with_inertia(body, [&](const auto& kept) { out = kept; });
    return out;
  }
  /// Acceleration of a held child under a wrench alone.
  Twist<T> response(std::size_t i, const Wrench<T>& wrench) const;

  const std::vector<Cluster>& clusters() const { return kinematics_.tree().clusters; }

  TreeKinematics<T> kinematics_;
  int ground_;
  std::vector<char> leaf_;                  // by body: compact, and carries nothing
  std::vector<Wrench<T>> at_parent_;        // sum over the members of X^T I S, per speed
  std::vector<SpatialInertia<T>> inertia_;  // articulated
  std::vector<CompactInertia<T>> compact_;  // of leaves
  std::vector<Wrench<T>> force_;            // articulated, minus the load
  std::vector<Mat6<T>> inverse_;            // (S^T I S)^-1 per cluster; of a leaf that is held, of its 3 x 3
  std::vector<SpdFactor<6, T>> free_;       // of I, of clusters that float or are held
  std::vector<Vec6<T>> torque_;             // (S^T I S)^-1 (-S^T p) per cluster; of one that is held, I^-1 p
  std::vector<Held> held_;                  // per cluster
  std::vector<Twist<T>> acceleration_;
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
void ArticulatedTree<T>::factor() {
  for (std::size_t i = clusters().size(); i-- > 0;) {
    const Cluster& c = clusters()[i];
    if (with_held(c, [&]<class Branch>() { factor_held<Branch>(i); })) continue;
    with_speeds(c, [&]<int n>() { factor_cluster<n>(i); });
  }
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
    free_[i] = SpdFactor<6, T>(inertia(c.body).matrix());
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
  if constexpr (n > 0) inverse = spd_inverse<n>(gram);
  inverse_[i].template topLeftCorner<n, n>() = inverse;
  if (c.parent == ground_) return;
  SpatialInertia<T>& to = inertia_[idx(c.parent)];
  for (const Member& m : c.members) {
    with_inertia(m.body,
                 [&](const auto& inertia) { to.add_shifted_from(kinematics_.reach(m.body), inertia); });
  }
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
void ArticulatedTree<T>::solve(bool moving, T* u_rate, const T* torque) {
  force_[idx(ground_)] = Wrench<T>::zero();
  for (std::size_t i = clusters().size(); i-- > 0;) {
    const Cluster& c = clusters()[i];
    if (with_held(c, [&]<class Branch>() { gather_held(i, moving); })) continue;
    with_speeds(c, [&]<int n>() { gather<n>(i, moving, torque); });
  }
  acceleration_[idx(ground_)] = Twist<T>::zero();
  for (std::size_t i = 0; i < clusters().size(); ++i) {
    const Cluster& c = clusters()[i];
    if (with_held(c, [&]<class Branch>() { spread_held<Branch>(i, moving, u_rate); })) continue;
    with_speeds(c, [&]<int n>() { spread<n>(i, moving, u_rate); });
  }
}

template <class T>
template <int n>
void ArticulatedTree<T>::gather(std::size_t i, bool moving, const T* torque) {
  const Cluster& c = clusters()[i];
  if constexpr (n == 6) {
    Vec6<T> sum = -force_[idx(c.body)].vector();
    if (torque) sum += Eigen::Map<const Vec6<T>>(torque + c.u);
    torque_[i] = free_[i].solve(sum);
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
    for (int l = 0; l < n; ++l) rate[k] -= inverse_[i](k, l) * carried[l];
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

extern template class ArticulatedTree<double>;

}  // namespace seacrane
