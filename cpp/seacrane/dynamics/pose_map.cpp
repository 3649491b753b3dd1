#include "seacrane/dynamics/pose_map.hpp"

#include <algorithm>

#include "seacrane/math/rotation.hpp"

namespace seacrane {

void PoseMap::move(double h, double* y) {
  const Model& m = model_;
  for (int b = 0; b < m.body_count(); ++b) {
    double* pose = y + m.layout.pose(b);
    const double* twist = y + m.layout.twist(b);
    view<3>(pose) += h * view<3>(twist);
    const Vec3d turn = h * view<3>(twist + 3);
    if (m.description.orientation == Orientation::quaternion) {
      auto q = view<4>(pose + 3);
      q = rotate_quaternion(turn, q);
    } else {
      auto phi = view<3>(pose + 3);
      const Vec4d q = rotate_quaternion(turn, quaternion_from_rotation(rotation_from_euler_xyz<double>(phi)));
      const Vec3d turned = euler_xyz_from_rotation(rotation_from_quaternion<double>(q));
      // No angle jumps by a whole turn.
      for (int i = 0; i < 3; ++i) phi[i] += wrap_angle(turned[i] - phi[i]);
    }
  }
}

bool PoseMap::move_jacobian(double h, const double* y, double* out) {
  const StateLayout& s = model_.layout;
  Eigen::Map<MatXd> slopes(out, s.velocity, s.size - s.velocity);
  slopes.setZero();
  std::copy_n(y, s.size, moved_.data());
  move(h, moved_.data());
  for (int b = 0; b < s.bodies; ++b) {
    const int pose = s.pose(b), column = s.twist(b) - s.velocity;
    slopes.block<3, 3>(pose, column) = h * Mat3d::Identity();
    const Mat3d turn = h * exponential_slope(h * view<3>(y + s.twist(b) + 3));
    const double* angles = moved_.data() + pose + 3;
    for (int i = 0; i < 3; ++i) {
      if (s.pose_size == 7) {
        slopes.block<4, 1>(pose + 3, column + 3 + i) = quaternion_rate<double>(view<4>(angles), turn.col(i));
      } else {
        slopes.block<3, 1>(pose + 3, column + 3 + i) = euler_xyz_rate<double>(view<3>(angles), turn.col(i));
      }
    }
  }
  return true;
}

}  // namespace seacrane
