#pragma once

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

/// Kinetic energy for the twists in y, with the added mass of vessels and what loads add; inertia as `terms`
/// evaluated it last.
double kinetic_energy(const Terms& terms, const double* y);
/// Kinetic energy plus potential energy of gravity, springs and restoring, likewise.
double mechanical_energy(const Terms& terms, double t, const double* y);
/// Evaluates the terms at (t, y) first.
double mechanical_energy_at(Terms& terms, double t, const double* y);

}  // namespace seacrane
