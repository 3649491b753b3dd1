#pragma once

#include "seacrane/hydro/hydro_group.hpp"
#include "seacrane/math/spatial.hpp"
#include "seacrane/math/spd_inverse.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// Inertia of one body in inertial axes about its state point, and its velocity-dependent load b.
struct BodyInertia {
  double inverse_mass = 0.0;
  Mat3d inverse_inertia;  // compact bodies: about the centre of mass
  Mat6d mass, inverse;    // of a full 6 x 6
  bool full = false;
};

/// Blocks of the mass matrix and of its inverse between two bodies, first over second.
struct MassCoupling {
  int first = 0, second = 0;
  Mat6d mass = Mat6d::Zero(), inverse = Mat6d::Zero();

  /// What the blocks of the mass matrix (or of its inverse) make of vectors by body, added to `out`.
  void add_product(const Mat6d& block, const Vec6d* by_body, Vec6d* out) const {
    out[first].noalias() += block * by_body[second];
    out[second].noalias() += block.transpose() * by_body[first];
  }
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

/// A rigid body's mass, and its inertia about the centre of mass, body axes.
template <class T>
struct RigidMass {
  T mass;
  Vec3d center_of_mass;  // from the state point, body axes
  Mat3<T> inertia;

  /// About the state point, from which `c` leads to the centre of mass, inertial axes.
  LeverInertia<T> at(const Vec3<T>& c, const Mat3<T>& rotation) const {
    LeverInertia<T> out = LeverInertia<T>::zero();
    out.add(c, {mass, Symmetric3<T>::turned(rotation * inertia, rotation)});
    return out;
  }
  /// Its mass matrix, eq (12).
  Mat6<T> matrix(const Mat3<T>& rotation) const {
    SpatialInertia<T> out = SpatialInertia<T>::zero();
    out += at(times<T>(rotation, center_of_mass), rotation);
    return out.matrix();
  }
};

inline RigidMass<double> mass_of(const BodyModel& body) {
  return {body.mass, body.center_of_mass, body.inertia};
}

inline Mat6d rigid_mass_matrix(const BodyModel& body, const Mat3d& rotation) {
  return mass_of(body).matrix(rotation);
}

/// The mass matrix of a body of this shape and a mass of one.
inline Mat6d shape_mass_matrix(const BodyModel& body, const Mat3d& rotation) {
  return RigidMass<double>{body.mass, body.center_of_mass, body.shape}.matrix(rotation) / body.mass;
}

/// A body with a full mass, without what loads add to it, about its state point; of a vessel with its added
/// mass in the yaw-following frame. Returns b.
template <class T>
Wrench<T> full_terms(const Model& model, const BodyModel& body, const RigidMass<T>& rigid,
                     const BodyKinematics<T>& k, const YawFrame<T>* frames, SpatialInertia<T>& mass) {
  const Vec3<T>& w = k.angular_velocity;
  const Vec3<T> c = times<T>(k.rotation, rigid.center_of_mass);
  const LeverInertia<T> own = rigid.at(c, k.rotation);
  const Wrench<T> bias(rigid.mass * cross<T>(w, cross<T>(w, c)), cross<T>(w, own.turning * w));
  if (body.vessel < 0) {
    mass = SpatialInertia<T>::zero();
    mass += own;
    return bias;
  }
  const Vessel& vessel = model.vessels[idx(body.vessel)];
  const YawFrame<T>& frame = frames[body.vessel];
  mass = frame.inertia(vessel.added_mass);
  mass += own;
  Wrench<T> out = vessel.added_mass_bias(frame);
  out += bias;
  return out;
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
