#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/dynamics/recursive/tree_kinematics.hpp"
#include "seacrane/math/spd_blocks.hpp"
#include "seacrane/math/spd_inverse.hpp"

namespace seacrane {

/// Forward dynamics of a tree of clusters by articulated-body inertias [R. Featherstone, Rigid Body Dynamics
/// Algorithms, 2008, chapter 7], with all quantities in inertial axes about the bodies' state points, and
/// several bodies that share the speeds of one cluster. Inertias are symmetric in blocks; bodies that carry
/// nothing stay a mass and a 3 x 3. A joint that holds one direction is eliminated by the force along it. A
/// cluster that is driven shows its parent all of its inertia, and its force follows from its motion
/// [section 9.2, hybrid dynamics].
/// Cost linear in the bodies; nothing is allocated after construction. On any scalar: a dual number
/// differentiates. Scratch of one run.
template <class T>
class ArticulatedTree {
 public:
  ArticulatedTree(const BodyTree& tree, int bodies)
      : kinematics_(tree, bodies),
        ground_(bodies),
        bodies_(idx(bodies) + 1),
        at_parent_(idx(tree.speeds), Wrench<T>::zero()),
        joints_(tree.clusters.size()) {
    for (const Cluster& c : tree.clusters) {
      for (const Member& m : c.members) bodies_[idx(m.body)].leaf = m.leaf;
    }
    for (const CoupledRoots& roots : tree.coupled) {
      const std::size_t count = roots.clusters.size();
      const std::size_t first = *std::ranges::min_element(roots.clusters);
      for (const std::size_t c : roots.clusters) {
        joints_[c].root = {static_cast<int>(coupled_.size()), c == first};
      }
      coupled_.push_back({roots.clusters, SpdBlocks<T>(static_cast<int>(count)),
                          std::vector<Mat6<T>>(count * count, Mat6<T>::Zero()),
                          std::vector<Vec6<T>>(count, Vec6<T>::Zero())});
    }
  }

  /// See TreeKinematics.
  void place(const T* q, const T* u, BodyKinematics<T>* bodies) { kinematics_.place(q, u, bodies); }
  const TreeKinematics<T>& kinematics() const { return kinematics_; }
  /// Positions and speeds of given poses and twists; what leaves the joints open is dropped.
  void read(const BodyKinematics<T>* bodies, T* q, T* u) const;

  /// Inertia of a body about its state point, for the next factor(); of a leaf's only the mass and
  /// what turns are read.
  void set_inertia(int body, const CompactInertia<T>& inertia) {
    Body& to = bodies_[idx(body)];
    if (to.leaf) {
      to.compact = inertia;
    } else {
      to.inertia = inertia;
    }
  }
  void set_inertia(int body, const SpatialInertia<T>& inertia) {
    Body& to = bodies_[idx(body)];
    if (to.leaf) {
      to.compact = {inertia.moving().xx, inertia.turning()};
    } else {
      to.inertia = inertia;
    }
  }
  /// Mass between the roots at two places of coupled ones, the first behind the second; it stays until it is
  /// set again.
  void set_coupling(std::size_t coupled, int first, int second, const Mat6<T>& mass) {
    Coupled& c = coupled_[coupled];
    c.coupling[idx(first * c.mass.count() + second)] = mass;
  }
  /// Articulated inertias for those of all bodies, at the last place(). They are used up: set them again.
  /// Not `coupled`: of geometry, where the water has no part.
  void factor(bool coupled = true);
  /// Takes the bodies' mass matrices, then factors.
  void factor(const Mat6<T>* mass, bool coupled = true) {
    for (int b = 0; b < ground_; ++b) set_inertia(b, SpatialInertia<T>(mass[b]));
    factor(coupled);
  }
  /// Largest factor by which inertias cancelled in the last factor(mass), like S_ii / d_i in maximal
  /// coordinates, times that of the joints' own inertias: digits that joints between light and heavy bodies
  /// cost. Allocates; for reports.
  T condition(const Mat6<T>* mass) const;
  /// What acts on a body in the next solve(): its wrench less M-independent velocity terms.
  void set_load(int body, const Wrench<T>& load) { bodies_[idx(body)].force = -load; }
  /// Accelerations of the bodies and of the speeds under the loads of all bodies, and `torque` on every speed
  /// (null: none; of joints with a direction held, none). Driven speeds have the rates `driven` (null: zero).
  /// Without `moving` velocities count as zero: the response to an impulse. Loads are used up: set them
  /// again.
  void solve(bool moving, T* u_rate, const T* torque = nullptr, const T* driven = nullptr);
  /// Accelerations of the bodies of some clusters, whole trees and parents first, from rest() under what
  /// pushes them; others keep what they have.
  void rest(const std::vector<std::size_t>& clusters) {
    for (const std::size_t i : clusters) {
      for (const Member& m : this->clusters()[i].members) bodies_[idx(m.body)].force = Wrench<T>::zero();
    }
  }
  void push(int body, const Wrench<T>& wrench) { bodies_[idx(body)].force -= wrench; }
  void respond(const std::vector<std::size_t>& clusters, T* u_rate);
  /// The force along the direction that the joint of a cluster holds, away from the parent, at the last
  /// solve(): N.
  const T& held(std::size_t cluster) const { return joints_[cluster].held.force; }
  /// At the last solve(); of the ground too.
  const Twist<T>& acceleration(int body) const { return bodies_[idx(body)].acceleration; }
  /// What drives the speed of a driven cluster, beside the torque on it, at the last solve(): N or N m.
  T drive(std::size_t cluster) const {
    const Cluster& c = clusters()[cluster];
    const Joint& joint = joints_[cluster];
    const T carried = dot(acceleration(c.parent), at_parent_[idx(c.u)]);
    return carried + joint.inverse(0, 0) * joint.torque[0] - joint.torque[1];
  }
  /// The same of a floating body: a wrench about its state point.
  Wrench<T> drive_wrench(std::size_t cluster) const {
    const Body& body = bodies_[idx(clusters()[cluster].body)];
    Wrench<T> out = body.force;
    body.with_inertia([&](const auto& inertia) { out += inertia * body.acceleration; });
    return out;
  }
  /// Solves for loads of the bodies, and writes accelerations of the bodies, ground last.
  void solve(const Vec6<T>* load, bool moving, Vec6<T>* acceleration, T* u_rate, const T* torque = nullptr,
             const T* driven = nullptr) {
    for (int b = 0; b < ground_; ++b) set_load(b, Wrench<T>(load[b]));
    solve(moving, u_rate, torque, driven);
    write_accelerations(acceleration);
  }
  /// Of the bodies at the last solve(), ground last.
  void write_accelerations(Vec6<T>* out) const {
    for (int b = 0; b <= ground_; ++b) out[b] = acceleration(b).vector();
  }

