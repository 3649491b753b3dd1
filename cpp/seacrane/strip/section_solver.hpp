#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "seacrane/strip/section_panels.hpp"
#include "seacrane/strip/section_radiation.hpp"

namespace seacrane::strip {

/// One section's answer at one frequency.
struct SectionSolution {
  SectionCoefficients coefficients;
  Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 3> potential;  // per hull panel and unit velocity, m2/s
};

/// Close-fit sources (Frank, 1967) on straight panels, with the pulsating source of deep water
///
///     2 pi G = ln(r / r') + 2 Re[exp(-w) Ei(w)] + 2 pi i Re[exp(-w)],   w = i nu (z - conj c)
///
/// (Wehausen and Laitone, Surface waves, 1960), nu = omega^2 / g, z = y + i z the field point, c
/// the source, r' the distance to its image above the surface. Sources on the interior free surface close it
/// with a rigid lid, which removes the irregular frequencies: there G_z = nu G - delta, so that the lid's own
/// density is sigma = nu phi. Port-starboard symmetry halves the unknowns, heave being even, sway and roll
/// odd.
///
/// The imaginary part of G is, for each parity, a product of one function of z and one of c: the wave that is
/// radiated. It enters as a rank-one change of a real system (Sherman and Morrison).
///
/// Immutable after construction; `solve` may be called from several threads.
class SectionSolver {
 public:
  SectionSolver(const HalfSection& section, const SectionSettings& settings);

  SectionSolution solve(double omega) const;
  SectionLimits limits() const;
  const SectionPanels& panels() const { return panels_; }

 private:
  enum Parity { even, odd };

  /// Per row a collocation point, per column a panel and its mirror image: potential at all points, normal
  /// velocity at those on the hull.
  struct Influence {
    Eigen::MatrixXd potential, velocity;
  };

  void fill_row(Eigen::Index i);
  void conserve_flux();
  std::array<Influence, 2> wave_influence(double nu) const;
  void solve_parity(Parity parity, double nu, const Influence& wave, SectionSolution& out) const;
  Eigen::Matrix3d limit(double image_sign, bool with_heave) const;
  Eigen::Matrix3cd pressure_integral(const Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 3>& p) const;

  SectionSettings settings_;
  SectionPanels panels_;
  Eigen::MatrixX3d mode_;                    // of each hull panel: n_y, n_z, y n_z - z n_y
  std::array<Influence, 2> direct_, image_;  // of ln r and ln r' / (2 pi)
  std::array<Eigen::MatrixXcd, 2> log_;      // of w / nu at the nodes, for the points and their mirrors
};

}  // namespace seacrane::strip
