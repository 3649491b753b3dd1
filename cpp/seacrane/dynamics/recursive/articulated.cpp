#include "seacrane/dynamics/recursive/articulated.hpp"

#include <algorithm>

#include "seacrane/math/spd_inverse.hpp"

namespace seacrane {
namespace {

template <int n>
using Vec = Eigen::Matrix<double, n, 1>;
template <int n>
using Mat = Eigen::Matrix<double, n, n>;

/// to += wrench about a point that lies `reach` away, moved to where reach begins.
inline void add_moved_wrench(const Vec6d& w, const Vec3d& reach, Vec6d& to) {
  to += w;
  to.tail<3>() += reach.cross(w.head<3>());
}

/// Acceleration (or velocity) of a point `reach` away on the same rigid body, velocity terms aside.
inline Vec6d moved_rate(const Vec6d& a, const Vec3d& reach) {
  Vec6d out = a;
  out.head<3>() += a.tail<3>().cross(reach);
  return out;
}

/// to += X^T I X with X = [1, -reach x; 0, 1].
inline void add_moved_inertia(const Mat6d& inertia, const Vec3d& reach, Mat6d& to) {
  Eigen::Matrix<double, 6, 3> right;  // of I X
  right.col(0) = inertia.col(3) - reach[2] * inertia.col(1) + reach[1] * inertia.col(2);
  right.col(1) = inertia.col(4) - reach[0] * inertia.col(2) + reach[2] * inertia.col(0);
  right.col(2) = inertia.col(5) - reach[1] * inertia.col(0) + reach[0] * inertia.col(1);
  to.topLeftCorner<3, 3>() += inertia.topLeftCorner<3, 3>();
  to.bottomLeftCorner<3, 3>() += right.topRows<3>().transpose();
  for (int j = 0; j < 3; ++j) {
    to.col(3 + j) += right.col(j);
    to.col(3 + j).tail<3>() += reach.cross(right.col(j).head<3>());
  }
}

}  // namespace

ArticulatedTree::ArticulatedTree(const BodyTree& tree, int bodies)
    : tree_(tree),
      ground_(bodies),
      column_(idx(tree.columns), Vec6d::Zero()),
      at_parent_(idx(tree.speeds), Vec6d::Zero()),
      reach_(idx(bodies), Vec3d::Zero()),
      bias_(idx(bodies), Vec6d::Zero()),
      inertia_(idx(bodies) + 1, Mat6d::Zero()),
      force_(idx(bodies) + 1, Vec6d::Zero()),
      inverse_(tree.clusters.size(), Mat6d::Zero()),
      torque_(tree.clusters.size(), Vec6d::Zero()) {}

template <class F>
void ArticulatedTree::with_speeds(const Cluster& c, F&& f) const {
  switch (c.speeds) {
    case 0:
      return f.template operator()<0>();
    case 1:
      return f.template operator()<1>();
    case 2:
      return f.template operator()<2>();
    case 3:
      return f.template operator()<3>();
    case 5:
      return f.template operator()<5>();
    default:
      return f.template operator()<6>();
  }
}

void ArticulatedTree::place(const double* q, const double* u, BodyKinematics<double>* bodies) {
  for (const Cluster& c : tree_.clusters) {
    if (c.kind == Cluster::floating) {
      place_floating(c, q + c.q, u + c.u, bodies);
    } else {
      place_joint(c, q + c.q, u + c.u, bodies);
    }
  }
}

void ArticulatedTree::place_floating(const Cluster& c, const double* q, const double* u,
                                     BodyKinematics<double>* bodies) {
  BodyKinematics<double>& k = bodies[c.body];
  k.position = view<3>(q);
  k.rotation = rotation_from_quaternion<double>(view<4>(q + 3));
  k.velocity = view<3>(u);
  k.angular_velocity = view<3>(u + 3);
  for (int i = 0; i < 6; ++i) column_[idx(c.members[0].column + i)] = Vec6d::Unit(i);
}

template <int speeds>
void ArticulatedTree::place_member(const Member& m, const BodyKinematics<double>& parent,
                                   const BranchMotion& motion, const Vec3d& lever, const double* u,
                                   BodyKinematics<double>& body) {
  Vec3d slide = Vec3d::Zero(), turn = Vec3d::Zero();
  for (int i = 0; i < speeds; ++i) {
    Vec6d& column = column_[idx(m.column + i)];
    column.head<3>() = motion.slide[i] + motion.turn[i].cross(lever);
    column.tail<3>() = motion.turn[i];
    slide += u[i] * column.head<3>();
    turn += u[i] * motion.turn[i];
  }
  const Vec3d& w = parent.angular_velocity;
  const Vec3d reach = motion.reach + lever;
  reach_[idx(m.body)] = reach;
  body.rotation = motion.rotation;
  body.position = parent.position + reach;
  const Vec3d swept = w.cross(reach);
  body.velocity = parent.velocity + swept + slide;
  body.angular_velocity = w + turn;
  // Centripetal, Coriolis, and what the joint's own directions turn.
  Vec6d& bias = bias_[idx(m.body)];
  bias.head<3>() = w.cross(swept + 2.0 * slide) + motion.slide_bias + motion.turn_bias.cross(lever) +
                   turn.cross(turn.cross(lever));
  bias.tail<3>() = w.cross(turn) + motion.turn_bias;
}

void ArticulatedTree::place_joint(const Cluster& c, const double* q, const double* u,
                                  BodyKinematics<double>* bodies) {
  const BodyKinematics<double>& parent = bodies[c.parent];
  BranchMotion motion;
  with_joint_type(c.kind, [&]<class Type>() {
    Type::Branch::move(c.joint, parent, q, u, motion);
    const Vec3d lever = motion.rotation * -c.joint.child_point;
    place_member<Type::Branch::speeds>(c.members[0], parent, motion, lever, u, bodies[c.body]);
  });
  if (c.struts > 0) place_struts(c, motion, u[0], bodies);
}

/// Both parts of a strut turn alike; the lower one is held at its end, the upper one moves with the arm.
void ArticulatedTree::place_struts(const Cluster& c, const BranchMotion& hinge, double rate,
                                   BodyKinematics<double>* bodies) {
  const BodyKinematics<double>& parent = bodies[c.parent];
  for (int i = 0; i < c.struts; ++i) {
    const Strut& s = tree_.struts[idx(c.first_strut + i)];
    const Vec3d arm = hinge.rotation * (s.arm_point - c.joint.child_point);
    const StrutMotion m = move_strut(s, parent.rotation, hinge.rotation, hinge.reach, hinge.turn[0], arm);
    BranchMotion part;
    part.turn[0] = m.turn;
    part.turn_bias = rate * rate * m.turn_bend;
    part.rotation = m.rotation * s.lower_axes.transpose();
    part.reach = parent.rotation * s.base_point;
    part.slide[0] = Vec3d::Zero();
    place_member<1>(c.members[idx(1 + 2 * i)], parent, part, part.rotation * -s.lower_end, &rate,
                    bodies[s.lower]);
    part.rotation = m.rotation * s.upper_axes.transpose();
    part.reach = m.end;
    part.slide[0] = m.end_rate;
    part.slide_bias = rate * rate * m.end_bend;
    place_member<1>(c.members[idx(2 + 2 * i)], parent, part, part.rotation * -s.upper_end, &rate,
                    bodies[s.upper]);
  }
}

void ArticulatedTree::position_rates(const double* q, const double* u, const BodyKinematics<double>* bodies,
                                     double* q_rate) const {
  for (const Cluster& c : tree_.clusters) {
    if (c.kind == Cluster::floating) {
      view<3>(q_rate + c.q) = view<3>(u + c.u);
      view<4>(q_rate + c.q + 3) = quaternion_rate<double>(view<4>(q + c.q + 3), view<3>(u + c.u + 3));
    } else {
      with_joint_type(c.kind, [&]<class Type>() {
        Type::Branch::rates(bodies[c.parent], q + c.q, u + c.u, q_rate + c.q);
      });
    }
  }
}

void ArticulatedTree::read(const BodyKinematics<double>* bodies, double* q, double* u) const {
  for (const Cluster& c : tree_.clusters) {
    const BodyKinematics<double>& k = bodies[c.body];
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

void ArticulatedTree::velocities(const double* u, Vec6d* twists) const {
  twists[ground_].setZero();
  for (const Cluster& c : tree_.clusters) {
    for (const Member& m : c.members) {
      Vec6d v = c.kind == Cluster::floating ? Vec6d(Vec6d::Zero())
                                            : moved_rate(twists[c.parent], reach_[idx(m.body)]);
      for (int i = 0; i < c.speeds; ++i) v += u[c.u + i] * column_[idx(m.column + i)];
      twists[m.body] = v;
    }
  }
}

void ArticulatedTree::factor(const Mat6d* mass) {
  for (int b = 0; b < ground_; ++b) inertia_[idx(b)] = mass[b];
  for (std::size_t i = tree_.clusters.size(); i-- > 0;) {
    with_speeds(tree_.clusters[i], [&]<int n>() { factor_cluster<n>(i); });
  }
}

double ArticulatedTree::condition(const Mat6d* mass) const {
  // Inertias at a parent, children added in full, over what is left when these yield in their joints.
  std::vector<Mat6d> gross(mass, mass + ground_);
  gross.emplace_back(Mat6d::Zero());
  std::vector<double> pivots(gross.size(), 1.0);  // largest of a parent's joints
  double worst = 1.0;
  for (std::size_t i = 0; i < tree_.clusters.size(); ++i) {
    const Cluster& c = tree_.clusters[i];
    if (c.kind == Cluster::floating) continue;
    double& pivot = pivots[idx(c.parent)];
    for (int k = 0; k < c.speeds; ++k) {
      double own = 0.0;
      for (const Member& m : c.members) {
        const Vec6d& column = column_[idx(m.column + k)];
        own += column.dot(inertia_[idx(m.body)] * column);
      }
      pivot = std::max(pivot, own * inverse_[i](k, k));
    }
    worst = std::max(worst, pivot);
    for (const Member& m : c.members) {
      add_moved_inertia(inertia_[idx(m.body)], reach_[idx(m.body)], gross[idx(c.parent)]);
    }
  }
  for (int b = 0; b < ground_; ++b) {
    const Mat6d inverse = spd_inverse(inertia_[idx(b)]);
    worst = std::max(worst,
                     pivots[idx(b)] * gross[idx(b)].diagonal().cwiseProduct(inverse.diagonal()).maxCoeff());
  }
  return worst;
}

template <int n>
void ArticulatedTree::factor_cluster(std::size_t i) {
  const Cluster& c = tree_.clusters[i];
  if constexpr (n == 6) {
    inverse_[i] = spd_inverse(inertia_[idx(c.body)]);
    return;
  }
  Mat<n> gram = Mat<n>::Zero();
  for (int k = 0; k < n; ++k) at_parent_[idx(c.u + k)].setZero();
  for (const Member& m : c.members) {
    const Mat6d& inertia = inertia_[idx(m.body)];
    const Vec6d* const column = &column_[idx(m.column)];
    for (int k = 0; k < n; ++k) {
      Vec6d weighted;
      weighted.noalias() = inertia * column[k];
      for (int l = k; l < n; ++l) gram(l, k) += column[l].dot(weighted);
      add_moved_wrench(weighted, reach_[idx(m.body)], at_parent_[idx(c.u + k)]);
    }
  }
  Mat<n> inverse;
  if constexpr (n > 0) inverse = spd_inverse<n>(gram);
  inverse_[i].topLeftCorner<n, n>() = inverse;
  if (c.parent == ground_) return;
  Mat6d& to = inertia_[idx(c.parent)];
  for (const Member& m : c.members) add_moved_inertia(inertia_[idx(m.body)], reach_[idx(m.body)], to);
  const Vec6d* const at_parent = at_parent_.data() + c.u;
  for (int k = 0; k < n; ++k) {
    Vec6d row = inverse(0, k) * at_parent[0];
    for (int l = 1; l < n; ++l) row += inverse(l, k) * at_parent[l];
    for (int j = 0; j < 6; ++j) to.col(j) -= row[j] * at_parent[k];
  }
}

void ArticulatedTree::solve(const Vec6d* load, bool moving, Vec6d* acceleration, double* u_rate) {
  for (int b = 0; b < ground_; ++b) force_[idx(b)] = -load[b];
  for (std::size_t i = tree_.clusters.size(); i-- > 0;) {
    with_speeds(tree_.clusters[i], [&]<int n>() { gather<n>(i, moving); });
  }
  acceleration[ground_].setZero();
  for (std::size_t i = 0; i < tree_.clusters.size(); ++i) {
    with_speeds(tree_.clusters[i], [&]<int n>() { spread<n>(i, moving, acceleration, u_rate); });
  }
}

template <int n>
void ArticulatedTree::gather(std::size_t i, bool moving) {
  const Cluster& c = tree_.clusters[i];
  if constexpr (n == 6) {
    torque_[i] = -force_[idx(c.body)];
    return;
  }
  Vec<n> torque = Vec<n>::Zero();
  for (const Member& m : c.members) {
    Vec6d& force = force_[idx(m.body)];
    if (moving) force.noalias() += inertia_[idx(m.body)] * bias_[idx(m.body)];
    for (int k = 0; k < n; ++k) torque[k] -= column_[idx(m.column + k)].dot(force);
  }
  torque_[i].head<n>() = inverse_[i].topLeftCorner<n, n>() * torque;
  if (c.parent == ground_) return;
  Vec6d& to = force_[idx(c.parent)];
  for (const Member& m : c.members) add_moved_wrench(force_[idx(m.body)], reach_[idx(m.body)], to);
  for (int k = 0; k < n; ++k) to += torque_[i][k] * at_parent_[idx(c.u + k)];
}

template <int n>
void ArticulatedTree::spread(std::size_t i, bool moving, Vec6d* acceleration, double* u_rate) const {
  const Cluster& c = tree_.clusters[i];
  if constexpr (n == 6) {
    const Vec6d rate = inverse_[i] * torque_[i];
    acceleration[c.body] = rate;
    view<6>(u_rate + c.u) = rate;
    return;
  }
  const Vec6d& parent = acceleration[c.parent];
  Vec<n> carried;
  for (int k = 0; k < n; ++k) carried[k] = at_parent_[idx(c.u + k)].dot(parent);
  const Vec<n> rate = torque_[i].head<n>() - inverse_[i].topLeftCorner<n, n>() * carried;
  for (int k = 0; k < n; ++k) u_rate[c.u + k] = rate[k];
  for (const Member& m : c.members) {
    Vec6d a = moved_rate(parent, reach_[idx(m.body)]);
    if (moving) a += bias_[idx(m.body)];
    for (int k = 0; k < n; ++k) a += rate[k] * column_[idx(m.column + k)];
    acceleration[m.body] = a;
  }
}

}  // namespace seacrane
