#pragma once

#include <vector>

#include "seacrane/hydro/convolution.hpp"
#include "seacrane/hydro/vessel.hpp"

namespace seacrane {

struct Model;

/// Past motions of the vessels whose fluid memory is a convolution, in their order. They change between steps
/// only.
class VesselHistories {
 public:
  struct History {
    std::size_t vessel, body;
    RunningConvolution memory;
  };

  explicit VesselHistories(const Model& model);

  bool empty() const { return histories_.empty(); }
  auto begin() { return histories_.begin(); }
  auto end() { return histories_.end(); }
  auto begin() const { return histories_.begin(); }
  auto end() const { return histories_.end(); }
  /// The convolution of a vessel; null where its memory has states, or where it has none.
  const RunningConvolution* of(int vessel) const;

  std::vector<TwistHistory> save() const;
  /// Goes on from what was saved. Throws std::invalid_argument for histories of another scene.
  void restore(double t, const std::vector<TwistHistory>& saved);
  /// At rest before t; yaw frames of the vessels and accelerations of the bodies at t.
  void start(double t, const std::vector<YawFrame<double>>& frames, const std::vector<Vec6d>& acceleration);
  /// When the next sample is due: no evaluation may go beyond. Infinity where there are no histories.
  double next_sample() const;
  /// Takes the samples due at t.
  void sample(double t, const std::vector<YawFrame<double>>& frames);

 private:
  std::vector<History> histories_;
};

}  // namespace seacrane
