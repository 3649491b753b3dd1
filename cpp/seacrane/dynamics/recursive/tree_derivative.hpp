#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "seacrane/dynamics/inertia.hpp"
#include "seacrane/dynamics/recursive/driven_speeds.hpp"
#include "seacrane/dynamics/recursive/tree_kinematics.hpp"
#include "seacrane/dynamics/recursive/turning_inertia.hpp"
#include "seacrane/model/model.hpp"

namespace seacrane {

/// The loads along a coordinate that is one of a tree, the angle of a hinge, the way of a slide or the stroke
/// of a strut: torques on its speeds instead of wrenches on two bodies. Reads the loads of the model.
class TreeActuators {
 public:
  TreeActuators(const Model& model, const BodyTree& tree);

  /// The loads of the model that are left to the bodies.
  const CompiledLoads& others() const { return others_; }

  struct Along {
    const LoadList* list;
    std::size_t at;
    int q, u;
    int strut;    // -1: the coordinate is that of the joint itself
    double sign;  // of the load's coordinate over the tree's
  };
  const std::vector<Along>& along() const { return along_; }

  /// Adds torques on the speeds, and their power, at the kinematics' last place(). The force of load k of
  /// along(), at the value and the rate of its coordinate, is force_of(k, input, value, rate).
  template <class T, class Force>
  void apply(const LoadInput<T>& in, const TreeKinematics<T>& tree, const T* q, const T* u, T* torque,
             LoadSum<T>& sum, Force&& force_of) const {
    for (std::size_t k = 0; k < along_.size(); ++k) {
      const Along& a = along_[k];
      const T slope = a.strut < 0 ? T(a.sign) : T(a.sign) * tree.stroke(a.strut).slope;
      const T value = T(a.sign) * (a.strut < 0 ? q[a.q] : tree.stroke(a.strut).value);
      const T rate = slope * u[a.u];
      const T force = force_of(k, in, value, rate);
      torque[a.u] += slope * force;
      sum.add_power(force * rate);
    }
  }

 private:
  CompiledLoads others_;
  std::vector<Along> along_;
};

/// What the recursive form's right-hand side does on numbers as on packs of them: the inertias of bodies and
/// of what couples them, the loads without velocity terms, the accelerations, what drivers prescribe, and
/// their power. Loads, and constraint rows, are its owner's. Scratch of one run.
template <class T>
class TreeDerivative {
 public:
  TreeDerivative(const Model& model, std::vector<TurningMass<T>> masses)
      : model_(model),
        tree_(build_tree(model)),
        articulated_(tree_, model.body_count()),
        driven_(model, tree_),
        masses_(std::move(masses)),
        bias_(idx(model.body_count()), Wrench<T>::zero()),
        torque_(idx(tree_.speeds), T(0)),
        driven_rate_(torque_),
        jump_(idx(tree_.speeds), 0.0),
        links_(links_of(tree_)) {}
  TreeDerivative(const TreeDerivative&) = delete;  // its parts look at one another
  TreeDerivative& operator=(const TreeDerivative&) = delete;

  const BodyTree& tree() const { return tree_; }
  ArticulatedTree<T>& articulated() { return articulated_; }
  DrivenSpeeds& driven() { return driven_; }
  /// Of actuators, on the speeds.
  std::vector<T>& torque() { return torque_; }
  /// Rates of the speeds that drivers prescribe.
  std::vector<T>& driven_rate() { return driven_rate_; }

