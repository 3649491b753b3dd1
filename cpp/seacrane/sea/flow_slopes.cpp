#include "seacrane/sea/flow_slopes.hpp"

#include "seacrane/math/clones.hpp"
#include "seacrane/math/lane_functions.hpp"
#include "seacrane/sea/flow_pack.hpp"

namespace seacrane::sea {
namespace {

/// Products over the extents of f = sin u / u, u half the phase between their ends: f' = 2 u df/du^2, and
/// f'' = -f - 4 df/du^2, as u f'' + 2 f' + u f = 0.
SEACRANE_CLONES("avx512f", "avx2")
void write_filters(Read kx, Read ky, std::size_t count, const Mat3d& extents, const Mat3d& rates,
                   Filters& to) {
  for (std::size_t i = 0; i < count; ++i) {
    double f[3], first[3], second[3], turn[3];
    for (int m = 0; m < 3; ++m) {
      const double u = 0.5 * (kx[i] * extents(0, m) + ky[i] * extents(1, m)), square = u * u;
      double sinc, slope;
      sinc_lane(square, sinc, slope);
      f[m] = where_negative(square - sinc_end, sinc);
      slope = where_negative(square - sinc_end, slope);
      first[m] = 2.0 * u * slope;
      second[m] = -f[m] - 4.0 * slope;
      turn[m] = 0.5 * (kx[i] * rates(0, m) + ky[i] * rates(1, m));
    }
    to.share[i] = f[0] * f[1] * f[2];
    double rate = 0.0;
    for (int m = 0; m < 3; ++m) {
      const int a = (m + 1) % 3, b = (m + 2) % 3;
      const double over = first[m] * f[a] * f[b];
      rate += over * turn[m];
      to.over[m][i] = over;
      to.rate_over[m][i] = second[m] * turn[m] * f[a] * f[b] +
                           first[m] * (first[a] * turn[a] * f[b] + f[a] * first[b] * turn[b]);
    }
    to.rate[i] = rate;
  }
}

/// Slopes of the mean sinh x / x, x = k height / 2, over the height and over the mean.
inline void write_stretches(Read k, std::size_t count, double height, Write out) {
  for (std::size_t i = 0; i < count; ++i) {
    const double half = 0.5 * k[i] * height;
    double mean, slope;
    sinc_lane(-half * half, mean, slope);
    out[i] = -half * k[i] * slope / mean;
  }
}

/// Phasors of a pack of components: of the elevation, of the velocity, of the elevation's rate.
struct Turned {
  FlowPack c, q, flow_c, flow_q, rise_c, rise_q;

  Turned(const FlowScratch& s, std::size_t i) {
    get(s.cosine.data(), i, c);
    get(s.sine.data(), i, q);
    get(s.split ? s.flow.cosine.data() : s.cosine.data(), i, flow_c);
    get(s.split ? s.flow.sine.data() : s.sine.data(), i, flow_q);
    get(s.split ? s.rise.cosine.data() : s.cosine.data(), i, rise_c);
    get(s.split ? s.rise.sine.data() : s.sine.data(), i, rise_q);
  }
  /// Their slopes over a way along the wave, over k.
  Turned along() const {
    Turned out = *this;
    out.c = q, out.q = -c, out.flow_c = flow_q, out.flow_q = -flow_c, out.rise_c = rise_q,
    out.rise_q = -rise_c;
    return out;
  }
};

struct SurfaceSlopes {
  FlowPack elevation{}, rate{}, x{}, y{};

  void add_to(LocalFlow<double>& out) const {
    out.elevation += total(elevation);
    out.elevation_rate += total(rate);
    out.slope[0] += total(x);
    out.slope[1] += total(y);
  }
};

struct InteriorSlopes {
  FlowPack u{}, v{}, w{}, ax{}, ay{}, az{}, p{};

