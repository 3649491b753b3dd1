#include "seacrane/sea/flow_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "seacrane/math/clones.hpp"
#include "seacrane/math/lane_functions.hpp"
#include "seacrane/sea/flow_pack.hpp"
#include "seacrane/sea/sincos.hpp"

namespace seacrane::sea {
namespace {

/// amplitude (cos, sin) of omega t + phase - (kx x + ky y), none of them above `largest`.
SEACRANE_CLONES("avx512f", "avx2")
void write_phasors(Read omega, Read phase, Read kx, Read ky, Read amplitude, std::size_t count, double t,
                   double x, double y, double largest, Write angle, Write cosine, Write sine) {
  for (std::size_t i = 0; i < count; ++i) angle[i] = omega[i] * t + (phase[i] - (kx[i] * x + ky[i] * y));
  sincos_each(angle, count, largest, sine, cosine);
  for (std::size_t i = 0; i < count; ++i) cosine[i] *= amplitude[i];
  for (std::size_t i = 0; i < count; ++i) sine[i] *= amplitude[i];
}

SEACRANE_CLONES("avx512f", "avx2")
void write_turns(Read kx, Read ky, std::size_t count, double dx, double dy, double largest, Write angle,
                 Write cosine, Write sine) {
  for (std::size_t i = 0; i < count; ++i) angle[i] = -(kx[i] * dx + ky[i] * dy);
  sincos_each(angle, count, largest, sine, cosine);
}

SEACRANE_CLONES("avx512f", "avx2")
void write_filtered(Read kx, Read ky, std::size_t count, double x, double y, double largest,
                    Write amplitude) {
  sinc_terms(largest, [&](auto terms) {
    for (std::size_t i = 0; i < count; ++i) {
      const double half = 0.5 * (kx[i] * x + ky[i] * y), square = half * half;
      double sinc;
      sinc_lane<double, terms>(square, sinc);
      amplitude[i] *= where_negative(square - sinc_end, sinc);
    }
  });
}

SEACRANE_CLONES("avx512f", "avx2")
void write_turning(Read kx, Read ky, std::size_t count, double x, double y, double x_rate, double y_rate,
                   double largest, Write amplitude, Write gain) {
  sinc_terms(largest, [&](auto terms) {
    for (std::size_t i = 0; i < count; ++i) {
      const double half = 0.5 * (kx[i] * x + ky[i] * y), square = half * half;
      const double rate = half * (kx[i] * x_rate + ky[i] * y_rate);  // of the square
      double sinc, slope;
      sinc_lane<double, terms>(square, sinc, slope);
      sinc = where_negative(square - sinc_end, sinc);
      slope = where_negative(square - sinc_end, slope);
      gain[i] = gain[i] * sinc + amplitude[i] * (slope * rate);
      amplitude[i] *= sinc;
    }
  });
}

/// Of amplitudes that are not felt, none.
SEACRANE_CLONES("avx512f", "avx2") void write_quotients(Read amplitude, std::size_t count, Write gain) {
  for (std::size_t i = 0; i < count; ++i) gain[i] /= amplitude[i] + 1e-300;
}

SEACRANE_CLONES("avx512f", "avx2") void write_exponentials(Read k, std::size_t count, double z, Write out) {
  for (std::size_t i = 0; i < count; ++i) exp_lane<double, std::uint64_t>(k[i] * z, out[i]);
}

/// From exp(k z) in the middle of a height to its integral: times height sinh x / x with x = k height / 2, as
/// sin x / x of an imaginary x. Where k height is far above 2 pi it comes out too small, never too large.
SEACRANE_CLONES("avx512f", "avx2") void write_integrals(Read k, std::size_t count, double height, Write sum) {
  const double most = count > 0 ? 0.5 * k[count - 1] * height : 0.0;
  sinc_terms(most * most, [&](auto terms) {
    for (std::size_t i = 0; i < count; ++i) {
      const double half = 0.5 * k[i] * height;
      double mean;
      sinc_lane<double, terms>(-half * half, mean);
      sum[i] *= height * mean;
    }
  });
}

constexpr double near = 0.2;  // of k times a way

/// (exp x - 1) / x for |x| <= near: Taylor polynomial, see growth_terms.
template <std::size_t count>
inline double growth(double x) {
  constexpr std::array<double, count> coefficient = [] {
    std::array<double, count> c{};
    double factorial = 1.0;
    for (std::size_t n = 0; n < count; ++n) c[n] = 1.0 / (factorial *= static_cast<double>(n + 1));
    return c;
  }();
  double sum = coefficient[count - 1];
  for (std::size_t n = count - 1; n-- > 0;) sum = x * sum + coefficient[n];
  return sum;
}

/// f(as many of its terms as a size of x needs, the number as a type).
template <class F>
inline void growth_terms(double largest, F&& f) {
  if (largest < 1e-3) return f(std::integral_constant<std::size_t, 5>());  // 1e-15 / 6! = 1e-18
  if (largest < 0.06) return f(std::integral_constant<std::size_t, 8>());  // 0.06^8 / 9! = 5e-16
  f(std::integral_constant<std::size_t, 10>());                            // near^10 / 11! = 3e-15
}

/// The height goes up, as the decay sees it, as it is.
SEACRANE_CLONES("avx512f", "avx2")
void write_risen(Read k, std::size_t count, double up, Write low, Write sum) {
  growth_terms(k[count - 1] * std::fabs(up), [&](auto terms) {
    for (std::size_t i = 0; i < count; ++i) {
      const double x = k[i] * up, factor = 1.0 + x * growth<terms>(x);
      low[i] *= factor;
      sum[i] *= factor;
    }
  });
}

/// Its bottom alone goes up, as the decay sees it, and as much of the height is lost as `lost` says.
SEACRANE_CLONES("avx512f", "avx2")
void write_cut(Read k, std::size_t count, double up, double lost, Write low, Write sum) {
  growth_terms(k[count - 1] * std::fabs(up), [&](auto terms) {
    for (std::size_t i = 0; i < count; ++i) {
      const double x = k[i] * up, part = low[i] * growth<terms>(x);
      low[i] += x * part;
      sum[i] -= lost * part;
    }
  });
}

SEACRANE_CLONES("avx512f", "avx2") void write_products(Read factor, std::size_t count, Write out) {
  for (std::size_t i = 0; i < count; ++i) out[i] *= factor[i];
}

}  // namespace

namespace {

/// The largest square of half the phase between the ends of an extent.
double largest_square(const SeaField& field, std::size_t count, double x, double y) {
  const double k = count > 0 ? field.arrays().k[count - 1] : 0.0;
  return 0.25 * k * k * (x * x + y * y);
}

}  // namespace

void filter_amplitudes(const SeaField& field, std::size_t count, double x, double y, FlowScratch& s) {
  write_filtered(field.arrays().kx.data(), field.arrays().ky.data(), count, x, y,
                 largest_square(field, count, x, y), s.amplitude.data());
}

void filter_turning(const SeaField& field, std::size_t count, double x, double y, double x_rate,
                    double y_rate, FlowScratch& s) {
  write_turning(field.arrays().kx.data(), field.arrays().ky.data(), count, x, y, x_rate, y_rate,
                largest_square(field, count, x, y), s.amplitude.data(), s.gain.data());
}

void take_quotients(std::size_t count, FlowScratch& s) {
  write_quotients(s.amplitude.data(), count, s.gain.data());
}

void set_phasors(const SeaField& field, std::size_t count, double t, double x, double y, FlowScratch& s) {
  const SeaField::Arrays& f = field.arrays();
  write_phasors(f.omega.data(), f.phase.data(), f.kx.data(), f.ky.data(), s.amplitude.data(), count, t, x, y,
                field.largest_angle(t, x, y), s.angle.data(), s.cosine.data(), s.sine.data());
}

void set_turns(const SeaField& field, std::size_t count, double dx, double dy, FlowScratch& s) {
  write_turns(field.arrays().kx.data(), field.arrays().ky.data(), count, dx, dy,
              field.largest_angle(0.0, dx, dy), s.angle.data(), s.turn_cosine.data(), s.turn_sine.data());
}

void forget_decays(FlowScratch& s) { s.decay.held = s.image.held = 0; }

namespace {

/// speed exp(sign k (z + shift)) over a height from the bottom; what is held has moved there by `up` in all,
/// and by `cut` more at the bottom.
void move_decays(const SeaField::Arrays& f, std::size_t count, double sign, double shift,
                 const FlowScratch& s, double up, double cut, Decays& d) {
  const double* const k = f.k.data();
  const std::size_t held = std::min(d.held, count), fresh = count - held;
  constexpr double rounding = 0x1p-51;
  if (held > 0) {
    const double most = k[held - 1];
    if (most * std::fabs(up) > rounding) write_risen(k, held, sign * up, d.low.data(), d.sum.data());
    if (most * std::fabs(cut) > rounding)
      write_cut(k, held, sign * cut, s.height > 0.0 ? cut : 0.0, d.low.data(), d.sum.data());
  }
  if (fresh > 0) {
    const auto begin = [&](double z, double* out) {
      write_exponentials(k + held, fresh, sign * (z + shift), out);
      write_products(f.speed.data() + held, fresh, out);
    };
    double* const sum = d.sum.data() + held;
    begin(s.bottom, d.low.data() + held);
    if (s.height > 0.0) {
      begin(s.bottom + 0.5 * s.height, sum);
      write_integrals(k + held, fresh, s.height, sum);
    }
  }
  d.held = count;
}

}  // namespace

void set_decays(const SeaField& field, std::size_t count, double level, double height, FlowScratch& s) {
  const SeaField::Arrays& f = field.arrays();
  const double bottom = level - 0.5 * height, most = count > 0 ? f.k[count - 1] : 0.0;
  const double up = height > 0.0 ? bottom + height - (s.bottom + s.height) : 0.0;
  const double cut = bottom - s.bottom - up;
  constexpr double largest = 16.0;  // k height up to which integrals are exact to 1e-8
  if (most * std::max(std::fabs(up), std::fabs(cut)) > near || most * height > largest ||
      height < 0.5 * s.height || (height > 0.0 && s.height == 0.0)) {
    forget_decays(s);
  }
  s.bottom = bottom;
  s.height = height;
  move_decays(f, count, 1.0, 0.0, s, up, cut, s.decay);
  const std::size_t images = std::min(count, s.images);
  if (images > 0) move_decays(f, images, -1.0, 2.0 * field.depth(), s, up, cut, s.image);
  s.image.held = images;
}

void set_decay_steps(const SeaField& field, std::size_t count, double dz, FlowScratch& s) {
  const double* k = field.arrays().k.data();
  write_exponentials(k, count, dz, s.decay.step.data());
  write_exponentials(k, std::min(count, s.images), -dz, s.image.step.data());
}

void step_decays(std::size_t count, FlowScratch& s) {
  forget_decays(s);
  write_products(s.decay.step.data(), count, s.decay.low.data());
  write_products(s.image.step.data(), std::min(count, s.images), s.image.low.data());
}

namespace {

/// Phasors (c, q), turned on to the next point first.
/// Of a sum over components: its phasors, which it may turn on to the next point first. In locals, as writing
/// them might change any pointer.
template <bool turns>
class Turning {
 public:
  Turning(const FlowScratch& s, std::vector<double>& cosine, std::vector<double>& sine)
      : turn_c_(s.turn_cosine.data()),
        turn_q_(s.turn_sine.data()),
        cosine_(cosine.data()),
        sine_(sine.data()) {}

