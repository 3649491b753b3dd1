#include "seacrane/sea/flow_kernel.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "seacrane/math/exp_lane.hpp"
#include "seacrane/math/sinc_lane.hpp"
#include "seacrane/sea/sincos.hpp"

// GCC compiles these loops a second time for registers of four doubles, and chooses when the program starts.
// Neither form fuses products and sums, so that both give the same bits. All that they call is within them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEACRANE_FLOW_LOOP __attribute__((target_clones("avx2", "default"), flatten))
#else
#define SEACRANE_FLOW_LOOP
#endif

namespace seacrane::sea {
namespace {

constexpr std::size_t wide = SeaField::lanes;
typedef double FlowPack __attribute__((vector_size(8 * wide)));

inline void get(const std::vector<double>& from, std::size_t i, FlowPack& to) {
  std::memcpy(&to, from.data() + i, sizeof(FlowPack));
}
inline double total(const FlowPack& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// `value` where `test` is below zero, else zero; a comparison would be a branch, as it may trap.
inline double where_negative(double test, double value) {
  const std::uint64_t negative = 0u - (std::bit_cast<std::uint64_t>(test) >> 63);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & negative);
}

using Read = const double* __restrict;
using Write = double* __restrict;

/// amplitude (cos, sin) of omega t + phase - (kx x + ky y), none of them above `largest`.
SEACRANE_FLOW_LOOP void write_phasors(Read omega, Read phase, Read kx, Read ky, Read amplitude,
                                      std::size_t count, double t, double x, double y, double largest,
                                      Write angle, Write cosine, Write sine) {
  for (std::size_t i = 0; i < count; ++i) angle[i] = omega[i] * t + (phase[i] - (kx[i] * x + ky[i] * y));
  sincos_each(angle, count, largest, sine, cosine);
  for (std::size_t i = 0; i < count; ++i) cosine[i] *= amplitude[i];
  for (std::size_t i = 0; i < count; ++i) sine[i] *= amplitude[i];
}

SEACRANE_FLOW_LOOP void write_turns(Read kx, Read ky, std::size_t count, double dx, double dy, double largest,
                                    Write angle, Write cosine, Write sine) {
  for (std::size_t i = 0; i < count; ++i) angle[i] = -(kx[i] * dx + ky[i] * dy);
  sincos_each(angle, count, largest, sine, cosine);
}

SEACRANE_FLOW_LOOP void write_turned(Read turn_cosine, Read turn_sine, std::size_t count, Write cosine,
                                     Write sine) {
  for (std::size_t i = 0; i < count; ++i) {
    const double c = cosine[i], q = sine[i];
    cosine[i] = c * turn_cosine[i] - q * turn_sine[i];
    sine[i] = q * turn_cosine[i] + c * turn_sine[i];
  }
}

SEACRANE_FLOW_LOOP void write_filtered(Read kx, Read ky, std::size_t count, double x, double y,
                                       Write amplitude) {
  for (std::size_t i = 0; i < count; ++i) {
    const double half = 0.5 * (kx[i] * x + ky[i] * y), square = half * half;
    double sinc;
    sinc_lane(square, sinc);
    amplitude[i] *= where_negative(square - sinc_end, sinc);
  }
}

SEACRANE_FLOW_LOOP void write_turning(Read kx, Read ky, std::size_t count, double x, double y, double x_rate,
                                      double y_rate, Write amplitude, Write gain) {
  for (std::size_t i = 0; i < count; ++i) {
    const double half = 0.5 * (kx[i] * x + ky[i] * y), square = half * half;
    const double rate = half * (kx[i] * x_rate + ky[i] * y_rate);  // of the square
    double sinc, slope;
    sinc_lane(square, sinc, slope);
    sinc = where_negative(square - sinc_end, sinc);
    slope = where_negative(square - sinc_end, slope);
    gain[i] = gain[i] * sinc + amplitude[i] * (slope * rate);
    amplitude[i] *= sinc;
  }
}

/// Of amplitudes that are not felt, none.
SEACRANE_FLOW_LOOP void write_quotients(Read amplitude, std::size_t count, Write gain) {
  for (std::size_t i = 0; i < count; ++i) gain[i] /= amplitude[i] + 1e-300;
}

SEACRANE_FLOW_LOOP void write_exponentials(Read k, std::size_t count, double z, Write out) {
  for (std::size_t i = 0; i < count; ++i) exp_lane<double, std::uint64_t>(k[i] * z, out[i]);
}

/// Times the mean of exp(k z) over a height, over its value in the middle: sinh x / x with x = k height / 2,
/// as sin x / x of an imaginary x. Where k height is far above 2 pi it comes out too small, never too large.
SEACRANE_FLOW_LOOP void write_means(Read k, std::size_t count, double height, Write decay) {
  for (std::size_t i = 0; i < count; ++i) {
    const double half = 0.5 * k[i] * height;
    double mean;
    sinc_lane(-half * half, mean);
    decay[i] *= mean;
  }
}

SEACRANE_FLOW_LOOP void write_products(Read factor, std::size_t count, Write out) {
  for (std::size_t i = 0; i < count; ++i) out[i] *= factor[i];
}

}  // namespace

void filter_amplitudes(const SeaField& field, std::size_t count, double x, double y, FlowScratch& s) {
  write_filtered(field.arrays().kx.data(), field.arrays().ky.data(), count, x, y, s.amplitude.data());
}

void filter_turning(const SeaField& field, std::size_t count, double x, double y, double x_rate,
                    double y_rate, FlowScratch& s) {
  write_turning(field.arrays().kx.data(), field.arrays().ky.data(), count, x, y, x_rate, y_rate,
                s.amplitude.data(), s.gain.data());
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

void turn(std::size_t count, FlowScratch& s) {
  write_turned(s.turn_cosine.data(), s.turn_sine.data(), count, s.cosine.data(), s.sine.data());
}

void set_decays(const SeaField& field, std::size_t count, double level, FlowScratch& s) {
  const double* k = field.arrays().k.data();
  write_exponentials(k, count, level, s.decay.data());
  write_exponentials(k, std::min(count, s.images), -(level + 2.0 * field.depth()), s.image.data());
}

void take_means(const SeaField& field, std::size_t count, double height, FlowScratch& s) {
  const double* k = field.arrays().k.data();
  write_means(k, count, height, s.decay.data());
  write_means(k, std::min(count, s.images), height, s.image.data());
}

void set_decay_steps(const SeaField& field, std::size_t count, double dz, FlowScratch& s) {
  const double* k = field.arrays().k.data();
  write_exponentials(k, count, dz, s.decay_step.data());
  write_exponentials(k, std::min(count, s.images), -dz, s.image_step.data());
}

void step_decays(std::size_t count, FlowScratch& s) {
  write_products(s.decay_step.data(), count, s.decay.data());
  write_products(s.image_step.data(), std::min(count, s.images), s.image.data());
}

SEACRANE_FLOW_LOOP void add_surface(const SeaField& field, std::size_t count, const FlowScratch& s,
                                    LocalFlow<double>& out) {
  const SeaField::Arrays& f = field.arrays();
  FlowPack elevation{}, rate{}, slope_x{}, slope_y{};
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack c, q, omega, kx, ky;
    get(s.cosine, i, c);
    get(s.sine, i, q);
    get(f.omega, i, omega);
    get(f.kx, i, kx);
    get(f.ky, i, ky);
    elevation += c;
    rate -= omega * q;
    slope_x += kx * q;
    slope_y += ky * q;
  }
  out.elevation += total(elevation);
  out.elevation_rate += total(rate);
  out.slope[0] += total(slope_x);
  out.slope[1] += total(slope_y);
}

SEACRANE_FLOW_LOOP void add_gains(std::size_t count, const FlowScratch& s, LocalFlow<double>& out) {
  FlowPack sum{};
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack gain, c;
    get(s.gain, i, gain);
    get(s.cosine, i, c);
    sum += gain * c;
  }
  out.elevation_rate += total(sum);
}

