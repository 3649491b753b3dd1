#include "seacrane/strip/section_solver.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "seacrane/math/dense.hpp"
#include "seacrane/strip/complex.hpp"
#include "seacrane/strip/exponential_integral.hpp"

namespace seacrane::strip {
namespace {

using Eigen::Index;
constexpr double pi = std::numbers::pi;

constexpr std::array<int, 3> parity_of_mode{1, 0, 1};  // sway odd, heave even, roll odd

struct PotentialAndVelocity {
  double potential, velocity;
};

/// Potential ln r of a panel of unit density, and its derivative along `normal`, divided by 2 pi.
PotentialAndVelocity log_influence(Complex field, Complex normal, const SectionPanels& panels, std::size_t j,
                                   bool on_panel) {
  const Complex along = std::conj(panels.direction(j));
  const double length = panels.length(j);
  const Complex from_start = along * (field - panels.start(j));
  const double u1 = from_start.real(), u2 = u1 - length, v = on_panel ? 0.0 : from_start.imag();
  const double log1 = std::log(u1 * u1 + v * v), log2 = std::log(u2 * u2 + v * v);
  const double angle = on_panel ? pi : std::atan2(v * length, u1 * u2 + v * v);
  const Complex local = normal * along;
  return {(0.5 * (u1 * log1 - u2 * log2) - length + v * angle) / (2.0 * pi),
          (0.5 * local.real() * (log1 - log2) + local.imag() * angle) / (2.0 * pi)};
}

/// The imaginary part of G for one parity, a product of the two sides of a source: what a wave is at the
/// collocation points (as potential, and as row of the system) and how much of it a panel and its mirror
/// send.
struct RadiatedWave {
  Eigen::VectorXd potential, in_system, of_source;
};

RadiatedWave radiated_wave(const SectionPanels& panels, double nu, bool odd) {
  const auto n = static_cast<Index>(panels.count()), lid = static_cast<Index>(panels.lid);
  RadiatedWave out{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  const auto at_source = [&](Complex c) { return std::exp(i_unit * nu * std::conj(c)); };
  for (Index i = 0; i < n; ++i) {
    const Complex wave = (odd ? i_unit : 1.0) * std::exp(-i_unit * nu * panels.middle(i));
    out.potential[i] = wave.real();
    out.in_system[i] = i < lid ? nu * wave.real() : (-i_unit * nu * wave * panels.normal(i)).real();
    const Complex change = at_source(panels.end(i)) - at_source(panels.start(i));
    const Complex integral = change * panels.direction(i) / (i_unit * nu);
    out.of_source[i] = 2.0 * (odd ? integral.imag() : integral.real());
  }
  return out;
}

}  // namespace

SectionSolver::SectionSolver(const HalfSection& section, const SectionSettings& settings)
    : settings_(settings), panels_(make_panels(thickened(section), settings.panels)) {
  const auto n = static_cast<Index>(panels_.count()), lid = static_cast<Index>(panels_.lid);
  mode_.resize(n - lid, 3);
  for (auto* influence : {&direct_, &image_}) {
    for (Influence& of_parity : *influence) {
      of_parity.potential.resize(n, n);
      of_parity.velocity.resize(n - lid, n);
    }
  }
  for (Eigen::MatrixXcd& log : log_) log.resize(n + 1, n);
  for (Index i = 0; i < n; ++i) fill_row(i);
  conserve_flux();
}

/// What does not depend on frequency, at one collocation point.
void SectionSolver::fill_row(Index i) {
  const auto n = static_cast<Index>(panels_.count()), lid = static_cast<Index>(panels_.lid);
  const Complex z = panels_.middle(i), normal = panels_.normal(i);
  if (i >= lid) {
    mode_.row(i - lid) << normal.real(), normal.imag(), z.real() * normal.imag() - z.imag() * normal.real();
  }
  for (Index j = 0; j < n; ++j) {
    // A panel's mirror images act at z as the panel itself does at the mirror images of z.
    const auto at = [&](Complex field, Complex n_field, bool on_panel = false) {
      return log_influence(field, n_field, panels_, j, on_panel);
    };
    const auto direct = at(z, normal, i == j), mirrored = at(-std::conj(z), -std::conj(normal));
    const auto above = at(std::conj(z), std::conj(normal), i == j && i < lid), opposite = at(-z, -normal);
    for (int parity : {even, odd}) {
      const double sign = parity == even ? 1.0 : -1.0;
      direct_[parity].potential(i, j) = direct.potential + sign * mirrored.potential;
      image_[parity].potential(i, j) = above.potential + sign * opposite.potential;
      if (i < lid) continue;
      direct_[parity].velocity(i - lid, j) = direct.velocity + sign * mirrored.velocity;
      image_[parity].velocity(i - lid, j) = above.velocity + sign * opposite.velocity;
    }
  }
  for (int side : {0, 1}) {
    const Complex field = side == 0 ? z : -std::conj(z);
    for (Index j = 0; j <= n; ++j) {
      log_[side](j, i) = std::log(i_unit * (field - std::conj(panels_.node[j])));
    }
  }
}

/// The flux of a source through the closed outline of hull and image is its strength. Midpoints miss it by
/// the curvature within a panel, a first-order error, which goes to the diagonal where it came from.
void SectionSolver::conserve_flux() {
  const auto lid = static_cast<Index>(panels_.lid), hull = static_cast<Index>(panels_.count()) - lid;
  Eigen::VectorXd length(hull);
  for (Index j = 0; j < hull; ++j) length[j] = panels_.length(lid + j);
  const Eigen::VectorXd flux =
      (direct_[even].velocity + image_[even].velocity).rightCols(hull).transpose() * length;
  for (Index j = 0; j < hull; ++j) {
    const double missing = 1.0 - flux[j] / length[j];
    for (Influence& of_parity : direct_) of_parity.velocity(j, lid + j) += missing;
  }
}

/// (1/pi) Re of the integrals of exp(-w) Ei(w) over the panels: with W' = -W + 1/w they are differences of
/// W and ln w between the nodes.
std::array<SectionSolver::Influence, 2> SectionSolver::wave_influence(double nu) const {
  const auto n = static_cast<Index>(panels_.count()), lid = static_cast<Index>(panels_.lid);
  std::array<Influence, 2> out;
  for (Influence& of_parity : out) {
    of_parity.potential.setZero(n, n);
    of_parity.velocity.setZero(n - lid, n);
  }
  const double log_nu = std::log(nu);
  std::vector<Complex> at_node(panels_.node.size());
  for (std::size_t j = 0; j < at_node.size(); ++j) {
    at_node[j] = std::exp(i_unit * nu * std::conj(panels_.node[j]));
  }
  std::vector<Complex> direction(panels_.count());
  for (std::size_t j = 0; j < direction.size(); ++j) direction[j] = panels_.direction(j);
  for (Index i = 0; i < n; ++i) {
    for (int side : {0, 1}) {
      const Complex z = panels_.middle(i), field = side == 0 ? z : -std::conj(z);
      const Complex normal = side == 0 ? panels_.normal(i) : -std::conj(panels_.normal(i));
      const Complex at_field = std::exp(-i_unit * nu * field);
      const auto wave = [&](Index j) {
        const Complex w = i_unit * nu * (field - std::conj(panels_.node[j]));
        return decaying_exponential_integral(w, at_field * at_node[j], log_[side](j, i) + log_nu);
      };
      Complex before = wave(0);
      for (Index j = 0; j < n; ++j) {
        const Complex after = wave(j + 1), change = after - before;
        before = after;
        const double potential =
            (i_unit * direction[j] * (log_[side](j + 1, i) - log_[side](j, i) - change)).real() / (pi * nu);
        const double velocity = -(direction[j] * change * normal).real() / pi;
        for (int parity : {even, odd}) {
          const double sign = side == 0 || parity == even ? 1.0 : -1.0;
          out[parity].potential(i, j) += sign * potential;
          if (i >= lid) out[parity].velocity(i - lid, j) += sign * velocity;
        }
      }
    }
  }
  return out;
}

/// -rho times the integral of the potentials over the whole section with the normals of the modes.
Eigen::Matrix3cd SectionSolver::pressure_integral(
    const Eigen::Matrix<Complex, Eigen::Dynamic, 3>& potential) const {
  const auto lid = static_cast<Index>(panels_.lid);
  Eigen::Matrix3cd sum = Eigen::Matrix3cd::Zero();
  for (Index i = 0; i < potential.rows(); ++i) {
    const double length = panels_.length(lid + i);
    sum += (2.0 * settings_.rho * length) * mode_.row(i).transpose().cast<Complex>() * potential.row(i);
  }
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) {
      if (parity_of_mode[j] != parity_of_mode[k]) sum(j, k) = 0.0;  // port and starboard cancel
    }
  }
  return -sum;
}