  void next(std::size_t i, FlowPack& c, FlowPack& q) const {
    get(cosine_, i, c);
    get(sine_, i, q);
    if constexpr (turns) {
      FlowPack turn_c, turn_q;
      get(turn_c_, i, turn_c);
      get(turn_q_, i, turn_q);
      const FlowPack before = c;
      c = before * turn_c - q * turn_q;
      q = q * turn_c + before * turn_q;
      put(c, i, cosine_);
      put(q, i, sine_);
    }
  }

 private:
  const double *turn_c_, *turn_q_;
  double *cosine_, *sine_;
};

template <bool turns>
inline void add_surface_sums(const SeaField::Arrays& f, std::size_t count, FlowScratch& s,
                             LocalFlow<double>& out) {
  const Turning<turns> phasors(s, s.cosine, s.sine);
  const double *const omega = f.omega.data(), *const gain = s.gain.data(), *const kx = f.kx.data(),
                      *const ky = f.ky.data();
  FlowPack elevation{}, rate{}, slope_x{}, slope_y{};
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack c, q, w, g, x, y;
    phasors.next(i, c, q);
    get(omega, i, w);
    get(gain, i, g);
    get(kx, i, x);
    get(ky, i, y);
    elevation += c;
    rate += g * c - w * q;
    slope_x += x * q;
    slope_y += y * q;
  }
  out.elevation += total(elevation);
  out.elevation_rate += total(rate);
  out.slope[0] += total(slope_x);
  out.slope[1] += total(slope_y);
}

/// The same over the few of a NearSea, all of one direction, of omega = 1.
template <bool turns>
inline void add_few_surface_sums(const SeaField::Arrays& f, std::size_t count, FlowScratch& s,
                                 LocalFlow<double>& out) {
  const Turning<turns> phasors(s, s.cosine, s.sine), rises(s, s.rise.cosine, s.rise.sine),
      flows(s, s.flow.cosine, s.flow.sine);
  const double *const gain = s.gain.data(), *const wavenumber = f.k.data();
  FlowPack elevation{}, rate{}, slope{};
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack c, q, rise, other, g, k;
    if constexpr (turns) flows.next(i, other, rise);
    rises.next(i, other, rise);
    phasors.next(i, c, q);
    get(gain, i, g);
    get(wavenumber, i, k);
    elevation += c;
    rate += g * c - rise;
    slope += k * q;
  }
  const double along = total(slope);
  out.elevation += total(elevation);
  out.elevation_rate += total(rate);
  out.slope[0] += f.x[0] * along;
  out.slope[1] += f.y[0] * along;
}

}  // namespace

