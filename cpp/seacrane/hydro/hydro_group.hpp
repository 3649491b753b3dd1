#pragma once

#include <array>
#include <vector>

#include "seacrane/hydro/vessel.hpp"

namespace seacrane {

/// Vessels in one water, whose motions load each other: (M + A) v' + K * v + ... = F over six motions of
/// each, A and K of two vessels in the yaw frame of each, R_i A_ij R_j^T. What a vessel has by itself stays
/// its own. Power of -R A d/dt(R^T v) is minus the rate of 1/2 nu^T A nu, nu_i = R_i^T v_i, as for one.
struct HydroGroup {
  static constexpr int most_vessels = 8;
  template <class T>
  using Motions = std::array<T, 6 * most_vessels>;  // of each vessel in turn

  /// Two of its vessels, by their places in it, the first behind the second.
  struct Pair {
    int first, second;
    Mat6d added_mass;  // load on the first over the acceleration of the second
  };
  std::vector<int> vessels;  // of the model
  std::vector<Pair> pairs;
  Memory memory;          // over the motions of all
  int memory_offset = 0;  // in the state vector

  int motions() const { return 6 * static_cast<int>(vessels.size()); }
  int place_of(int vessel) const {
    for (std::size_t i = 0; i < vessels.size(); ++i) {
      if (vessels[i] == vessel) return static_cast<int>(i);
    }
    return -1;
  }

  /// Calls f(pair, mass, bias of the first, bias of the second) for every two vessels, inertial axes;
  /// `frames` of all vessels of the model.
  template <class T, class F>
  void couple(const YawFrame<T>* frames, F&& f) const {
    for (const Pair& pair : pairs) {
      const YawFrame<T>&a = frames[vessels[idx(pair.first)]], &b = frames[vessels[idx(pair.second)]];
      const Mat6<T> mass = between<T>(a, pair.added_mass, b);
      const Vec6<T> first = mass * b.to_inertial(b.turning()),
                    second = mass.transpose() * a.to_inertial(a.turning());
      f(pair, mass, first, second);
    }
  }

  /// Rates of the memory states, and the loads that they hold back.
  template <class T>
  void remember(const YawFrame<T>* frames, const T* x, T* x_rate, Motions<T>& mu) const {
    Motions<T> twists;
    for (std::size_t i = 0; i < vessels.size(); ++i) {
      for (int k = 0; k < 6; ++k) {
        twists[6 * i + idx(k)] = frames[vessels[i]].twist[k];
        mu[6 * i + idx(k)] = T(0);
      }
    }
    memory.evaluate<T>(twists.data(), x, x_rate, mu.data());
  }

  /// Adds the loads of the memory to all; `of_model`, `frames`: all vessels.
  template <class T>
  void apply(const Vessel* of_model, const YawFrame<T>* frames, const T* x, T* x_rate,
             LoadSum<T>& out) const {
    if (memory.states() == 0) return;
    Motions<T> mu;
    remember(frames, x, x_rate, mu);
    for (std::size_t i = 0; i < vessels.size(); ++i) {
      of_model[vessels[i]].radiate(frames[vessels[i]], Vec6<T>(Eigen::Map<const Vec6<T>>(&mu[6 * i])), out);
    }
  }
};

}  // namespace seacrane
