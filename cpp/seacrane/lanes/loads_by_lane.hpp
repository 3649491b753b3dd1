#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "seacrane/elements/loads/load_list.hpp"
#include "seacrane/math/pack.hpp"
#include "seacrane/sea/sea_view.hpp"

namespace seacrane {

/// Loads that take no packs, lane by lane: what they look at is taken from packs of kinematics, and what they
/// add is put into packs of wrenches. Where a load does not hold in a lane, the lane's numbers become NaN.
template <int L>
class LoadsByLane {
 public:
  using T = Pack<L>;

  /// Loads of one kind, those of each lane.
  using Lists = std::array<const LoadList*, L>;

  /// For lists of loads of `bodies` bodies, with `states` states of all loads, and `read`, whose forces
  /// others ask for; `seas`: one for each lane.
  LoadsByLane(std::vector<Lists> lists, const std::vector<Lists>& read, int bodies, std::size_t states,
              std::vector<SeaView> seas)
      : lists_(std::move(lists)),
        seas_(std::move(seas)),
        wrench_(idx(bodies) + 1),
        total_(idx(bodies) + 1),
        rates_(states, 0.0) {
    for (const Lists& list : lists_) {
      look_at(list);
      if (list[0]->kind.adds_inertia) adding_inertia_.push_back(list);
      for (std::size_t i = 0; i < list[0]->size(); ++i) {
        const StateRange own = list[0]->states(i);
        for (int k = own.first; k < own.first + own.count; ++k) own_states_.push_back(idx(k));
      }
    }
    for (const Lists& list : read) look_at(list);
    std::ranges::sort(bodies_);
    bodies_.erase(std::ranges::unique(bodies_).begin(), bodies_.end());
    for (auto& lane : kinematics_) lane.assign(idx(bodies) + 1, BodyKinematics<double>::ground());
    for (auto& lane : states_) lane.assign(states, 0.0);
    if (adds_inertia()) mass_.assign(idx(bodies) + 1, Mat6d::Zero());
  }

  const std::vector<Lists>& lists() const { return lists_; }
  /// Whether there is anything to look at.
  bool any() const { return !bodies_.empty(); }
  /// Those on which the loads act, or look.
  const std::vector<int>& bodies() const { return bodies_; }
  bool adds_inertia() const { return !adding_inertia_.empty(); }
  void freeze(std::size_t lane) { frozen_[lane] = true; }

  /// Takes what the loads look at. Call it before the others.
  void read(const LoadInput<T>& in) {
    now_ = {in.time, in.curve_limit, nullptr, in.slots, nullptr};
    for (int lane = 0; lane < L; ++lane) {
      for (const int b : bodies_) read_body(in.bodies[b], lane, kinematics_[idx(lane)][idx(b)]);
      std::vector<double>& states = states_[idx(lane)];
      for (std::size_t k = 0; k < states.size(); ++k) states[k] = in.states[k][lane];
    }
  }
  LoadInput<double> input(int lane, const double* inertial) const {
    LoadInput<double> out = now_;
    out.bodies = kinematics_[idx(lane)].data();
    out.states = states_[idx(lane)].data();
    out.inertial = inertial;
    out.sea = &seas_[idx(lane)];
    return out;
  }

  /// Calls f(lane) for each lane that is not frozen; f'(lane) where that throws.
  template <class F, class Fail>
  void for_each_lane(F&& f, Fail&& fail) const {
    for (int lane = 0; lane < L; ++lane) {
      if (frozen_[idx(lane)]) continue;
      try {
        f(lane);
      } catch (const std::domain_error&) {
        fail(lane);
      }
    }
  }