SEACRANE_CLONES("avx512f", "avx2")
void add_surface(const SeaField& field, std::size_t count, FlowScratch& s, LocalFlow<double>& out) {
  if (s.split) {
    add_few_surface_sums<false>(field.arrays(), count, s, out);
  } else {
    add_surface_sums<false>(field.arrays(), count, s, out);
  }
}

SEACRANE_CLONES("avx512f", "avx2")
void add_next_surface(const SeaField& field, std::size_t count, FlowScratch& s, LocalFlow<double>& out) {
  if (s.split) {
    add_few_surface_sums<true>(field.arrays(), count, s, out);
  } else {
    add_surface_sums<true>(field.arrays(), count, s, out);
  }
}

namespace {

struct InteriorSums {
  FlowPack u{}, v{}, w{}, ax{}, ay{}, az{}, p{};
};

template <bool floor>
inline void get_decays(const double* decay, const double* image, std::size_t i, FlowPack& level,
                       FlowPack& upright) {
  FlowPack down, other{};
  get(decay, i, down);
  if constexpr (floor) get(image, i, other);
  level = floor ? down + other : down;
  upright = floor ? down - other : down;
}

template <bool floor>
inline void sum_interior(const SeaField::Arrays& f, std::size_t from, std::size_t to, const FlowScratch& s,
                         const double* decay, const double* image, InteriorSums& sum) {
  for (std::size_t i = from; i < to; i += wide) {
    FlowPack c, q, level, upright, sigma, pressure, x, y;
    get(s.cosine.data(), i, c);
    get(s.sine.data(), i, q);
    get_decays<floor>(decay, image, i, level, upright);
    get(f.sigma.data(), i, sigma);
    get(f.pressure.data(), i, pressure);
    get(f.x.data(), i, x);
    get(f.y.data(), i, y);
    const FlowPack along = level * c, turned = sigma * (level * q);
    sum.u += x * along;
    sum.v += y * along;
    sum.w -= upright * q;
    sum.ax -= x * turned;
    sum.ay -= y * turned;
    sum.az -= sigma * (upright * c);
    sum.p += pressure * along;
  }
}

/// Of the few of a NearSea, all of one direction, of sigma = g.
struct FewSums {
  FlowPack along{}, up{}, turned{}, lifted{}, pressed{};
};

template <bool floor>
inline void sum_few_interior(const SeaField::Arrays& f, std::size_t from, std::size_t to,
                             const FlowScratch& s, const double* decay, const double* image, FewSums& sum) {
  for (std::size_t i = from; i < to; i += wide) {
    FlowPack c, q, flow_c, flow_q, level, upright, pressure;
    get(s.cosine.data(), i, c);
    get(s.sine.data(), i, q);
    get(s.flow.cosine.data(), i, flow_c);
    get(s.flow.sine.data(), i, flow_q);
    get_decays<floor>(decay, image, i, level, upright);
    get(f.pressure.data(), i, pressure);
    sum.along += level * flow_c;
    sum.up += upright * flow_q;
    sum.turned += level * q;
    sum.lifted += upright * c;
    sum.pressed += pressure * (level * c);
  }
}

}  // namespace

