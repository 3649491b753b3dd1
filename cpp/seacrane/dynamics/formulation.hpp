#pragma once

#include <string>
#include <vector>

#include "seacrane/dynamics/dependence.hpp"
#include "seacrane/integrate/problem.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

class Terms;

/// A system of bodies in some choice of coordinates, which follows from the poses and twists of all
/// bodies (StateLayout) and back without loss.
class Formulation : public System {
 public:
  virtual const char* name() const = 0;
  virtual PositionMap& positions() = 0;
  /// Typical magnitude per state component; infinity: not in the error norm.
  virtual std::vector<double> scale() const = 0;
  virtual void read_bodies(double t, const double* bodies, double* y) = 0;
  virtual void write_bodies(double t, const double* y, double* bodies) = 0;
  /// Sets the kinematics of its terms to those of a state.
  virtual void place_bodies(double t, const double* y) = 0;
  /// Whether no state leaves a joint open, or a driver behind, by more than rounding.
  virtual bool closes_joints() const = 0;
  /// Accelerations of the bodies' state points at the last derivative(), in the order of the model.
  virtual const std::vector<Vec6d>& accelerations() const = 0;
  /// Time of the last derivative(); not a number before it.
  virtual double evaluated_at() const = 0;
  /// At the last derivative(), of an element that holds a distance its tension, N, of a driver its force or
  /// moment; not a number where it is not known.
  virtual double tension(int element) const = 0;
  /// What `load` alone adds to these accelerations: M^-1 load of the bodies as they are joined, through the
  /// factors of the last derivative(). Both hold a wrench or an acceleration for each body that is stepped,
  /// at its state point in inertial axes, and one for the ground at the end. For J^T of unit forces these are
  /// the columns of M^-1 J^T.
  virtual void load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) = 0;
  /// The response over the components of the state: what power `load` has for each of their rates, and their
  /// rates under it. Both are zero but for speeds.
  virtual void load_direction(const std::vector<Vec6d>& load, double* power, double* rates) = 0;
  /// Its terms: inputs, the limit of curves and histories are set there.
  virtual Terms& terms() = 0;
  virtual Dependence take_dependence() = 0;
  /// Largest residual seen by project() before it corrected anything, since the last call.
  virtual double take_residual_before_projection() = 0;
  /// What a state component is, for messages.
  virtual std::string describe(std::size_t component) const = 0;
};

}  // namespace seacrane