/// Solves one parity's modes; the real system has the standing waves, and a rank-one change the radiated one.
void SectionSolver::solve_parity(Parity parity, double nu, const Influence& wave,
                                 SectionSolution& out) const {
  const auto n = static_cast<Index>(panels_.count()), lid = static_cast<Index>(panels_.lid), hull = n - lid;
  const Eigen::MatrixXd potential = direct_[parity].potential - image_[parity].potential + wave.potential;
  Eigen::MatrixXd system(n, n);
  system.topRows(lid) = nu * potential.topRows(lid);
  for (Index i = 0; i < lid; ++i) system(i, i) -= 1.0;
  system.bottomRows(hull) = direct_[parity].velocity - image_[parity].velocity + wave.velocity;
  const RadiatedWave radiated = radiated_wave(panels_, nu, parity == odd);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(system);
  const Eigen::VectorXd response = lu.solve(radiated.in_system);
  const double feedback = radiated.of_source.dot(response);
  for (int mode = 0; mode < 3; ++mode) {
    if (parity_of_mode[mode] != parity) continue;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    right.tail(hull) = mode_.col(mode);
    const Eigen::VectorXd standing = lu.solve(right);
    const Complex amplitude = radiated.of_source.dot(standing) / (1.0 + i_unit * feedback);
    const Eigen::VectorXcd density = standing.cast<Complex>() - (i_unit * amplitude) * response;
    out.potential.col(mode) =
        potential.bottomRows(hull) * density + (i_unit * amplitude) * radiated.potential.tail(hull);
    out.coefficients.wave_amplitude[mode] = nu * amplitude * (parity == even ? i_unit : Complex(-1.0));
  }
}