namespace {

struct InteriorSums {
  FlowPack u{}, v{}, w{}, ax{}, ay{}, az{}, p{};
};

template <bool floor>
inline void sum_interior(const SeaField::Arrays& f, std::size_t from, std::size_t to, const FlowScratch& s,
                         InteriorSums& sum) {
  for (std::size_t i = from; i < to; i += wide) {
    FlowPack c, q, down, image{}, speed, sigma, pressure, x, y;
    get(s.cosine, i, c);
    get(s.sine, i, q);
    get(s.decay, i, down);
    if constexpr (floor) get(s.image, i, image);
    get(f.speed, i, speed);
    get(f.sigma, i, sigma);
    get(f.pressure, i, pressure);
    get(f.x, i, x);
    get(f.y, i, y);
    c *= speed;
    q *= speed;
    const FlowPack level = floor ? down + image : down, upright = floor ? down - image : down;
    const FlowPack along = level * c, turned = sigma * (level * q);
    const FlowPack up = upright * q, lifted = sigma * (upright * c);
    sum.u += x * along;
    sum.v += y * along;
    sum.w -= up;
    sum.ax -= x * turned;
    sum.ay -= y * turned;
    sum.az -= lifted;
    sum.p += pressure * along;
  }
}

}  // namespace

SEACRANE_FLOW_LOOP void add_interior(const SeaField& field, std::size_t count, const FlowScratch& s,
                                     LocalFlow<double>& out) {
  InteriorSums sum;
  const std::size_t floor = std::min(count, s.images);
  sum_interior<true>(field.arrays(), 0, floor, s, sum);
  sum_interior<false>(field.arrays(), floor, count, s, sum);
  out.velocity += Vec3d(total(sum.u), total(sum.v), total(sum.w));
  out.acceleration += Vec3d(total(sum.ax), total(sum.ay), total(sum.az));
  out.pressure += total(sum.p);
}

}  // namespace seacrane::sea
