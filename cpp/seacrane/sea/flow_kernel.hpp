#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "seacrane/sea/knot_table.hpp"
#include "seacrane/sea/sea_field.hpp"

/// Sums over the components of a sea, SeaField::lanes of them side by side. Every number of components is in
/// whole packs, and sums are added up in one order, so that results do not depend on the processor.
namespace seacrane::sea {

/// speed exp(k z), or its image speed exp(-k (z + 2 depth)), over a height; of no height, at its level.
struct Decays {
  std::vector<double> low;   // at the bottom
  std::vector<double> sum;   // integral over the height, m
  std::vector<double> step;  // factor of `low` from point to point
  std::size_t held = 0;      // how many of the first components are there
};

struct Phasors {
  std::vector<double> cosine, sine;
};

/// Of what an element feels of a component: its share and its rate, and slopes, see set_filters.
struct Filters {
  std::vector<double> share, rate;
  std::array<std::vector<double>, 3> over, rate_over;
  std::vector<double> stretch;  // of the mean over a height, over that height and over the mean, 1/m
};

/// What one stencil keeps for each component, at the point that it is at.
struct FlowScratch {
  std::vector<double> amplitude, angle;        // what the element feels of it; of its phase
  std::vector<double> gain;                    // and its rate, then over it, where the element turns
  std::vector<double> cosine, sine;            // amplitude times those of the phase angle
  std::vector<double> turn_cosine, turn_sine;  // of the phase from point to point
  Decays decay, image;
  double bottom = 0.0, height = 0.0;  // where the decays are
  /// Of a NearSea the phasors of the velocity and of the elevation's rate are others than those of the rest.
  bool split = false;
  Phasors flow, rise;
  Filters filters;  // of slopes

  std::size_t images = 0;  // how many of the first have an image, whole packs

  explicit FlowScratch(std::size_t padded) {
    for (auto* array : {&amplitude,
                        &angle,
                        &gain,
                        &cosine,
                        &sine,
                        &turn_cosine,
                        &turn_sine,
                        &decay.low,
                        &decay.sum,
                        &decay.step,
                        &image.low,
                        &image.sum,
                        &image.step,
                        &flow.cosine,
                        &flow.sine,
                        &rise.cosine,
                        &rise.sine,
                        &filters.share,
                        &filters.rate,
                        &filters.over[0],
                        &filters.over[1],
                        &filters.over[2],
                        &filters.rate_over[0],
                        &filters.rate_over[1],
                        &filters.rate_over[2],
                        &filters.stretch}) {
      array->assign(padded, 0.0);
    }
  }
};

/// Filtered amplitudes: times sin(h) / h, h half the phase between the ends of an extent (x, y), in place.
void filter_amplitudes(const SeaField& field, std::size_t count, double x, double y, FlowScratch& s);
/// The same of an extent that changes at rates (x_rate, y_rate), m/s, with the rates of the amplitudes.
void filter_turning(const SeaField& field, std::size_t count, double x, double y, double x_rate,
                    double y_rate, FlowScratch& s);
/// From rates to their quotients with the amplitudes.
void take_quotients(std::size_t count, FlowScratch& s);
void set_phasors(const SeaField& field, std::size_t count, double t, double x, double y, FlowScratch& s);
void set_turns(const SeaField& field, std::size_t count, double dx, double dy, FlowScratch& s);
/// From the phasors of waves of unit height to those of all sums of a NearSea, of `few` amplitudes each.
void take_amplitudes(const double* amplitudes, std::size_t few, std::size_t count, FlowScratch& s);
/// Elevation, its rate, and its slopes, with what the quotients add to the rate.
void add_surface(const SeaField& field, std::size_t count, FlowScratch& s, LocalFlow<double>& out);
/// The same at the next point.
void add_next_surface(const SeaField& field, std::size_t count, FlowScratch& s, LocalFlow<double>& out);
/// The next decays are not near any.
void forget_decays(FlowScratch& s);
/// Decays over a height around a level, from those of the point before where these are near.
void set_decays(const SeaField& field, std::size_t count, double level, double height, FlowScratch& s);
void set_decay_steps(const SeaField& field, std::size_t count, double dz, FlowScratch& s);
void step_decays(std::size_t count, FlowScratch& s);
/// Velocity, acceleration and pressure of the waves: their means over the height of the decays.
void add_interior(const SeaField& field, std::size_t count, const FlowScratch& s, LocalFlow<double>& out);

/// Between four knots of a table, of each its value, rate and acceleration, `count` of them.
void write_weighed(const std::array<std::array<const double*, 3>, 4>& knots, const HermiteWeights& by,
                   std::size_t count, double* out);
/// Sums over `count` harmonics, six rows of them, of shares times each, `few` of them side by side: rows 0
/// and 1 to `value`, and so on.
void sum_shares(const double* shares, const double* harmonics, std::size_t count, std::size_t few,
                double* value, double* rate, double* acceleration);

}  // namespace seacrane::sea
