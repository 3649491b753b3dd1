#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace seacrane {

struct CurveValue {
  double value = 0.0, rate = 0.0, acceleration = 0.0;
};

/// Where a curve is not smooth: its value and first three derivatives on either side. What differs by
/// rounding only is given as equal.
struct CurveKink {
  double time = 0.0;
  std::array<double, 4> before{}, after{};

  double jump(std::size_t derivative) const { return after[derivative] - before[derivative]; }
};

/// A reference curve of time: pieces of a quintic polynomial plus one cosine, each from its start on.
/// Before the first start the first value is held at rest; the last piece continues without end.
class Curve {
 public:
  struct Piece {
    double start = 0.0;
    std::array<double, 6> coefficients{};  // of (t - start)^k
    double amplitude = 0.0, omega = 0.0, phase = 0.0;
  };

  Curve() : Curve(std::vector<Piece>(1)) {}
  explicit Curve(std::vector<Piece> pieces);

  static Curve constant(double value);
  /// From `from` at t0 to `to` at t1 with zero rate and acceleration at both ends, held afterwards.
  static Curve quintic(double t0, double t1, double from, double to);
  /// offset + amplitude cos(omega (t - start) + phase).
  static Curve harmonic(double start, double offset, double amplitude, double omega, double phase);

  /// This curve until `time`, `next` afterwards.
  Curve then(double time, const Curve& next) const;

  /// Pieces that start at or after `before` are not used yet: a step that ends at a breakpoint sees
  /// the limit from the left in all its stages.
  CurveValue at(double t, double before = std::numeric_limits<double>::infinity()) const {
    if (t >= held_from_ && before > held_from_) return {pieces_.back().coefficients[0], 0.0, 0.0};
    return piece_at(t, before);
  }
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// The value that it has at all times; none where it moves.
  std::optional<double> constant_value() const;
  /// Starts of pieces where the value or one of its first three derivatives jumps.
  std::vector<CurveKink> kinks() const;
  /// Times where the value or one of its first `derivatives` (0 to 3) derivatives jumps.
  std::vector<double> breakpoints(int derivatives = 2) const;

 private:
  CurveValue piece_at(double t, double before) const;

  std::vector<Piece> pieces_;
  double held_from_ = std::numeric_limits<double>::infinity();  // a value from then on
};

}  // namespace seacrane
