#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seacrane/elements/joint_coordinate.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/math/dual.hpp"

namespace seacrane {

struct LoadKind;

/// A value of a type that only its own object knows, copied with what holds it.
template <class T>
class Held {
 public:
  Held(std::unique_ptr<T> value) : value_(std::move(value)) {}
  Held(const Held& other) : value_(other.value_->copy()) {}
  Held(Held&&) noexcept = default;
  Held& operator=(Held other) noexcept {
    value_ = std::move(other.value_);
    return *this;
  }
  T& operator*() const { return *value_; }
  T* operator->() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

/// Compiled loads of one kind, side by side: what the engine asks of them, with one call for all of them
/// where it evaluates the equations of motion, and for one by its place otherwise. What a kind does not have
/// is nothing: no states, no sides, no power.
class LoadList {
 public:
  using Slopes = Dual<12>;  // of BodyResidual
  using Place = std::size_t;

  const LoadKind& kind;
  std::vector<std::string> names;
  std::vector<std::vector<int>> bodies;  // on which each acts

  explicit LoadList(const LoadKind& of) : kind(of) {}
  virtual ~LoadList() = default;
  virtual std::unique_ptr<LoadList> copy() const = 0;
  virtual std::unique_ptr<LoadList> empty() const = 0;
  /// Adds a load of another list of the kind.
  virtual void take(const LoadList& other, Place i) = 0;
  Place size() const { return names.size(); }

  virtual void apply(const LoadInput<double>& in, LoadSum<double>& sum) const = 0;
  virtual void apply(Place i, const LoadInput<double>& in, LoadSum<double>& sum) const = 0;
  virtual void apply(Place i, const LoadInput<Slopes>& in, LoadSum<Slopes>& sum) const = 0;
  /// Adds to the masses of bodies, see AddsInertia.
  virtual void add_inertia(const LoadInput<double>& in, Mat6d* mass) const = 0;
  virtual void add_inertia(Place i, const LoadInput<Slopes>& in, Mat6<Slopes>* mass) const = 0;
  virtual void add_potential(const LoadInput<double>& in, double& sum) const = 0;
  virtual bool looks_at_states(Place i, int first, int last) const = 0;
  /// The states of load i itself, whose rates it sets.
  virtual StateRange states(Place i) const = 0;
  /// What one newton along its direction, or of a component, puts on the bodies.
  virtual void add_unit(Place i, int component, const LoadInput<double>& in, Vec6d* wrenches) const = 0;
  virtual std::vector<LoadKinks> kinks(Place i) const = 0;

  // A load with sides, as Switches ask.
  virtual bool has_sides(Place i) const = 0;
  /// Its side, and what it sees from there.
  virtual Sight look(Place i, const LoadInput<double>& in) const = 0;
  virtual double across(Place i, const LoadInput<double>& in, const Side& from, const Side& to) const = 0;
  /// Names of bounds that are reached where the side changes; and what happened there.
  virtual std::vector<std::string> reached(Place i, const Side& from, const Side& to) const = 0;
  virtual std::vector<Happening> happened(Place i, const LoadInput<double>& in, const Side& from,
                                          const Side& to) const = 0;
  /// Whether its states jump there.
  virtual bool jumps(Place i, const Side& from, const Side& to) const = 0;
  /// Writes those that jump, among the states of all loads, as it was on `side`; as far as the state shows
  /// that they are not given, where that is not known.
  virtual void settle(Place i, const LoadInput<double>& in, const std::optional<Side>& side,
                      double* all_states) const = 0;
  /// Throws where it cannot start so. N: what bodies weigh.
  virtual void check_start(Place i, const LoadInput<double>& in,
                           const std::vector<double>& weights) const = 0;
  /// Why a side is refused; empty: it is not. And whether that is slack of a line.
  virtual std::string refused(Place i, const Side& side) const = 0;
  virtual bool slack(Place i, const Side& side) const = 0;

  // A load with stiff states.
  virtual StateRange stiff_states(Place i) const = 0;
  virtual StiffSlopes stiff_slopes(Place i, const LoadInput<double>& in) const = 0;

  // A load whose tension depends on accelerations.
  /// Its place among these tensions; -1: it has none.
  virtual int inertial_place(Place i) const = 0;
  virtual void inertial(Place i, const LoadInput<double>& in, InertialTension& out) const = 0;
  virtual Slopes inertial(Place i, const LoadInput<Slopes>& in, const Vec6d* acceleration) const = 0;

  // A load along a coordinate of a joint, which a tree may have.
  /// Null: it is none.
  virtual const CoordinateData* coordinate(Place i) const = 0;
  virtual double force(Place i, const LoadInput<double>& in, double value, double rate) const = 0;
  /// With which it holds what lines hang on, N/m or N m/rad; 0: with none.
  virtual double stiffness(Place i, const LoadInput<double>& in) const = 0;
};

/// Its loads, for those who know their type.
template <class Load>
struct LoadsOf : LoadList {
  using LoadList::LoadList;
  std::vector<Load> items;
};

}  // namespace seacrane