SEACRANE_CLONES("avx512f", "avx2")
void add_interior(const SeaField& field, std::size_t count, const FlowScratch& s, LocalFlow<double>& out) {
  const SeaField::Arrays& f = field.arrays();
  const std::size_t floor = std::min(count, s.images);
  const bool mean = s.height > 0.0;
  const double* const decay = mean ? s.decay.sum.data() : s.decay.low.data();
  const double* const image = mean ? s.image.sum.data() : s.image.low.data();
  const double share = mean ? 1.0 / s.height : 1.0;
  if (s.split) {
    FewSums sum;
    sum_few_interior<true>(f, 0, floor, s, decay, image, sum);
    sum_few_interior<false>(f, floor, count, s, decay, image, sum);
    const double along = share * total(sum.along), pull = share * field.gravity(), x = f.x[0], y = f.y[0];
    const double turned = pull * total(sum.turned);
    out.velocity += Vec3d(x * along, y * along, -share * total(sum.up));
    out.acceleration -= Vec3d(x * turned, y * turned, pull * total(sum.lifted));
    out.pressure += share * total(sum.pressed);
  } else {
    InteriorSums sum;
    sum_interior<true>(f, 0, floor, s, decay, image, sum);
    sum_interior<false>(f, floor, count, s, decay, image, sum);
    out.velocity += share * Vec3d(total(sum.u), total(sum.v), total(sum.w));
    out.acceleration += share * Vec3d(total(sum.ax), total(sum.ay), total(sum.az));
    out.pressure += share * total(sum.p);
  }
}

