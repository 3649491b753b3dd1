#include "seacrane/math/curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace seacrane {
namespace {

CurveValue evaluate(const Curve::Piece& p, double t) {
  const double s = t - p.start;
  const auto& c = p.coefficients;
  CurveValue out;
  out.value = c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
  out.rate = c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * 5 * c[5])));
  out.acceleration = 2 * c[2] + s * (6 * c[3] + s * (12 * c[4] + s * 20 * c[5]));
  if (p.amplitude != 0.0) {
    const double cosine = std::cos(p.omega * s + p.phase), sine = std::sin(p.omega * s + p.phase);
    out.value += p.amplitude * cosine;
    out.rate -= p.amplitude * p.omega * sine;
    out.acceleration -= p.amplitude * p.omega * p.omega * cosine;
  }
  return out;
}

bool is_still(const Curve::Piece& p) {
  const auto& c = p.coefficients;
  return p.amplitude == 0.0 && std::all_of(c.begin() + 1, c.end(), [](double x) { return x == 0.0; });
}

constexpr double kRounding = 1e-10;       // over the terms of a derivative, of which digits cancel
constexpr double kValueRounding = 1e-13;  // over the value, per length of a piece: of a spline's coefficients

/// Value and first three derivatives of a piece, and the sizes of the terms that they are sums of.
struct Side {
  std::array<double, 4> value{}, terms{};
};

Side held(double value) { return {{value}, {std::abs(value)}}; }

Side side_of(const Curve::Piece& p, double t) {
  const double s = t - p.start, cosine = std::cos(p.omega * s + p.phase),
               sine = std::sin(p.omega * s + p.phase);
  const double waves[4] = {cosine, -sine, -cosine, sine};
  Side out;
  double amplitude = p.amplitude;
  for (std::size_t k = 0; k < 4; ++k, amplitude *= p.omega) {
    out.value[k] = amplitude * waves[k];
    out.terms[k] = std::abs(amplitude);
    double power = 1.0;
    for (std::size_t n = k; n < 6; ++n, power *= s) {
      double term = p.coefficients[n] * power;
      for (std::size_t i = 0; i < k; ++i) term *= static_cast<double>(n - i);
      out.value[k] += term;
      out.terms[k] += std::abs(term);
    }
  }
  return out;
}

/// Whether something jumps between pieces of that length at least; what does not is made equal.
bool find_jumps(const Side& before, const Side& after, double length, CurveKink& kink) {
  bool any = false;
  double rounding = kValueRounding * (before.terms[0] + after.terms[0]);
  for (std::size_t k = 0; k < 4; ++k, rounding /= length) {
    const bool jumps = std::abs(after.value[k] - before.value[k]) >
                       kRounding * (before.terms[k] + after.terms[k]) + rounding;
    kink.before[k] = before.value[k];
    kink.after[k] = jumps ? after.value[k] : before.value[k];
    any = any || jumps;
  }
  return any;
}

}  // namespace

Curve::Curve(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  if (pieces_.empty()) throw std::invalid_argument("curve: has no pieces; give at least one");
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& p = pieces_[i];
    bool finite = std::isfinite(p.start) && std::isfinite(p.amplitude) && std::isfinite(p.omega) &&
                  std::isfinite(p.phase);
    for (double c : p.coefficients) finite = finite && std::isfinite(c);
    if (!finite) {
      throw std::invalid_argument("curve: piece " + std::to_string(i) + " holds a value that is not finite");
    }
    if (i > 0 && !(p.start > pieces_[i - 1].start)) {
      throw std::invalid_argument("curve: piece " + std::to_string(i) + " starts at " +
                                  std::to_string(p.start) + " s, not after the piece before it");
    }
  }
  const Piece& last = pieces_.back();
  if (!is_still(last)) return;
  held_from_ = pieces_.size() > 1 ? last.start : -std::numeric_limits<double>::infinity();
}

Curve Curve::constant(double value) {
  Piece p;
  p.coefficients[0] = value;
  return Curve({p});
}