SectionSolution SectionSolver::solve(double omega) const {
  SectionSolution out;
  out.potential.setZero(static_cast<Index>(panels_.count() - panels_.lid), 3);
  out.coefficients.wave_amplitude.setZero();
  const double nu = omega * omega / settings_.g;
  if (panels_.count() > 0) {
    const std::array<Influence, 2> wave = wave_influence(nu);
    for (Parity parity : {even, odd}) solve_parity(parity, nu, wave[parity], out);
  }
  const Eigen::Matrix3cd force = pressure_integral(out.potential);  // a + b / (i omega)
  out.coefficients.added_mass = force.real();
  out.coefficients.damping = -omega * force.imag();
  return out;
}

/// Added mass with ln r and +-ln r' alone: a surface without pressure (-1) or a wall (+1).
Eigen::Matrix3d SectionSolver::limit(double image_sign, bool with_heave) const {
  const auto lid = static_cast<Index>(panels_.lid), hull = static_cast<Index>(panels_.count()) - lid;
  Eigen::Matrix<Complex, Eigen::Dynamic, 3> potential(hull, 3);
  potential.setZero();
  for (int parity : {even, odd}) {
    if (hull == 0 || (parity == even && !with_heave)) continue;
    const Eigen::MatrixXd velocity =
        (direct_[parity].velocity + image_sign * image_[parity].velocity).rightCols(hull);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(velocity);
    const Eigen::MatrixXd value =
        (direct_[parity].potential + image_sign * image_[parity].potential).bottomRightCorner(hull, hull);
    for (int mode = 0; mode < 3; ++mode) {
      if (parity_of_mode[mode] == parity) {
        potential.col(mode) = (value * lu.solve(mode_.col(mode))).cast<Complex>();
      }
    }
  }
  return pressure_integral(potential).real();
}

SectionLimits SectionSolver::limits() const {
  SectionLimits out{limit(-1.0, true), limit(1.0, false)};
  if (panels_.count() > 0) out.zero(1, 1) = std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace seacrane::strip