SEACRANE_CLONES("avx512f", "avx2")
void take_amplitudes(const double* amplitudes, std::size_t few, std::size_t count, FlowScratch& s) {
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack c, q;
    get(s.cosine.data(), i, c);
    get(s.sine.data(), i, q);
    const auto times = [&](std::size_t sum, std::vector<double>& cosine, std::vector<double>& sine) {
      FlowPack a, b;
      get(amplitudes, 2 * sum * few + i, a);
      get(amplitudes, (2 * sum + 1) * few + i, b);
      put(a * c - b * q, i, cosine.data());
      put(a * q + b * c, i, sine.data());
    };
    times(0, s.cosine, s.sine);
    times(1, s.flow.cosine, s.flow.sine);
    times(2, s.rise.cosine, s.rise.sine);
  }
}

SEACRANE_CLONES("avx512f", "avx2")
void write_weighed(const std::array<std::array<const double*, 3>, 4>& knots, const HermiteWeights& by,
                   std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack sum{};
    for (std::size_t n = 0; n < knots.size(); ++n) {
      FlowPack value, rate, acceleration;
      get(knots[n][0], i, value);
      get(knots[n][1], i, rate);
      get(knots[n][2], i, acceleration);
      sum += by.value[n] * value + by.rate[n] * rate + by.acceleration[n] * acceleration;
    }
    put(sum, i, out);
  }
}

SEACRANE_CLONES("avx512f", "avx2")
void sum_shares(Read shares, Read harmonics, std::size_t count, std::size_t few, Write value, Write rate,
                Write acceleration) {
  constexpr std::size_t rows = 6;
  double* const out[rows] = {value, value + few, rate, rate + few, acceleration, acceleration + few};
  for (std::size_t j = 0; j < few; j += wide) {
    FlowPack sum[rows] = {};
    for (std::size_t i = 0; i < count; ++i) {
      FlowPack share;
      get(shares, i * few + j, share);
      for (std::size_t n = 0; n < rows; ++n) sum[n] += share * harmonics[n * count + i];
    }
    for (std::size_t n = 0; n < rows; ++n) put(sum[n], j, out[n]);
  }
}

}  // namespace seacrane::sea
