#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "seacrane/sea/flow_kernel.hpp"
#include "seacrane/sea/near_sea.hpp"

namespace seacrane {

/// Amplitudes of a NearSea for one run. They are sums of harmonics for each region m, whose middle is at m
/// times the spacing along the waves: Hermite interpolation of degree 11 in time between knots, as of a
/// KnotTable, whose phases depend on the region and the number of the knot alone. Over the overlap of two
/// regions a polynomial of the place, with two derivatives that vanish at both ends, leads from one to the
/// other. So results depend on time and place alone, and are smooth in both up to the second derivative.
class NearWaves {
 public:
  /// For as many stencils, which may be in regions of their own.
  NearWaves(std::shared_ptr<const NearSea> sea, std::size_t stencils);

  /// What is met at a time around s along the waves, m: the amplitudes, and what s they are for.
  struct Met {
    double s;
    const double* amplitudes;  // for each of NearSea::sums all cosines, then all sines
    const double* slopes =
        nullptr;  // of the amplitudes over s; where they have none, or if not `sloped`, null
  };
  /// Until the next call. The scratch is that of the sums over all components.
  Met at(double t, double s, sea::FlowScratch& scratch, bool sloped = false);
  const NearSea& sea() const { return *sea_; }

 private:
  struct Knot {
    std::int64_t region = 0, number = std::numeric_limits<std::int64_t>::min();
    std::vector<double> value, rate, acceleration;  // times 1, step, step^2
  };
  struct Held {
    std::int64_t region = 0;
    double time = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> amplitudes;
  };

  const Knot& knot(std::int64_t region, std::int64_t number, sea::FlowScratch& scratch);
  const std::vector<double>& amplitudes(std::int64_t region, double t, sea::FlowScratch& scratch);

  std::shared_ptr<const NearSea> sea_;
  std::size_t few_;                              // padded
  std::size_t regions_;                          // that are held at a time, a power of two
  std::vector<double> turn_cosine_, turn_sine_;  // of the few from region to region
  std::vector<double> harmonics_;                // what a knot sums, one number of all components by another
  std::vector<Knot> knots_;
  std::vector<Held> held_;
  std::vector<double> blended_, slopes_;
};

}  // namespace seacrane
