#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/integrate/position_map.hpp"
#include "seacrane/integrate/system.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

class RedundantSystem;
struct Model;

/// How near constraint rows are to depending on each other, beyond those that do from the start.
struct Dependence {
  double ratio = 0.0;  // the inverse of what is left of the worst row, at the last factorisation; 0: no rows
  int redundant = 0;   // combinations of rows that depend on the others from the start
  int left_out = 0;    // those not enforced at the last factorisation
  int most_left_out = 0;  // the same, at any since it was taken last

  bool lost_rank() const { return most_left_out > redundant; }
  /// The start was the singular position.
  bool gained_rank() const { return left_out < redundant; }
};

/// Combinations of rows that depend on the others in the assembled model; of a model that was not assembled,
/// another set of limits, the fewest left out so far, `known` (-1: none yet) or `left_out`.
int redundant_rows(const Model& model, int known, int left_out);

/// A system of bodies in some choice of coordinates, which can be told from the poses and twists of all
/// bodies (the state of the redundant form, StateLayout) and back without loss.
class Formulation : public System {
 public:
  virtual const char* name() const = 0;
  virtual PositionMap& positions() = 0;
  /// Typical magnitude per state component; infinity: not in the error norm.
  virtual std::vector<double> scale() const = 0;
  virtual void read_bodies(double t, const double* bodies, double* y) = 0;
  virtual void write_bodies(double t, const double* y, double* bodies) = 0;
  /// Accelerations of the bodies' state points at the last derivative(), in the order of the model.
  virtual const std::vector<Vec6d>& accelerations() = 0;
  /// What `load` alone adds to these accelerations: M^-1 load of the bodies as they are joined, through the
  /// factors of the last derivative(). Both hold a wrench or an acceleration for each body that is stepped,
  /// at its state point in inertial axes, and one for the ground at the end. For J^T of unit forces these are
  /// the columns of M^-1 J^T.
  virtual void load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) = 0;
  /// The redundant system that its loads come from: inputs, the limit of curves and histories are set there.
  virtual RedundantSystem& loads_from() = 0;
  /// Digits lost at the last derivative(): the factor by which rounding may have grown.
  virtual double condition() const = 0;
  virtual Dependence take_dependence() = 0;
  /// Largest residual seen by project() before it corrected anything, since the last call.
  virtual double take_residual_before_projection() = 0;
  /// What a state component is, for messages.
  virtual std::string describe(std::size_t component) const = 0;
};

/// What steps the model of `bodies`: its merged bodies where it has such, in either formulation; else the
/// formulation "recursive" on the loads of `bodies`, or null for "redundant": that is `bodies` itself.
/// Throws std::invalid_argument for a name or a scene that does not fit.
std::unique_ptr<Formulation> make_formulation(const std::string& name, RedundantSystem& bodies);

}  // namespace seacrane
