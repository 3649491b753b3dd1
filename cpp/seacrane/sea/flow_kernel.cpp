#include "seacrane/sea/flow_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "seacrane/math/exp_lane.hpp"
#include "seacrane/math/sinc_lane.hpp"
#include "seacrane/math/sincos.hpp"

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
typedef std::uint64_t FlowBits __attribute__((vector_size(8 * wide)));

inline void get(const std::vector<double>& from, std::size_t i, FlowPack& to) {
  std::memcpy(&to, from.data() + i, sizeof(FlowPack));
}
inline void put(const FlowPack& from, std::vector<double>& to, std::size_t i) {
  std::memcpy(to.data() + i, &from, sizeof(FlowPack));
}
inline double total(const FlowPack& sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// amplitude (cos, sin) of each angle where it is small enough for the fast form.
inline void put_phasor(const FlowPack& angle, std::size_t i, const FlowPack& amplitude,
                       std::vector<double>& cosine, std::vector<double>& sine) {
  FlowPack s, c;
  sincos_lane<FlowPack, FlowBits>(angle, s, c);
  put(amplitude * c, cosine, i);
  put(amplitude * s, sine, i);
}

void set_large_phasors(const SeaField::Arrays& f, std::size_t count, double t, double x, double y,
                       FlowScratch& s) {
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = f.omega[i] * t + (f.phase[i] - (f.kx[i] * x + f.ky[i] * y));
    s.cosine[i] = s.amplitude[i] * std::cos(angle);
    s.sine[i] = s.amplitude[i] * std::sin(angle);
  }
}

SEACRANE_FLOW_LOOP void set_small_phasors(const SeaField::Arrays& f, std::size_t count, double t, double x,
                                          double y, FlowScratch& s) {
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack omega, phase, kx, ky, amplitude;
    get(f.omega, i, omega);
    get(f.phase, i, phase);
    get(f.kx, i, kx);
    get(f.ky, i, ky);
    get(s.amplitude, i, amplitude);
    put_phasor(omega * t + (phase - (kx * x + ky * y)), i, amplitude, s.cosine, s.sine);
  }
}

}  // namespace

SEACRANE_FLOW_LOOP void filter_amplitudes(const SeaField& field, std::size_t count, double x, double y,
                                          FlowScratch& s) {
  const SeaField::Arrays& f = field.arrays();
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack kx, ky, amplitude, sinc;
    get(f.kx, i, kx);
    get(f.ky, i, ky);
    get(s.amplitude, i, amplitude);
    const FlowPack half = 0.5 * (kx * x + ky * y), square = half * half;
    sinc_lane<FlowPack>(square, sinc);
    const FlowPack felt = square < sinc_end ? sinc : FlowPack{};
    put(amplitude * felt, s.amplitude, i);
  }
}

void set_phasors(const SeaField& field, std::size_t count, double t, double x, double y, FlowScratch& s) {
  if (field.largest_angle(t, x, y) <= sincos_limit) {
    set_small_phasors(field.arrays(), count, t, x, y, s);
  } else {
    set_large_phasors(field.arrays(), count, t, x, y, s);
  }
}

SEACRANE_FLOW_LOOP void set_turns(const SeaField& field, std::size_t count, double dx, double dy,
                                  FlowScratch& s) {
  const SeaField::Arrays& f = field.arrays();
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack kx, ky;
    get(f.kx, i, kx);
    get(f.ky, i, ky);
    put_phasor(-(kx * dx + ky * dy), i, FlowPack{} + 1.0, s.turn_cosine, s.turn_sine);
  }
}

SEACRANE_FLOW_LOOP void turn(std::size_t count, FlowScratch& s) {
  for (std::size_t i = 0; i < count; i += wide) {
    FlowPack c, q, tc, tq;
    get(s.cosine, i, c);
    get(s.sine, i, q);
    get(s.turn_cosine, i, tc);
    get(s.turn_sine, i, tq);
    put(c * tc - q * tq, s.cosine, i);
    put(q * tc + c * tq, s.sine, i);
  }
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

SEACRANE_FLOW_LOOP void set_decays(const SeaField& field, std::size_t count, double level, FlowScratch& s) {
  const SeaField::Arrays& f = field.arrays();
  FlowPack k, down, image;
  for (std::size_t i = 0; i < count; i += wide) {
    get(f.k, i, k);
    exp_lane<FlowPack, FlowBits>(k * level, down);
    put(down, s.decay, i);
  }
  const double mirrored = -(level + 2.0 * field.depth());
  for (std::size_t i = 0; i < std::min(count, field.with_floor()); i += wide) {
    get(f.k, i, k);
    exp_lane<FlowPack, FlowBits>(k * mirrored, image);
    put(image, s.image, i);
  }
}

SEACRANE_FLOW_LOOP void set_decay_steps(const SeaField& field, std::size_t count, double dz, FlowScratch& s) {
  const SeaField::Arrays& f = field.arrays();
  FlowPack k, down, image;
  for (std::size_t i = 0; i < count; i += wide) {
    get(f.k, i, k);
    exp_lane<FlowPack, FlowBits>(k * dz, down);
    put(down, s.decay_step, i);
  }
  for (std::size_t i = 0; i < std::min(count, field.with_floor()); i += wide) {
    get(f.k, i, k);
    exp_lane<FlowPack, FlowBits>(k * -dz, image);
    put(image, s.image_step, i);
  }
}

SEACRANE_FLOW_LOOP void step_decays(const SeaField& field, std::size_t count, FlowScratch& s) {
  FlowPack from, factor;
  for (std::size_t i = 0; i < count; i += wide) {
    get(s.decay, i, from);
    get(s.decay_step, i, factor);
    put(from * factor, s.decay, i);
  }
  for (std::size_t i = 0; i < std::min(count, field.with_floor()); i += wide) {
    get(s.image, i, from);
    get(s.image_step, i, factor);
    put(from * factor, s.image, i);
  }
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
  const std::size_t floor = std::min(count, field.with_floor());
  sum_interior<true>(field.arrays(), 0, floor, s, sum);
  sum_interior<false>(field.arrays(), floor, count, s, sum);
  out.velocity += Vec3d(total(sum.u), total(sum.v), total(sum.w));
  out.acceleration += Vec3d(total(sum.ax), total(sum.ay), total(sum.az));
  out.pressure += total(sum.p);
}

}  // namespace seacrane::sea
