#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "seacrane/elements/check.hpp"
#include "seacrane/math/dual.hpp"

namespace seacrane {

/// Tension of a line by its strain: EA e, or a table through whose rows runs a monotone cubic spline
/// (Fritsch, Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300), beyond its end on along its tangent.
class LineElasticity {
 public:
  LineElasticity() = default;
  LineElasticity(double stiffness, std::vector<double> strains, std::vector<double> tensions)
      : stiffness_(stiffness), strains_(std::move(strains)), tensions_(std::move(tensions)) {
    if (strains_.empty()) return;
    find_slopes();
    energies_.push_back(0.0);
    for (std::size_t i = 0; i + 1 < strains_.size(); ++i) {
      const double h = strains_[i + 1] - strains_[i];
      energies_.push_back(energies_[i] + 0.5 * h * (tensions_[i] + tensions_[i + 1]) +
                          h * h / 12.0 * (slopes_[i] - slopes_[i + 1]));
    }
  }

  /// Tension of a strain of zero or more. Below zero the secant to the first row goes on, which tells how far
  /// the line is from being taut.
  template <class T>
  T tension(const T& strain) const {
    if (strains_.empty()) return T(stiffness_) * strain;
    const Piece p = piece(strain);
    const T x = strain - T(p.start);
    return T(p.a[0]) + x * (T(p.a[1]) + x * (T(p.a[2]) + x * T(p.a[3])));
  }
  /// Integral of the tension over the strain, J for each metre.
  template <class T>
  T energy(const T& strain) const {
    if (strains_.empty()) return T(0.5 * stiffness_) * strain * strain;
    const Piece p = piece(strain);
    const T x = strain - T(p.start);
    return T(p.energy) +
           x * (T(p.a[0]) + x * (T(p.a[1] / 2.0) + x * (T(p.a[2] / 3.0) + x * T(p.a[3] / 4.0))));
  }
  bool is_table() const { return !strains_.empty(); }

  static void check(const std::vector<double>& strains, const std::vector<double>& tensions, const Check& c) {
    if (strains.size() != tensions.size() || strains.size() == 1) {
      c.fail("has " + std::to_string(strains.size()) + " strains and " + std::to_string(tensions.size()) +
             " tensions; give as many of both, at least two");
    }
    for (std::size_t i = 0; i < strains.size(); ++i) {
      if (i == 0 && (strains[0] != 0.0 || tensions[0] != 0.0)) {
        c.fail("its table starts with strain " + to_text(strains[0]) + " and tension " +
               to_text(tensions[0]) + " N; start with 0 and 0");
      }
      if (i > 0 && !(strains[i] > strains[i - 1] && tensions[i] > tensions[i - 1])) {
        c.fail("its table does not increase at strain " + to_text(strains[i]) + " with tension " +
               to_text(tensions[i]) + " N; give strains and tensions that both increase");
      }
    }
  }

 private:
  /// A cubic from the start of a piece on.
  struct Piece {
    double start, energy;
    std::array<double, 4> a;
  };

  template <class T>
  Piece piece(const T& strain) const {
    if (strain < T(0)) return {0.0, 0.0, {0.0, tensions_[1] / strains_[1], 0.0, 0.0}};
    if (!(strain < T(strains_.back()))) {
      return {strains_.back(), energies_.back(), {tensions_.back(), slopes_.back(), 0.0, 0.0}};
    }
    const auto next = std::upper_bound(strains_.begin() + 1, strains_.end() - 1, value_of(strain));
    const auto i = static_cast<std::size_t>(next - strains_.begin()) - 1;
    const double h = strains_[i + 1] - strains_[i], secant = (tensions_[i + 1] - tensions_[i]) / h;
    return {strains_[i],
            energies_[i],
            {tensions_[i], slopes_[i], (3.0 * secant - 2.0 * slopes_[i] - slopes_[i + 1]) / h,
             (slopes_[i] + slopes_[i + 1] - 2.0 * secant) / (h * h)}};
  }

  void find_slopes() {
    const std::size_t n = strains_.size();
    std::vector<double> h, secant;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      h.push_back(strains_[i + 1] - strains_[i]);
      secant.push_back((tensions_[i + 1] - tensions_[i]) / h[i]);
    }
    slopes_.assign(n, secant[0]);
    if (n == 2) return;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double w1 = 2.0 * h[i] + h[i - 1], w2 = h[i] + 2.0 * h[i - 1];
      slopes_[i] = (w1 + w2) / (w1 / secant[i - 1] + w2 / secant[i]);
    }
    slopes_[0] = end_slope(h[0], h[1], secant[0], secant[1]);
    slopes_[n - 1] = end_slope(h[n - 2], h[n - 3], secant[n - 2], secant[n - 3]);
  }
  /// The slope of the parabola through three rows at its end, kept monotone.
  static double end_slope(double h, double next_h, double secant, double next) {
    const double slope = ((2.0 * h + next_h) * secant - h * next) / (h + next_h);
    return std::max(slope, 0.0);
  }

  double stiffness_ = 0.0;
  std::vector<double> strains_, tensions_, slopes_, energies_;
};

}  // namespace seacrane
