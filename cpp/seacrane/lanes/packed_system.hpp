#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "seacrane/dynamics/recursive/tree_branches.hpp"
#include "seacrane/dynamics/recursive/tree_derivative.hpp"
#include "seacrane/elements/loads/registry.hpp"
#include "seacrane/lanes/lane_system.hpp"
#include "seacrane/lanes/loads_by_lane.hpp"
#include "seacrane/lanes/packed_load.hpp"
#include "seacrane/lanes/packed_table.hpp"
#include "seacrane/lanes/tensions_by_lane.hpp"
#include "seacrane/math/pack.hpp"
#include "seacrane/model/difference.hpp"

namespace seacrane {

/// The recursive formulation on packs: the templates of the scalar one, without what
/// kept_out_of_lanes() refuses.
template <int L>
class PackedSystem final : public LaneSystem {
 public:
  using T = Pack<L>;

  /// One model for each of L lanes.
  explicit PackedSystem(const LaneModels& models)
      : model_(models.front()->merged ? models.front()->merged : models.front()),
        own_(*model_, masses_of(models)),
        tree_(own_.tree()),
        articulated_(own_.articulated()),
        driven_(own_.driven()),
        actuators_(actuators_of(models, tree_)),
        by_lane_(loads_by_lane(models), drives_by_lane(models), model_->body_count(),
                 model_->load_states.size(), seas_of(models)),
        tensions_(by_lane_.lists(), model_->body_count(), tree_.speeds),
        speeds_(tree_.positions),
        memory_(speeds_ + tree_.speeds),
        loads_(memory_ + model_->layout.loads - model_->layout.memory),
        work_(memory_ + model_->layout.work - model_->layout.memory),
        slots_(idx(model_->slot_count), 0.0) {
    const auto bodies = idx(model_->body_count());
    positions_.assign(idx(tree_.positions), 0.0);
    for (auto* values : {&speed_, &speed_rate_}) values->assign(idx(tree_.speeds), 0.0);
    force_response_.resize(tensions_.count());
    state_.assign(idx(work_ + 2), T(0.0));
    rate_ = state_;
    bodies_.assign(bodies + 1, BodyKinematics<T>::ground());
    frames_.assign(model_->vessels.size(), YawFrame<T>(BodyKinematics<T>::ground()));
    for (std::size_t g = 0; g < model_->gravity.size(); ++g) {
      T weight;
      for (int lane = 0; lane < L; ++lane) weight.set(lane, models[idx(lane)]->stepped().gravity[g].weight);
      weights_.push_back(weight);
    }
    wrench_.resize(bodies + 1);
    if (by_lane_.adds_inertia()) added_inertia_.assign(bodies + 1, Mat6<T>::Zero());
    for (std::size_t w = 0; w < model_->wave_loads.size(); ++w) waves_.push_back(waves_of(models, w));
    for (const auto& list : actuators_.front().others().lists) {
      if (is_packed(models, *list)) applied_.emplace_back(packed(*list), &*list);
    }
    for (const auto& one : actuators_.front().along()) {
      along_.push_back(is_packed(models, *one.list) ? packed(*one.list) : nullptr);
    }
  }

  std::size_t size() const override { return L * state_.size(); }
  bool has_projection() const override { return true; }
  bool jacobian(double /*t*/, const double* /*y*/, double* /*out*/) override { return false; }
  void set_curve_limit(double time) override { curve_limit_ = time; }
  void set_inputs(const std::vector<double>& slots) override { slots_ = slots; }
  void freeze(std::size_t lane) override {
    frozen_.push_back(lane);
    by_lane_.freeze(lane);
    while (std::ranges::find(frozen_, leading_) != frozen_.end() && leading_ + 1 < L) ++leading_;
  }

  double turning_rate(std::size_t lane) const override {
    double square = 0.0;
    for (const BodyKinematics<T>& body : bodies_) {
      const T own = body.angular_velocity.dot(body.angular_velocity);
      square = std::max(square, own[static_cast<int>(lane)]);
    }
    return std::sqrt(square);
  }

  double evaluated_at() const override { return evaluated_at_; }

  void write_solution(std::vector<double>& out) const override {
    out.resize(L * (6 * idx(model_->body_count()) + forces_.size() + tensions_.count()));
    double* next = out.data();
    const auto put = [&](const T& value) {
      value.store(next);
      next += L;
    };
    for (int b = 0; b < model_->body_count(); ++b) {
      const Vec6<T> acceleration =
          (tensions_.any() ? tensions_.acceleration(b) : articulated_.acceleration(b)).vector();
      for (int i = 0; i < 6; ++i) put(acceleration[i]);
    }
    for (const T& force : forces_) put(force);
    for (std::size_t line = 0; line < tensions_.count(); ++line) put(tensions_.tension(line));
  }