Curve Curve::quintic(double t0, double t1, double from, double to) {
  if (!(t1 > t0)) {
    throw std::invalid_argument("curve: quintic ends at " + std::to_string(t1) + " s, not after its start " +
                                std::to_string(t0) + " s");
  }
  const double d = to - from, h = t1 - t0, h3 = h * h * h;
  Piece move, hold;
  move.start = t0;
  move.coefficients = {from, 0.0, 0.0, 10.0 * d / h3, -15.0 * d / (h3 * h), 6.0 * d / (h3 * h * h)};
  hold.start = t1;
  hold.coefficients[0] = to;
  return Curve({move, hold});
}

Curve Curve::harmonic(double start, double offset, double amplitude, double omega, double phase) {
  Piece p;
  p.start = start;
  p.coefficients[0] = offset;
  p.amplitude = amplitude;
  p.omega = omega;
  p.phase = phase;
  return Curve({p});
}

Curve Curve::then(double time, const Curve& next) const {
  std::vector<Piece> out;
  for (const Piece& p : pieces_) {
    if (p.start < time) out.push_back(p);
  }
  // The piece of `next` that is active at `time` begins there, re-expanded about the new start.
  const auto& q = next.pieces_;
  std::size_t i = 0;
  while (i + 1 < q.size() && q[i + 1].start <= time) ++i;
  Piece first = q[i];
  const double s = std::max(0.0, time - first.start);
  std::array<double, 6> shifted{};
  for (int k = 0; k < 6; ++k) {
    double binomial = 1.0, power = 1.0;
    for (int n = k; n < 6; ++n) {
      shifted[static_cast<std::size_t>(k)] +=
          binomial * power * q[i].coefficients[static_cast<std::size_t>(n)];
      power *= s;
      binomial = binomial * (n + 1) / (n + 1 - k);
    }
  }
  first.coefficients = shifted;
  first.phase += first.omega * s;
  first.start = std::max(time, first.start);
  if (q[i].start > time) {  // `next` holds its first value until it starts
    Piece hold;
    hold.start = time;
    hold.coefficients[0] = evaluate(q[0], q[0].start).value;
    out.push_back(hold);
  }
  out.push_back(first);
  out.insert(out.end(), q.begin() + static_cast<std::ptrdiff_t>(i) + 1, q.end());
  return Curve(std::move(out));
}

CurveValue Curve::piece_at(double t, double before) const {
  auto next = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                               [](double time, const Piece& p) { return time < p.start; });
  while (next != pieces_.begin() && (next - 1)->start >= before) --next;
  if (next == pieces_.begin()) return {evaluate(pieces_.front(), pieces_.front().start).value, 0.0, 0.0};
  return evaluate(*(next - 1), t);
}

std::vector<CurveKink> Curve::kinks() const {
  std::vector<CurveKink> out;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double t = pieces_[i].start;
    const Side after = side_of(pieces_[i], t),
               before = i > 0 ? side_of(pieces_[i - 1], t) : held(after.value[0]);
    double length = std::numeric_limits<double>::infinity();
    if (i > 0) length = t - pieces_[i - 1].start;
    if (i + 1 < pieces_.size()) length = std::min(length, pieces_[i + 1].start - t);
    CurveKink kink{t};
    if (find_jumps(before, after, length, kink)) out.push_back(kink);
  }
  return out;
}

std::vector<double> Curve::breakpoints(int derivatives) const {
  std::vector<double> out;
  for (const CurveKink& kink : kinks()) {
    bool jumps = false;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(derivatives); ++k) {
      jumps = jumps || kink.before[k] != kink.after[k];
    }
    if (jumps) out.push_back(kink.time);
  }
  return out;
}

std::optional<double> Curve::constant_value() const {
  const double value = pieces_.front().coefficients[0];
  for (const Piece& piece : pieces_) {
    if (!is_still(piece) || piece.coefficients[0] != value) return std::nullopt;
  }
  return value;
}

}  // namespace seacrane