  /// Inertias of all bodies for the next factor(), and their velocity terms b, eq (5). `frames`: by vessel;
  /// `added`: what loads add, by body (null: nothing). Calls kept(body, inertia), a SpatialInertia or a
  /// CompactInertia.
  template <class Kept>
  void evaluate_inertia(const BodyKinematics<T>* bodies, const YawFrame<T>* frames, const Mat6<T>* added,
                        Kept&& kept) {
    for (int b = 0; b < model_.body_count(); ++b) {
      const BodyModel& body = model_.bodies[idx(b)];
      const BodyKinematics<T>& k = bodies[b];
      if (!body.full) {
        const CompactInertia<T> inertia = masses_[idx(b)].at(k.rotation);
        bias_[idx(b)].moment() = cross<T>(k.angular_velocity, inertia.turning * k.angular_velocity);
        articulated_.set_inertia(b, inertia);
        kept(b, inertia);
        continue;
      }
      SpatialInertia<T> mass;
      bias_[idx(b)] = full_terms<T>(model_, body, masses_[idx(b)], k, frames, mass);
      if (added != nullptr) mass += SpatialInertia<T>(added[b]);
      articulated_.set_inertia(b, mass);
      kept(b, mass);
    }
    for (std::size_t i = 0; i < tree_.coupled.size(); ++i) couple(i, frames);
  }

  /// What acts on a body without its velocity terms.
  Wrench<T> load(int body, const BodyLoad<T>& applied) const {
    const Wrench<T>& bias = bias_[idx(body)];
    return {applied.force - bias.force(), applied.moment - bias.moment()};
  }

  /// How the speeds of what is not driven jump where those of drivers do at t, at the last factor(); into
  /// `u_rate`, and added to `u`.
  void strike(T* u_rate, T* u) {
    for (int b = 0; b < model_.body_count(); ++b) articulated_.set_load(b, Wrench<T>::zero());
    for (std::size_t k = 0; k < jump_.size(); ++k) driven_rate_[k] = T(jump_[k]);
    articulated_.solve(false, u_rate, nullptr, driven_rate_.data());
    for (const Cluster& c : tree_.clusters) {
      for (int k = c.u; k < c.u + c.speeds && !c.is_driven(); ++k) u[k] += u_rate[k];
    }
  }
  /// How driven speeds jump, see DrivenSpeeds.
  double* jump() { return jump_.data(); }

  /// At the last solution: what DrivenSpeeds reads, then the tensions of the links that are branches, N. They
  /// are linear in the loads. `moved`: the only clusters that it was of; empty: all.
  void read_forces(std::vector<T>& forces, const std::vector<std::size_t>& moved = {}) const {
    forces.clear();
    driven_.read(articulated_, forces);
    for (const std::size_t link : links_) {
      const bool stays = !moved.empty() && std::ranges::find(moved, link) == moved.end();
      forces.push_back(stays ? T(0) : -articulated_.held(link));
    }
  }
  std::size_t force_count() const { return driven_.count() + links_.size(); }
  /// The place among these of the tension of an element that is such a link.
  std::optional<std::size_t> link(int element) const {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (tree_.clusters[links_[i]].element == element) return driven_.count() + i;
    }
    return std::nullopt;
  }

 private:
  /// Masses between bodies of a group, and their velocity terms.
  void couple(std::size_t i, const YawFrame<T>* frames) {
    const HydroGroup& group = model_.groups[tree_.coupled[i].group];
    const auto add = [&](int place, const Vec6<T>& bias) {
      bias_[idx(model_.vessels[idx(group.vessels[idx(place)])].body)] += Wrench<T>(bias);
    };
    group.template couple<T>(frames, [&](const HydroGroup::Pair& pair, const Mat6<T>& mass,
                                         const Vec6<T>& first, const Vec6<T>& second) {
      articulated_.set_coupling(i, pair.first, pair.second, mass);
      add(pair.first, first);
      add(pair.second, second);
    });
  }

  const Model& model_;
  BodyTree tree_;
  ArticulatedTree<T> articulated_;
  DrivenSpeeds driven_;
  std::vector<TurningMass<T>> masses_;
  std::vector<Wrench<T>> bias_;  // by body
  std::vector<T> torque_, driven_rate_;
  std::vector<double> jump_;
  std::vector<std::size_t> links_;  // clusters
};

}  // namespace seacrane
