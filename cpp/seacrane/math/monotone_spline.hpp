#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "seacrane/math/types.hpp"

namespace seacrane {

/// Cubic spline through rows of N numbers that do not fall, and that does not fall either: C2 (de Boor, A
/// Practical Guide to Splines, ch. IV), but for knots at which its slope is bounded by three times that of
/// the chords beside it (F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238). Flat after the
/// last knot; the slope at the first is that of the cubic through the first four.
template <int N>
class MonotoneSpline {
 public:
  using Row = Eigen::Matrix<double, N, 1>;
  template <class T>
  struct At {
    Eigen::Matrix<T, N, 1> value, slope;
  };

  MonotoneSpline() = default;
  /// At least two increasing places; the caller has checked them.
  MonotoneSpline(const std::vector<double>& places, const std::vector<Row>& values) : places_(places) {
    const std::size_t n = places.size();
    const std::vector<Row> slope = bounded(slopes(places, values), places, values);
    Row sum = Row::Zero();
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double h = places[i + 1] - places[i];
      const Row chord = (values[i + 1] - values[i]) / h;
      pieces_.push_back({values[i], slope[i], (3.0 * chord - 2.0 * slope[i] - slope[i + 1]) / h,
                         (slope[i] + slope[i + 1] - 2.0 * chord) / (h * h)});
      integral_.push_back(sum);
      sum += integral_of(pieces_.back(), h);
    }
    integral_.push_back(sum);
    last_ = values.back();
  }

  const std::vector<double>& places() const { return places_; }

  /// From the first knot on.
  template <class T>
  At<T> at(const T& place) const {
    At<T> out;
    if (place >= T(places_.back())) {
      out.value = last_.template cast<T>();
      out.slope.setZero();
      return out;
    }
    const std::size_t i = piece(place);
    const T x = place - T(places_[i]);
    const Piece& p = pieces_[i];
    for (int k = 0; k < N; ++k) {
      out.value[k] = T(p[0][k]) + x * (T(p[1][k]) + x * (T(p[2][k]) + x * T(p[3][k])));
      out.slope[k] = T(p[1][k]) + x * (T(2.0 * p[2][k]) + x * T(3.0 * p[3][k]));
    }
    return out;
  }

  /// From the first knot to `place`.
  Row integral(double place) const {
    if (place >= places_.back()) return integral_.back() + (place - places_.back()) * last_;
    const std::size_t i = piece(place);
    return integral_[i] + integral_of(pieces_[i], place - places_[i]);
  }

 private:
  using Piece = std::array<Row, 4>;

  template <class T>
  std::size_t piece(const T& place) const {
    const auto next = std::upper_bound(places_.begin() + 1, places_.end() - 1, place);
    return static_cast<std::size_t>(next - places_.begin()) - 1;
  }
  static Row integral_of(const Piece& p, double x) {
    return x * (p[0] + x * (p[1] / 2.0 + x * (p[2] / 3.0 + x * p[3] / 4.0)));
  }

  /// Of the polynomial through the first few points.
  static Row first_slope(const std::vector<double>& x, const std::vector<Row>& y) {
    const std::size_t n = std::min<std::size_t>(x.size(), 4);
    Row out = Row::Zero();
    for (std::size_t j = 1; j < n; ++j) {  // derivatives of Lagrange's polynomials at x[0]
      double weight = 1.0 / (x[j] - x[0]);
      for (std::size_t k = 1; k < n; ++k) {
        if (k != j) weight *= (x[0] - x[k]) / (x[j] - x[k]);
      }
      out += weight * (y[j] - y[0]);
    }
    return out;
  }

  /// Slopes at the knots with continuous second derivatives: a tridiagonal system.
  static std::vector<Row> slopes(const std::vector<double>& x, const std::vector<Row>& y) {
    const std::size_t n = x.size();
    std::vector<Row> out(n, Row::Zero());
    std::vector<double> above(n, 0.0);
    out[0] = first_slope(x, y);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double h = x[i] - x[i - 1], next = x[i + 1] - x[i];
      const Row right = 3.0 * ((y[i] - y[i - 1]) * (next / h) + (y[i + 1] - y[i]) * (h / next));
      const double pivot = 2.0 * (h + next) - next * above[i - 1];
      above[i] = h / pivot;
      out[i] = (right - next * out[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 1;) out[i] -= above[i] * out[i + 1];
    return out;
  }

  static std::vector<Row> bounded(std::vector<Row> slope, const std::vector<double>& x,
                                  const std::vector<Row>& y) {
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const Row most = 3.0 / (x[i + 1] - x[i]) * (y[i + 1] - y[i]);
      for (Row* const one : {&slope[i], &slope[i + 1]}) *one = one->cwiseMin(most).cwiseMax(0.0);
    }
    return slope;
  }

  std::vector<double> places_;
  std::vector<Piece> pieces_;
  std::vector<Row> integral_;
  Row last_ = Row::Zero();
};

}  // namespace seacrane