  /// Sets what loads add to the masses of the bodies on which they act, `mass` by body. Lanes that are frozen
  /// keep what they have.
  void evaluate_inertia(Mat6<T>* mass) {
    for_each_lane(
        [&](int lane) {
          const LoadInput<double> in = input(lane, nullptr);
          for_each_inertial_body([&](int b) { mass_[idx(b)].setZero(); });
          for (const Lists& list : adding_inertia_) list[idx(lane)]->add_inertia(in, mass_.data());
          for_each_inertial_body([&](int b) {
            for (int i = 0; i < 36; ++i) mass[b](i).set(lane, mass_[idx(b)](i));
          });
        },
        [&](int lane) {
          for_each_inertial_body([&](int b) {
            for (int i = 0; i < 36; ++i) mass[b](i).set(lane, std::numeric_limits<double>::quiet_NaN());
          });
        });
  }

  /// Adds the loads, with inertial tensions of zero.
  void apply(const double* inertial, LoadSum<T>& sum) {
    for (const int b : bodies_) total_[idx(b)].fill(T(0.0));
    T power(0.0), absolute_power(0.0);
    const auto put = [&](int lane, const LoadSum<double>& of) {
      power.set(lane, of.power);
      absolute_power.set(lane, of.absolute_power);
      for (const std::size_t k : own_states_) sum.state_rates[k].set(lane, rates_[k]);
    };
    for_each_lane(
        [&](int lane) {
          for (const int b : bodies_) wrench_[idx(b)] = BodyLoad<double>();
          LoadSum<double> of{wrench_.data(), rates_.data()};
          const LoadInput<double> in = input(lane, inertial);
          for (const Lists& list : lists_) list[idx(lane)]->apply(in, of);
          put(lane, of);
          for (const int b : bodies_) {
            for (int i = 0; i < 3; ++i) {
              total_[idx(b)][idx(i)].set(lane, wrench_[idx(b)].force[i]);
              total_[idx(b)][idx(3 + i)].set(lane, wrench_[idx(b)].moment[i]);
            }
          }
        },
        [&](int lane) {
          constexpr double none = std::numeric_limits<double>::quiet_NaN();
          LoadSum<double> of{nullptr};
          of.power = of.absolute_power = none;
          std::ranges::fill(rates_, none);
          put(lane, of);
          for (const int b : bodies_) {
            for (T& component : total_[idx(b)]) component.set(lane, none);
          }
        });
    for (const int b : bodies_) {
      for (int i = 0; i < 3; ++i) {
        sum.wrench[b].force[i] += total_[idx(b)][idx(i)];
        sum.wrench[b].moment[i] += total_[idx(b)][idx(3 + i)];
      }
    }
    sum.power += power;
    sum.absolute_power += absolute_power;
  }

 private:
  template <class F>
  void for_each_inertial_body(F&& f) const {
    for (const Lists& list : adding_inertia_) {
      for (const std::vector<int>& on : list[0]->bodies) {
        for (const int b : on) f(b);
      }
    }
  }

  void look_at(const Lists& list) {
    for (const std::vector<int>& on : list[0]->bodies) bodies_.insert(bodies_.end(), on.begin(), on.end());
  }

  static void read_body(const BodyKinematics<T>& from, int lane, BodyKinematics<double>& to) {
    for (int i = 0; i < 3; ++i) {
      to.position[i] = from.position[i][lane];
      to.velocity[i] = from.velocity[i][lane];
      to.angular_velocity[i] = from.angular_velocity[i][lane];
    }
    for (int i = 0; i < 9; ++i) to.rotation(i) = from.rotation(i)[lane];
  }

  std::vector<Lists> lists_, adding_inertia_;
  std::vector<SeaView> seas_;
  std::vector<int> bodies_;
  std::vector<std::size_t> own_states_;
  std::array<bool, L> frozen_{};
  LoadInput<double> now_{};
  std::array<std::vector<BodyKinematics<double>>, L> kinematics_;
  std::array<std::vector<double>, L> states_;
  std::vector<BodyLoad<double>> wrench_;
  std::vector<Mat6d> mass_;
  std::vector<std::array<T, 6>> total_;  // by body
  std::vector<double> rates_;
};

}  // namespace seacrane
