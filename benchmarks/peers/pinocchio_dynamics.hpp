#pragma once

#include <memory>

#include "loads.hpp"

/// Pinocchio: kinematic tree, the two cylinder loops closed by point
/// constraints with Baumgarte stabilisation (1/s); constraintDynamics. State:
/// coordinates, then their rates. In a file of its own, as it compiles long.
class PinocchioDynamics {
public:
  PinocchioDynamics(const TreeData &tree, double baumgarte);
  ~PinocchioDynamics();

  void operator()(double t, const double *y, double *rate);
  std::array<double, 3> payload(const std::vector<double> &y);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};
