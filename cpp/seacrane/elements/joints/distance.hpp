#pragma once

#include "seacrane/elements/joint_rows.hpp"
#include "seacrane/elements/tree_joint.hpp"

namespace seacrane {

/// Constant distance of the two points: |d| = length. No coordinate.
struct Distance : JointDefaults {
  static constexpr const char* kind = "distance";
  static constexpr int rows = 1;
  static constexpr bool own_point = true;

  struct Parameters {
    double length = 0.0;

    static constexpr auto fields() {
      return std::tuple(required("length", &Parameters::length, "m", "between the two points")
                            .positive()
                            .as(Role::distance));
    }
  };

  static JointDescription example(Random& random) {
    const double length = random.positive();
    return example_joint<Distance>(random, {length * Vec3d::UnitZ()}, {{"length", length}});
  }

  template <class T>
  static void evaluate(const JointGeometry<T>& g, const JointData& joint, RowBlock<T>& out) {
    rows::distance<T>(g, T(parameters_of<Parameters>(joint.parameters).length), out, 0);
  }

  /// Quaternions of a link frame, whose z axis points from the parent's joint point to the child's, and of
  /// the child: no direction of the link is singular. Speeds: the link turns about its own x and y axes
  /// over the parent; the child's angular velocity over the parent's.
  struct Branch {
    static constexpr int positions = 8, speeds = 5;
    static constexpr const char *position_kinds = "aaaaaaaa", *speed_kinds = "aaaaa";  // a: rad, l: m

    template <class T>
    static void move(const TreeJoint& j, const BodyKinematics<T>& parent, const T* q, const T* u,
                     BranchMotionOf<T>& out) {
      const Mat3<T> link = rotation_from_quaternion<T>(branch::quaternion(q));
      out.rotation = rotation_from_quaternion<T>(branch::quaternion(q + 4));
      const T length(parameters_of<Parameters>(j.parameters).length);
      out.reach = branch::parent_lever(j, parent) + length * link.col(2);
      out.slide[0] = -length * link.col(1);
      out.slide[1] = length * link.col(0);
      out.turn[0] = out.turn[1] = Vec3<T>::Zero();
      out.slide_bias = -length * (u[0] * u[0] + u[1] * u[1]) * link.col(2);
      branch::free_turning(parent, u, 2, out);
    }
    template <class T>
    static void rates(const BodyKinematics<T>& parent, const T* q, const T* u, T* q_rate) {
      const Mat3<T> link = rotation_from_quaternion<T>(branch::quaternion(q));
      branch::turn<T>(q, parent.angular_velocity + u[0] * link.col(0) + u[1] * link.col(1), q_rate);
      branch::turn<T>(q + 4, parent.angular_velocity + branch::vector(u + 2), q_rate + 4);
    }

    // The link holds the distance alone. Its columns, by place(): two slides across it by its length, three
    // turns of the child about the joint point.
    static constexpr bool holds_one_direction = true;

    /// Wrench about the child's state point per unit of the link's force, away from the parent.
    template <class T>
    static Wrench<T> held(const TreeJoint& j, const Twist<T>* column) {
      const double length = parameters_of<Parameters>(j.parameters).length;
      const Vec3<T> y = column[0].linear(), x = column[1].linear();
      const Vec3<T> along = T(1.0 / (length * length)) * cross<T>(y, x);
      return {along, cross<T>(along, lever(column))};
    }
    /// Rates of the speeds for the child's acceleration beyond what its parent carries it with.
    template <class T>
    static void speed_rates(const TreeJoint& j, const Twist<T>* column, const Twist<T>& own, T* u_rate) {
      const double length = parameters_of<Parameters>(j.parameters).length;
      const Vec3<T> turning = own.angular();
      const Vec3<T> slide = T(1.0 / (length * length)) * (own.linear() - cross<T>(turning, lever(column)));
      for (int k = 0; k < 2; ++k) u_rate[k] = column[k].linear().dot(slide);
      for (int k = 0; k < 3; ++k) u_rate[2 + k] = turning[k];
    }
    static void read(const TreeJoint& j, const BodyKinematics<double>& parent,
                     const BodyKinematics<double>& child, double* q, double* u) {
      const branch::Gap gap(j, parent, child);
      Eigen::Index least = 0;
      gap.offset.cwiseAbs().minCoeff(&least);
      Mat3d link;
      link.col(2) = gap.offset.normalized();
      link.col(0) = Vec3d::Unit(least).cross(link.col(2)).normalized();
      link.col(1) = link.col(2).cross(link.col(0));
      const double length = parameters_of<Parameters>(j.parameters).length;
      view<4>(q) = quaternion_from_rotation(link);
      view<4>(q + 4) = quaternion_from_rotation(child.rotation);
      u[0] = -link.col(1).dot(gap.rate) / length;
      u[1] = link.col(0).dot(gap.rate) / length;
      view<3>(u + 2) = gap.turning;
    }

   private:
    /// From the child's joint point to its state point.
    template <class T>
    static Vec3<T> lever(const Twist<T>* column) {
      return {-column[3].linear()[2], column[2].linear()[2], column[3].linear()[0]};
    }
  };
};

}  // namespace seacrane
