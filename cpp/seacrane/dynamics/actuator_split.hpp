#pragma once

#include <string>

#include "seacrane/elements/loads/actuator.hpp"

namespace seacrane {

struct Model;

/// Force of one actuator, where it acts, and its power.
struct ActuatorForce {
  CoordinateRow<double> row;
  double force, power;

  ActuatorForce(const Actuator& actuator, const LoadInput<double>& in)
      : row(evaluate_coordinate<double>(actuator.coordinate, first(actuator, in), second(actuator, in))),
        force(actuator.force(in, row)),
        power(force * coordinate_rate<double>(row, first(actuator, in), second(actuator, in))) {}

  /// The wrenches of a unit force, added to those of the two bodies.
  void add_unit(const Actuator& actuator, Vec6d* loads) const {
    loads[actuator.coordinate.joint.first] += row.da;
    loads[actuator.coordinate.joint.second] += row.db;
  }

 private:
  static const BodyKinematics<double>& first(const Actuator& a, const LoadInput<double>& in) {
    return in.bodies[a.coordinate.joint.first];
  }
  static const BodyKinematics<double>& second(const Actuator& a, const LoadInput<double>& in) {
    return in.bodies[a.coordinate.joint.second];
  }
};

/// The fast part of a multibody system: what the actuators' forces have changed since the split accelerates
/// the bodies as it would at the state of the split, without waves, fluid or a new solution of the
/// constraints; and all positions move with the velocities. R is the response to unit forces there:
///   q' = N(q) v,   v' = sum_k R_k (F_k(t, q, v) - F_k at the split),   work' = sum_k F_k (rate of k).
/// Stiffness and damping of the controllers are in it, exactly; the rest of f is slow as long as R changes
/// little in a step. `Response` is whatever a formulation keeps of R_k.
template <class Response>
struct SplitActuator {
  double force = 0.0;
  Response response;
};

/// Empty, or why a model has no fast part.
std::string missing_fast_part(const Model& model);

}  // namespace seacrane
