#pragma once

#include "seacrane/hydro/vessel.hpp"
#include "seacrane/math/spd_inverse.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Inertia of one body in inertial axes about its state point, and its velocity-dependent load b.
struct BodyInertia {
  double inverse_mass = 0.0;
  Mat3d inverse_inertia;  // compact bodies: about the centre of mass
  Mat6d mass, inverse;    // bodies with hydrodynamics: full 6 x 6
  bool full = false;
};

/// Compact body (state point = centre of mass): b = (0, omega x J omega), eq (5).
inline Vec6d compact_inertia(const BodyModel& body, const BodyKinematics<double>& k, BodyInertia& out) {
  out.full = false;
  out.inverse_mass = 1.0 / body.mass;
  out.inverse_inertia.noalias() = (k.rotation * body.inverse_inertia) * k.rotation.transpose();
  const Vec3d w = k.rotation.transpose() * k.angular_velocity;
  const Vec3d momentum = k.rotation * (body.inertia * w);
  Vec6d bias;
  bias << Vec3d::Zero(), k.angular_velocity.cross(momentum);
  return bias;
}

/// Rigid-body mass matrix about the state point, eq (12), in inertial axes; `inertia` about the centre of
/// mass, body axes.
inline Mat6d rigid_mass_matrix(const BodyModel& body, const Mat3d& rotation, const Mat3d& inertia) {
  const Vec3d c = rotation * body.center_of_mass;
  const Mat3d s = skew<double>(c);
  Mat6d m;
  m.topLeftCorner<3, 3>() = body.mass * Mat3d::Identity();
  m.topRightCorner<3, 3>() = -body.mass * s;
  m.bottomLeftCorner<3, 3>() = body.mass * s;
  m.bottomRightCorner<3, 3>() = (rotation * inertia) * rotation.transpose();
  m.bottomRightCorner<3, 3>() += (body.mass * c) * -c.transpose();  // -m s s = m (c.c - c c^T)
  m.diagonal().tail<3>().array() += body.mass * c.squaredNorm();
  return m;
}

inline Mat6d rigid_mass_matrix(const BodyModel& body, const Mat3d& rotation) {
  return rigid_mass_matrix(body, rotation, body.inertia);
}

/// The same with the body's shape, for a mass of one.
inline Mat6d shape_mass_matrix(const BodyModel& body, const Mat3d& rotation) {
  return rigid_mass_matrix(body, rotation, body.shape) / body.mass;
}

/// Vessel: rigid body about the reference point plus added mass in the yaw-following frame. Returns b.
inline Vec6d vessel_terms(const BodyModel& body, const Vessel& vessel, const BodyKinematics<double>& k,
                          const YawFrame<double>& frame, Mat6d& mass) {
  const Mat6d rigid = rigid_mass_matrix(body, k.rotation);
  mass = rigid + frame.to_inertial(vessel.added_mass);
  const Vec3d& w = k.angular_velocity;
  const Vec3d c = k.rotation * body.center_of_mass;
  const Vec3d angular = rigid.bottomRightCorner<3, 3>() * w;
  Vec6d bias;
  bias.head<3>() = body.mass * w.cross(w.cross(c));
  bias.tail<3>() = w.cross(angular);
  return bias + vessel.added_mass_bias(frame);
}

inline Vec6d vessel_inertia(const BodyModel& body, const Vessel& vessel, const BodyKinematics<double>& k,
                            const YawFrame<double>& frame, BodyInertia& out) {
  out.full = true;
  const Vec6d bias = vessel_terms(body, vessel, k, frame, out.mass);
  out.inverse = spd_inverse(out.mass);
  return bias;
}

inline Vec6d solve_inertia(const BodyInertia& inertia, const Vec6d& load) {
  if (inertia.full) return inertia.inverse * load;
  Vec6d out;
  out.head<3>() = inertia.inverse_mass * load.head<3>();
  out.tail<3>() = inertia.inverse_inertia * load.tail<3>();
  return out;
}

/// D M1^-1 of six padded rows with the body's shape divided by its mass: geometry without masses.
inline void rows_over_shape(const BodyModel& body, const BodyKinematics<double>& k, const Mat6d& d,
                            Mat6d& dw) {
  const Vec3d c = k.rotation * body.center_of_mass;
  const Mat3d angular = body.mass * (k.rotation * body.inverse_shape * k.rotation.transpose());
  // Velocity of the state point = that of the centre of mass + c x omega.
  const Mat3d cross = skew<double>(c);
  dw.leftCols<3>() = d.leftCols<3>();
  dw.rightCols<3>() = (d.rightCols<3>() + d.leftCols<3>() * cross) * angular;
  dw.leftCols<3>() -= dw.rightCols<3>() * cross;
}

/// D M^-1 of six padded rows.
inline void rows_over_mass(const BodyInertia& inertia, const Mat6d& d, Mat6d& dw) {
  if (inertia.full) {
    dw.noalias() = d * inertia.inverse;
    return;
  }
  dw.leftCols<3>() = inertia.inverse_mass * d.leftCols<3>();
  dw.rightCols<3>().noalias() = d.rightCols<3>() * inertia.inverse_inertia;
}

}  // namespace seacrane
