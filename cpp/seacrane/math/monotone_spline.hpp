#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "seacrane/math/pack.hpp"
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
  bool operator==(const MonotoneSpline&) const = default;

  /// From the first knot on.
  template <class T>
  At<T> at(const T& place) const {
    At<T> out;
    if (place >= T(places_.back())) {
      out.value = last_.template cast<T>();
      out.slope.setZero();
      return out;
    }
    return in_piece(piece(place), place);
  }
  template <int L>
  At<Pack<L>> at(const Pack<L>& place) const {
    const std::size_t first = place[0] < places_.back() ? piece(place[0]) : 0;
    if (all((place >= Pack<L>(places_[first])) & (place < Pack<L>(places_[first + 1])))) {
      return in_piece(first, place);
    }
    At<Pack<L>> out;
    for (int lane = 0; lane < L; ++lane) {
      const At<double> one = at(place[lane]);
      for (int k = 0; k < N; ++k) {
        out.value[k].set(lane, one.value[k]);
        out.slope[k].set(lane, one.slope[k]);
      }
    }
    return out;
  }

  /// From `from` to `to`, of which `to` is beyond the first knot, and before which all is zero: the mean, the
  /// slope of the chord, and how far the mean of the ends is above the mean, over the length.
  template <class T>
  struct Over {
    Eigen::Matrix<T, N, 1> mean, chord, bend;
  };
  template <class T>
  Over<T> over(const T& from, const T& to) const {
    Over<T> out;
    const T first = T(places_.front()), last = T(places_.back());
    if (from >= last) {
      out.mean = last_.template cast<T>();
      out.chord.setZero();
      out.bend.setZero();
      return out;
    }
    const bool starts = from >= first, ends = to <= last;
    const T low = starts ? from : first, high = ends ? to : last;
    const std::size_t i = piece(low), j = piece(high);
    const T a = low - T(places_[i]), b = high - T(places_[j]), length = to - from;
    for (int k = 0; k < N; ++k) {
      const Cubic p = cubic(i, k), q = cubic(j, k);
      if (starts && ends && i == j) {  // nothing is a difference of like numbers
        out.mean[k] = p.mean(a, b);
        out.chord[k] = p.chord(a, b);
        out.bend[k] = p.bend(a, b);
        continue;
      }
      T sum = ends ? T(0) : T((to - last) * T(last_[k]));
      if (i == j) {
        sum += (b - a) * p.mean(a, b);
      } else {
        const double end = places_[i + 1] - places_[i];
        sum +=
            (T(end) - a) * p.mean(a, T(end)) + T(integral_[j][k] - integral_[i + 1][k]) + b * q.mean(T(0), b);
      }
      const T left = starts ? p.at(a) : T(0), right = q.at(b);
      out.mean[k] = sum / length;
      out.chord[k] = (right - left) / length;
      out.bend[k] = (T(0.5) * (left + right) - out.mean[k]) / length;
    }
    return out;
  }

  template <int L>
  Over<Pack<L>> over(const Pack<L>& from, const Pack<L>& to) const {
    Over<Pack<L>> out;
    for (int lane = 0; lane < L; ++lane) {
      const Over<double> one = over(from[lane], to[lane]);
      for (int k = 0; k < N; ++k) {
        out.mean[k].set(lane, one.mean[k]);
        out.chord[k].set(lane, one.chord[k]);
        out.bend[k].set(lane, one.bend[k]);
      }
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
  /// One component of a piece, from its first knot; and between two of its places.
  struct Cubic {
    double c0, c1, c2, c3;

    template <class T>
    T at(const T& x) const {
      return T(c0) + x * (T(c1) + x * (T(c2) + x * T(c3)));
    }
    template <class T>
    T mean(const T& a, const T& b) const {
      const T sum = a + b, squares = a * a + b * b;
      return T(c0) + T(c1 / 2.0) * sum + T(c2 / 3.0) * (squares + a * b) + T(c3 / 4.0) * sum * squares;
    }
    template <class T>
    T chord(const T& a, const T& b) const {
      return T(c1) + T(c2) * (a + b) + T(c3) * (a * a + a * b + b * b);
    }
    template <class T>
    T bend(const T& a, const T& b) const {
      return (b - a) * (T(c2 / 6.0) + T(c3 / 4.0) * (a + b));
    }
  };
  Cubic cubic(std::size_t i, int k) const {
    const Piece& p = pieces_[i];
    return {p[0][k], p[1][k], p[2][k], p[3][k]};
  }

  template <class T>
  At<T> in_piece(std::size_t i, const T& place) const {
    At<T> out;
    const T x = place - T(places_[i]);
    const Piece& p = pieces_[i];
    for (int k = 0; k < N; ++k) {
      out.value[k] = T(p[0][k]) + x * (T(p[1][k]) + x * (T(p[2][k]) + x * T(p[3][k])));
      out.slope[k] = T(p[1][k]) + x * (T(2.0 * p[2][k]) + x * T(3.0 * p[3][k]));
    }
    return out;
  }

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