 private:
  template <int n>
  using Vec = Eigen::Matrix<T, n, 1>;
  template <int n>
  using Mat = Eigen::Matrix<T, n, n>;

  /// All of a body, the ground last, side by side: the recursions go from body to body.
  struct Body {
    bool leaf = false;                    // compact, and carries nothing
    Wrench<T> force = Wrench<T>::zero();  // articulated, minus the load
    Twist<T> acceleration = Twist<T>::zero();
    CompactInertia<T> compact{T(0), Symmetric3<T>::zero()};  // of a leaf
    SpatialInertia<T> inertia = SpatialInertia<T>::zero();   // of another: articulated

    /// Calls f(inertia) with what the articulated inertia is kept as.
    template <class F>
    void with_inertia(F&& f) const {
      if (leaf) {
        f(compact);
      } else {
        f(inertia);
      }
    }
    SpatialInertia<T> whole() const { return leaf ? SpatialInertia<T>(compact) : inertia; }
  };

  /// What a joint holds of its child: the force h along one direction (`on_child`, `on_parent` per unit of
  /// it), and the child's acceleration for it alone, I^-1 h.
  struct Held {
    Wrench<T> on_child, on_parent;
    Twist<T> response;
    T stiffness;  // 1 / (h^T I^-1 h)
    T force;      // at the last solve()
  };

  struct Root {
    int coupled = -1;    // none: by itself
    bool leads = false;  // the first of its coupled ones
  };
  /// Of a cluster.
  struct Joint {
    // (S^T I S)^-1; of one that is driven S^T I S.
    Mat6<T> inverse = Mat6<T>::Zero();
    // (S^T I S)^-1 (-S^T p); of one that is driven its rate and -S^T p; of one that is held, I^-1 p.
    Vec6<T> torque = Vec6<T>::Zero();
    InertiaFactor<T> free;  // of I, where it floats or is held
    Held held;
    Root root;
  };

  /// Roots that the water couples: a block for each.
  struct Coupled {
    std::vector<std::size_t> clusters;
    SpdBlocks<T> mass;              // with all that they carry
    std::vector<Mat6<T>> coupling;  // as set, below the diagonal
    std::vector<Vec6<T>> motion;
  };
  void factor(Coupled& coupled, bool with_water);
  void solve(Coupled& coupled);

  template <class Places>
  void solve(const Places& places, bool moving, T* u_rate, const T* torque, const T* driven);
  template <int speeds>
  void factor_cluster(const Cluster& c, Joint& joint);
  template <int speeds>
  void gather(const Cluster& c, Joint& joint, bool moving, const T* torque, const T* driven);
  template <int speeds>
  void spread(const Cluster& c, const Joint& joint, bool moving, T* u_rate);
  template <class Branch>
  void factor_held(const Cluster& c, Joint& joint);
  void gather_held(const Cluster& c, Joint& joint, bool moving);
  template <class Branch>
  void spread_held(const Cluster& c, Joint& joint, bool moving, T* u_rate);

  const std::vector<Cluster>& clusters() const { return kinematics_.tree().clusters; }

  TreeKinematics<T> kinematics_;
  int ground_;
  std::vector<Body> bodies_;
  std::vector<Wrench<T>> at_parent_;  // sum over the members of X^T I S, per speed
  std::vector<Joint> joints_;         // by cluster
  std::vector<Coupled> coupled_;
};

extern template class TreeKinematics<double>;
extern template class ArticulatedTree<double>;

}  // namespace seacrane