  void add_to(LocalFlow<double>& out, double share) const {
    out.velocity += share * Vec3d(total(u), total(v), total(w));
    out.acceleration += share * Vec3d(total(ax), total(ay), total(az));
    out.pressure += share * total(p);
  }
};

template <bool extended>
inline void sum_surface(const SeaField::Arrays& f, std::size_t count, const FlowScratch& s, FlowSlopes& out) {
  SurfaceSlopes value, over[2], wide_over[2][3];
  FlowPack turning[2][3] = {};
  for (std::size_t i = 0; i < count; i += wide) {
    const Turned here(s, i);
    FlowPack omega, k[2], share, rate;
    get(f.omega.data(), i, omega);
    get(f.kx.data(), i, k[0]);
    get(f.ky.data(), i, k[1]);
    get(s.filters.share.data(), i, share);
    get(s.filters.rate.data(), i, rate);
    const auto add = [&](SurfaceSlopes& to, const FlowPack& by, const FlowPack& part,
                         const FlowPack& part_rate, const Turned& at) {
      const FlowPack slope = by * part * at.q;
      to.elevation += by * part * at.c;
      to.rate += by * (part_rate * at.c - omega * part * at.rise_q);
      to.x += k[0] * slope;
      to.y += k[1] * slope;
    };
    const FlowPack one = FlowPack{} + 1.0;
    add(value, one, share, rate, here);
    for (std::size_t n = 0; n < 2; ++n) add(over[n], k[n], share, rate, here.along());
    if constexpr (!extended) continue;
    for (std::size_t m = 0; m < 3; ++m) {
      FlowPack part, part_rate;
      get(s.filters.over[m].data(), i, part);
      get(s.filters.rate_over[m].data(), i, part_rate);
      for (std::size_t n = 0; n < 2; ++n) {
        add(wide_over[n][m], 0.5 * k[n], part, part_rate, here);
        turning[n][m] += 0.5 * k[n] * part * here.c;
      }
    }
  }
  value.add_to(out.value);
  for (std::size_t n = 0; n < 2; ++n) {
    over[n].add_to(out.position[n]);
    for (std::size_t m = 0; m < 3; ++m) {
      wide_over[n][m].add_to(out.extents[n][m]);
      out.turning[n][m] += total(turning[n][m]);
    }
  }
}

template <bool extended>
inline void sum_interior(const SeaField::Arrays& f, std::size_t count, const FlowScratch& s,
                         FlowSlopes& out) {
  InteriorSlopes value, over[2], wide_over[2][3], over_level, over_height;
  const bool mean = s.height > 0.0;
  for (std::size_t i = 0; i < count; i += wide) {
    const Turned here(s, i);
    FlowPack down, image{}, sigma, pressure, x, y, k, along[2], share, stretch{};
    get(mean ? s.decay.sum.data() : s.decay.low.data(), i, down);
    if (i < s.images) get(mean ? s.image.sum.data() : s.image.low.data(), i, image);
    if (mean) get(s.filters.stretch.data(), i, stretch);
    get(f.sigma.data(), i, sigma);
    get(f.pressure.data(), i, pressure);
    get(f.x.data(), i, x);
    get(f.y.data(), i, y);
    get(f.k.data(), i, k);
    get(f.kx.data(), i, along[0]);
    get(f.ky.data(), i, along[1]);
    get(s.filters.share.data(), i, share);
    const FlowPack level = down + image, upright = down - image;
    const auto add = [&](InteriorSlopes& to, const FlowPack& part, const FlowPack& flat,
                         const FlowPack& steep, const Turned& at) {
      const FlowPack flows = part * flat * at.flow_c, pulls = part * sigma * flat * at.q;
      to.u += x * flows;
      to.v += y * flows;
      to.w -= part * steep * at.flow_q;
      to.ax -= x * pulls;
      to.ay -= y * pulls;
      to.az -= part * sigma * steep * at.c;
      to.p += part * pressure * flat * at.c;
    };
    add(value, share, level, upright, here);
    add(over_level, k * share, upright, level, here);
    add(over_height, stretch * share, level, upright, here);
    for (std::size_t n = 0; n < 2; ++n) add(over[n], along[n] * share, level, upright, here.along());
    if constexpr (!extended) continue;
    for (std::size_t m = 0; m < 3; ++m) {
      FlowPack part;
      get(s.filters.over[m].data(), i, part);
      for (std::size_t n = 0; n < 2; ++n) add(wide_over[n][m], 0.5 * along[n] * part, level, upright, here);
    }
  }
  const double of = mean ? 1.0 / s.height : 1.0;
  value.add_to(out.value, of);
  over_level.add_to(out.level, of);
  over_height.add_to(out.height, of);
  for (std::size_t n = 0; n < 2; ++n) {
    over[n].add_to(out.position[n], of);
    for (std::size_t m = 0; m < 3; ++m) wide_over[n][m].add_to(out.extents[n][m], of);
  }
}

}  // namespace

void set_filters(const SeaField& field, std::size_t count, const Mat3d& extents, const Mat3d& rates,
                 FlowScratch& s) {
  write_filters(field.arrays().kx.data(), field.arrays().ky.data(), count, extents, rates, s.filters);
}

SEACRANE_CLONES("avx512f", "avx2")
void add_surface_slopes(const SeaField& field, std::size_t count, const FlowScratch& s, FlowSlopes& out) {
  if (out.wide) {
    sum_surface<true>(field.arrays(), count, s, out);
  } else {
    sum_surface<false>(field.arrays(), count, s, out);
  }
}

SEACRANE_CLONES("avx512f", "avx2")
void add_interior_slopes(const SeaField& field, std::size_t count, FlowScratch& s, FlowSlopes& out) {
  if (s.height > 0.0) write_stretches(field.arrays().k.data(), count, s.height, s.filters.stretch.data());
  if (out.wide) {
    sum_interior<true>(field.arrays(), count, s, out);
  } else {
    sum_interior<false>(field.arrays(), count, s, out);
  }
}

}  // namespace seacrane::sea