  void derivative(double t, const double* y, double* ydot) override {
    evaluated_at_ = t;
    read(y);
    const T *const q = state_.data(), *const u = q + speeds_;
    if (driven_.any()) read_drivers(t);
    factor(t);
    LoadSum<T> sum{wrench_.data(), rate_.data() + loads_};
    evaluate_loads(t, sum);
    solve_acceleration();
    own_.read_forces(forces_);
    if (tensions_.any()) add_tensions(sum);
    for (std::size_t k = 0; k < driven_.count(); ++k) sum.add_power(driven_.power(k, forces_));
    articulated_.kinematics().position_rates(q, u, bodies_.data(), rate_.data());
    rate_[idx(work_)] = sum.power;
    rate_[idx(work_) + 1] = sum.absolute_power;
    write(rate_, ydot);
    for (const std::size_t lane : frozen_) {
      for (std::size_t i = 0; i < rate_.size(); ++i) ydot[L * i + lane] = 0.0;
    }
  }

  /// Lane by lane, as in the scalar form.
  bool project(double t, double* y, bool /*evaluated_here*/) override {
    bool changed = false;
    if (driven_.any()) {
      take_drivers(t, y);
      changed = true;
    }
    for_each_quaternion(tree_, [&](int at) {
      for (std::size_t lane = 0; lane < L; ++lane) {
        using Strided = Eigen::Map<Vec4d, 0, Eigen::InnerStride<L>>;
        changed |= normalise_drifted(Strided(y + L * idx(at) + lane));
      }
    });
    return changed;
  }

 private:
  /// Pack by pack: what the C library does with some thousand bytes (rep movsb) takes some processors a
  /// microsecond, at addresses that are chance.
  void read(const double* y) {
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = T::load(y + L * i);
  }
  static void write(const std::vector<T>& from, double* to) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i].store(to + L * i);
  }

  /// Of the bodies, which lanes may have each for itself.
  static std::vector<TurningMass<T>> masses_of(const LaneModels& models) {
    const std::vector<BodyModel>& first = models.front()->stepped().bodies;
    std::vector<TurningMass<T>> out(first.begin(), first.end());
    for (int lane = 0; lane < L; ++lane) {
      for (std::size_t b = 0; b < first.size(); ++b) {
        const BodyModel& own = models[idx(lane)]->stepped().bodies[b];
        out[b].alike = out[b].alike && own.inertia == first[b].inertia;
        out[b].mass.set(lane, own.mass);
        for (int i = 0; i < 9; ++i) out[b].inertia(i).set(lane, own.inertia(i));
      }
    }
    return out;
  }

  using Lists = typename LoadsByLane<L>::Lists;

  /// One for all lanes, or one for each where their loads differ.
  static std::vector<TreeActuators> actuators_of(const LaneModels& models, const BodyTree& tree) {
    std::vector<TreeActuators> out;
    out.emplace_back(models.front()->stepped(), tree);
    const bool alike = std::ranges::all_of(models.front()->stepped().loads.lists,
                                           [&](const auto& list) { return !differs(models, list->kind); });
    for (std::size_t lane = 1; lane < L && !alike; ++lane) out.emplace_back(models[lane]->stepped(), tree);
    return out;
  }
  static bool differs(const LaneModels& models, const LoadKind& kind) {
    return std::ranges::any_of(models, [&](const auto& model) {
      return model != models.front() && loads_differ(*models.front(), *model, kind);
    });
  }
  static bool is_packed(const LaneModels& models, const LoadList& list) {
    return list.kind.packs && !differs(models, list.kind);
  }
  const TreeActuators& actuators_of_lane(std::size_t lane) const {
    return actuators_[actuators_.size() == 1 ? 0 : lane];
  }
  /// Loads that take no packs, or have other numbers in other lanes.
  std::vector<Lists> loads_by_lane(const LaneModels& models) const {
    std::vector<Lists> out;
    const auto& first = actuators_.front().others().lists;
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (is_packed(models, *first[i])) continue;
      Lists& lists = out.emplace_back();
      for (std::size_t lane = 0; lane < L; ++lane) lists[lane] = &*actuators_of_lane(lane).others().lists[i];
    }
    return out;
  }
  static std::vector<SeaView> seas_of(const LaneModels& models) {
    std::vector<SeaView> out;
    for (const auto& model : models) {
      const Model& one = model->stepped();
      out.emplace_back(one.sea, one.stencils, one.near);
    }
    return out;
  }
  /// Lists with loads along coordinates of the tree whose forces differ.
  std::vector<Lists> drives_by_lane(const LaneModels& models) const {
    std::vector<Lists> out;
    const auto& first = actuators_.front().along();
    for (std::size_t k = 0; k < first.size(); ++k) {
      if (is_packed(models, *first[k].list)) continue;
      Lists& lists = out.emplace_back();
      for (std::size_t lane = 0; lane < L; ++lane) lists[lane] = actuators_of_lane(lane).along()[k].list;
    }
    return out;
  }

  /// Places the bodies, and factors their inertias.
  void factor(double t) {
    articulated_.place(state_.data(), state_.data() + speeds_, bodies_.data());
    for (std::size_t v = 0; v < frames_.size(); ++v) {
      frames_[v] = YawFrame<T>(bodies_[idx(model_->vessels[v].body)]);
    }
    if (by_lane_.adds_inertia()) {
      by_lane_.read(input(t));
      by_lane_.evaluate_inertia(added_inertia_.data());
    }
    own_.evaluate_inertia(bodies_.data(), frames_.data(),
                          added_inertia_.empty() ? nullptr : added_inertia_.data(), [](int, const auto&) {});
    articulated_.factor();
  }

  /// What drivers prescribe, which is the same in all lanes; their states say what it is near to.
  void read_drivers(double t) {
    read_leading();
    driven_.follow(t, curve_limit_, positions_.data(), speed_.data(), speed_rate_.data());
    for (const std::size_t i : driven_.clusters()) {
      const Cluster& c = tree_.clusters[i];
      for (int k = c.u; k < c.u + c.speeds; ++k) own_.driven_rate()[idx(k)] = T(speed_rate_[idx(k)]);
    }
  }

  void follow_drivers(double t) {
    read_drivers(t);
    for (const std::size_t i : driven_.clusters()) {
      const Cluster& c = tree_.clusters[i];
      for (int k = c.q; k < c.q + c.positions; ++k) state_[idx(k)] = T(positions_[idx(k)]);
      for (int k = c.u; k < c.u + c.speeds; ++k) state_[idx(speeds_ + k)] = T(speed_[idx(k)]);
    }
  }

  void read_leading() {
    const int lane = static_cast<int>(leading_);
    for (std::size_t k = 0; k < positions_.size(); ++k) positions_[k] = state_[k][lane];
    for (std::size_t k = 0; k < speed_.size(); ++k) speed_[k] = state_[idx(speeds_) + k][lane];
  }

  /// Takes over what drivers prescribe, and its impulse where it jumps in rate.
  void take_drivers(double t, double* y) {
    read(y);
    read_leading();
    const bool jumps = driven_.jump(t, curve_limit_, positions_.data(), speed_.data(), own_.jump());
    follow_drivers(t);
    if (jumps) {
      factor(t);
      own_.strike(rate_.data() + speeds_, state_.data() + speeds_);
    }
    write(state_, y);
  }

  void solve_acceleration() {
    for (int b = 0; b < model_->body_count(); ++b) articulated_.set_load(b, own_.load(b, wrench_[idx(b)]));
    articulated_.solve(true, rate_.data() + speeds_, own_.torque().data(), own_.driven_rate().data());
  }

  void add_tensions(LoadSum<T>& sum) {
    tensions_.add(by_lane_, articulated_, rate_.data() + speeds_, sum,
                  [&](std::size_t line) { own_.read_forces(force_response_[line]); });
    for (std::size_t line = 0; line < tensions_.count(); ++line) {
      for (std::size_t k = 0; k < forces_.size(); ++k) {
        forces_[k] += tensions_.tension(line) * force_response_[line][k];
      }
    }
  }

  struct Waves {
    int body, vessel;
    PackedTable<L, ExactWaveLoad> force;
    std::optional<PackedTable<L, DriftLoad>> drift;
  };

  static const PackedLoad<L>* packed(const LoadList& list) {
    return [&]<class... Load>(std::type_identity<std::tuple<Load...>>) {
      const PackedLoad<L>* out = nullptr;
      for (const PackedLoad<L>* one : {&packed_load<L, Load>()...}) {
        if (std::string(one->kind) == list.kind.name) out = one;
      }
      return out;
    }(std::type_identity<LoadTypes>{});
  }

  static Waves waves_of(const LaneModels& models, std::size_t load) {
    std::array<std::shared_ptr<const WaveTable>, L> force;
    std::array<std::shared_ptr<const DriftTable>, L> drift;
    for (std::size_t lane = 0; lane < L; ++lane) {
      const WaveLoadDescription& sources = models[lane]->stepped().wave_loads[load].sources;
      force[lane] = sources.table;
      drift[lane] = sources.drift_table;
    }
    const WaveLoad& wave = models.front()->stepped().wave_loads[load];
    Waves out{wave.body, wave.vessel, PackedTable<L, ExactWaveLoad>(force), std::nullopt};
    if (drift.front()) out.drift.emplace(drift);
    return out;
  }

  LoadInput<T> input(double t) const {
    return {t, curve_limit_, bodies_.data(), slots_.data(), state_.data() + loads_};
  }

  void evaluate_loads(double t, LoadSum<T>& sum) {
    const LoadInput<T> input = this->input(t);
    std::ranges::fill(wrench_, BodyLoad<T>());
    for (std::size_t g = 0; g < weights_.size(); ++g) model_->gravity[g].apply(input, weights_[g], sum);
    for (const auto& [kind, list] : applied_) kind->apply(*list, input, sum);
    if (by_lane_.any() && !by_lane_.adds_inertia()) by_lane_.read(input);
    if (!by_lane_.lists().empty()) by_lane_.apply(tensions_.none(), sum);
    std::ranges::fill(own_.torque(), T(0.0));
    actuators_.front().apply<T>(input, articulated_.kinematics(), state_.data(), state_.data() + speeds_,
                                own_.torque().data(), sum,
                                [&](std::size_t k, const LoadInput<T>& in, const T& value, const T& rate) {
                                  const TreeActuators::Along& one = actuators_.front().along()[k];
                                  if (along_[k] == nullptr) return drive_by_lane(k, value, rate);
                                  return along_[k]->force(*one.list, one.at, in, value, rate);
                                });
    for (std::size_t v = 0; v < frames_.size(); ++v) {
      const Vessel& vessel = model_->vessels[v];
      const auto own = idx(memory_ + vessel.memory_offset - model_->layout.memory);
      vessel.apply<T>(input, frames_[v], state_.data() + own, rate_.data() + own, sum);
    }
    for (const HydroGroup& group : model_->groups) {
      const auto own = idx(memory_ + group.memory_offset - model_->layout.memory);
      group.template apply<T>(model_->vessels.data(), frames_.data(), state_.data() + own, rate_.data() + own,
                              sum);
    }
    for (Waves& waves : waves_) apply(waves, t, sum);
  }

  T drive_by_lane(std::size_t k, const T& value, const T& rate) const {
    T out(0.0);
    by_lane_.for_each_lane(
        [&](int lane) {
          const TreeActuators::Along& one = actuators_of_lane(idx(lane)).along()[k];
          const LoadInput<double> in = by_lane_.input(lane, tensions_.none());
          out.set(lane, one.list->force(one.at, in, value[lane], rate[lane]));
        },
        [&](int lane) { out.set(lane, std::numeric_limits<double>::quiet_NaN()); });
    return out;
  }

  void apply(Waves& waves, double t, LoadSum<T>& sum) {
    T channels[PackedTable<L, ExactWaveLoad>::channels], drift[DriftLoad::channels];
    waves.force.evaluate(t, channels);
    Vec6<T> force;
    for (int i = 0; i < 6; ++i) force[i] = channels[i];
    if (waves.drift) {
      waves.drift->evaluate(t, drift);
      for (int i = 0; i < 6; ++i) force[i] += drift[i];
    }
    const YawFrame<T>& frame = frames_[idx(waves.vessel)];
    const Vec6<T> inertial = frame.to_inertial(force);
    wrench_[idx(waves.body)].force += inertial.template head<3>();
    wrench_[idx(waves.body)].moment += inertial.template tail<3>();
    sum.add_power(force.dot(frame.twist));
  }

  std::shared_ptr<const Model> model_;
  TreeDerivative<T> own_;
  const BodyTree& tree_;
  ArticulatedTree<T>& articulated_;
  DrivenSpeeds& driven_;
  std::vector<TreeActuators> actuators_;  // by lane, or of all
  LoadsByLane<L> by_lane_;
  TensionsByLane<L> tensions_;
  std::vector<T> forces_;                               // see TreeDerivative::read_forces
  std::vector<std::vector<T>> force_response_;          // to 1 N of each inertial tension
  std::vector<double> positions_, speed_, speed_rate_;  // of the lane that leads drivers
  std::size_t leading_ = 0;                             // the first that is not frozen
  int speeds_, memory_, loads_, work_;                  // where they begin in the state of a lane
  std::vector<double> slots_;
  double curve_limit_ = std::numeric_limits<double>::infinity();
  double evaluated_at_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::size_t> frozen_;
  std::vector<T> state_, rate_;
  std::vector<BodyKinematics<T>> bodies_;
  std::vector<YawFrame<T>> frames_;
  std::vector<T> weights_;  // of Model::gravity
  std::vector<BodyLoad<T>> wrench_;
  std::vector<Mat6<T>> added_inertia_;  // by body, of loads
  std::vector<Waves> waves_;
  std::vector<std::pair<const PackedLoad<L>*, const LoadList*>> applied_;
  std::vector<const PackedLoad<L>*> along_;  // by load along the tree; null: by lane
};

}  // namespace seacrane
