#pragma once

#include <algorithm>
#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "seacrane/elements/difference.hpp"
#include "seacrane/elements/loads/heave_signal.hpp"
#include "seacrane/elements/loads/load_kind.hpp"

/// All that the engine asks of a load, made of its own members. Included by the object of each load alone.
namespace seacrane {

/// A load with kinks over the state, told by margins.
template <class Load>
concept HasMargins = requires(const Load& load, const LoadInput<double>& in) {
  load.margins(in);
};
template <class Load>
concept HasSides = HasMargins<Load> || requires(const Load& load, const LoadInput<double>& in) {
  load.side(in);
};
/// A load with states that jump where its side changes.
template <class Load>
concept Jumps = requires(const Load& load, const LoadInput<double>& in, double* states) {
  { load.jumps(Side(), Side()) } -> std::same_as<bool>;
  load.settle(in, std::optional<Side>(), states);
};
template <class Load>
concept HasUnit = requires(const Load& load, const LoadInput<double>& in, Vec6d* wrenches) {
  load.add_unit(0, in, wrenches);
};
/// A load that, where it is quasi-static, has a tension that depends on accelerations.
template <class Load>
concept HasInertialTension = requires(const Load& load) {
  load.quasi_static();
  load.place;
};
/// A load that is a force of the value and the rate of a joint's coordinate.
template <class Load>
concept ActsAlong = requires(const Load& load, const LoadInput<double>& in) {
  load.coordinate.joint;
  load.force(in, 0.0, 0.0);
};
template <class Load>
concept ByDifferences = requires {
  requires Load::by_differences;
};
template <class Load>
concept Follows = requires {
  Load::follows_as;
};
template <class Load>
concept FromOutside = requires {
  requires Load::from_outside;
};
template <class Load>
concept Leads = requires(const typename Load::Description& d) {
  Load::leads(d);
};

/// A load that has what it takes most work to find in common with those beside it that it shares() it with,
/// which apply() and add_inertia() take at once.
template <class Load>
concept SharesWork = requires(const Load& load, std::span<const Load> row, const LoadInput<double>& in,
                              LoadSum<double>& sum, Mat6d* mass) {
  Load::apply(row, in, sum);
  Load::add_inertia(row, in, mass);
  { load.shares(load) } -> std::same_as<bool>;
};

template <class Load>
class LoadListOf final : public LoadsOf<Load> {
 public:
  using typename LoadList::Place;
  using typename LoadList::Slopes;
  using LoadsOf<Load>::items;

  LoadListOf() : LoadsOf<Load>(load_kind<Load>()) {}
  std::unique_ptr<LoadList> copy() const override { return std::make_unique<LoadListOf>(*this); }
  std::unique_ptr<LoadList> empty() const override { return std::make_unique<LoadListOf>(); }
  void take(const LoadList& other, Place i) override {
    add(static_cast<const LoadListOf&>(other).items[i], other.names[i]);
  }
  void add(const Load& load, const std::string& name) {
    const auto& on = load.bodies();
    this->names.push_back(name);
    this->bodies.emplace_back(on.begin(), on.end());
    if constexpr (SharesWork<Load>) {
      if (items.empty() || !load.shares(items.back())) rows_.push_back(items.size());
      ++rows_.back();
    }
    items.push_back(load);
  }

  void apply(const LoadInput<double>& in, LoadSum<double>& sum) const override {
    if constexpr (SharesWork<Load>) {
      for_each_row([&](std::span<const Load> row) { Load::apply(row, in, sum); });
    } else {
      for (const Load& load : items) load.template apply<double>(in, sum);
    }
  }
  void apply(Place i, const LoadInput<double>& in, LoadSum<double>& sum) const override {
    items[i].template apply<double>(in, sum);
  }
  void apply(Place i, const LoadInput<Slopes>& in, LoadSum<Slopes>& sum) const override {
    if constexpr (!ByDifferences<Load>) items[i].template apply<Slopes>(in, sum);
  }
  void add_inertia(const LoadInput<double>& in, Mat6d* mass) const override {
    if constexpr (AddsInertia<Load> && SharesWork<Load>) {
      for_each_row([&](std::span<const Load> row) { Load::add_inertia(row, in, mass); });
    } else if constexpr (AddsInertia<Load>) {
      for (const Load& load : items) load.template add_inertia<double>(in, mass);
    }
  }
  void add_inertia(Place i, const LoadInput<Slopes>& in, Mat6<Slopes>* mass) const override {
    static_assert(!(AddsInertia<Load> && ByDifferences<Load>), "inertia is differentiated by dual numbers");
    if constexpr (AddsInertia<Load>) items[i].template add_inertia<Slopes>(in, mass);
  }
  void add_potential(const LoadInput<double>& in, double& sum) const override {
    if constexpr (requires(const Load& load) { load.potential(in); }) {
      for (const Load& load : items) sum += load.potential(in);
    }
  }
  bool looks_at_states(Place i, int first, int last) const override {
    return seacrane::looks_at_states(items[i], first, last);
  }
  StateRange states(Place i) const override {
    if constexpr (HasStates<Load>) return items[i].states;
    return {};
  }
  void add_unit(Place i, int component, const LoadInput<double>& in, Vec6d* wrenches) const override {
    if constexpr (HasUnit<Load>) items[i].add_unit(component, in, wrenches);
  }
  std::vector<LoadKinks> kinks(Place i) const override { return items[i].kinks(); }

  bool has_sides(Place i) const override {
    if constexpr (requires(const Load& load) { load.has_sides(); }) return items[i].has_sides();
    return HasSides<Load>;
  }
  Sight look(Place i, const LoadInput<double>& in) const override {
    if constexpr (requires(const Load& load) { load.look(in); }) return items[i].look(in);
    Sight out;
    if constexpr (HasMargins<Load>) {
      out.side = items[i].margins(in).side();
    } else if constexpr (HasSides<Load>) {
      out.side = items[i].side(in);
    }
    return out;
  }
  double across(Place i, const LoadInput<double>& in, const Side& from, const Side& to) const override {
    if constexpr (HasMargins<Load>) {
      return items[i].margins(in).across(from, to);
    } else if constexpr (HasSides<Load>) {
      return items[i].across(in, from, to);
    }
    return 1.0;
  }
  std::vector<std::string> reached(Place i, const Side& from, const Side& to) const override {
    if constexpr (requires(const Load& load) {
                    { load.reached(Side(), Side()) } -> std::convertible_to<std::string>;
                  }) {
      return {items[i].reached(from, to)};
    } else if constexpr (requires(const Load& load) { load.reached(Side(), Side()); }) {
      return items[i].reached(from, to);
    }
    return {};
  }
  std::vector<Happening> happened(Place i, const LoadInput<double>& in, const Side& from,
                                  const Side& to) const override {
    if constexpr (requires(const Load& load) { load.happened(in, from, to); }) {
      return items[i].happened(in, from, to);
    }
    return {};
  }
  bool jumps(Place i, const Side& from, const Side& to) const override {
    if constexpr (Jumps<Load>) return items[i].jumps(from, to);
    return false;
  }
  void settle(Place i, const LoadInput<double>& in, const std::optional<Side>& side,
              double* all_states) const override {
    if constexpr (Jumps<Load>) items[i].settle(in, side, all_states);
  }
  void check_start(Place i, const LoadInput<double>& in, const std::vector<double>& weights) const override {
    if constexpr (requires(const Load& load) { load.check_start(in, weights); }) {
      items[i].check_start(in, weights);
    }
  }
  std::string refused(Place i, const Side& side) const override {
    if constexpr (requires(const Load& load) { load.refused(side); }) return items[i].refused(side);
    return "";
  }
  bool slack(Place i, const Side& side) const override {
    if constexpr (requires(const Load& load) { load.slack(side); }) return items[i].slack(side);
    return false;
  }

  StateRange stiff_states(Place i) const override {
    if constexpr (StiffLoad<Load>) return items[i].stiff_states();
    return {};
  }
  StiffSlopes stiff_slopes(Place i, const LoadInput<double>& in) const override {
    if constexpr (StiffLoad<Load>) return items[i].stiff_slopes(in);
    return {};
  }

  int inertial_place(Place i) const override {
    if constexpr (HasInertialTension<Load>) return items[i].quasi_static() ? items[i].place : -1;
    return -1;
  }
  void inertial(Place i, const LoadInput<double>& in, InertialTension& out) const override {
    if constexpr (HasInertialTension<Load>) items[i].inertial(in, items[i].motion(in), out);
  }
  Slopes inertial(Place i, const LoadInput<Slopes>& in, const Vec6d* acceleration) const override {
    if constexpr (HasInertialTension<Load>) {
      return items[i].inertial_tension(in, items[i].motion(in), acceleration);
    }
    return Slopes();
  }

  const CoordinateData* coordinate(Place i) const override {
    if constexpr (ActsAlong<Load>) return &items[i].coordinate;
    return nullptr;
  }
  double force(Place i, const LoadInput<double>& in, double value, double rate) const override {
    if constexpr (ActsAlong<Load>) return items[i].template force<double>(in, value, rate);
    return 0.0;
  }
  double stiffness(Place i, const LoadInput<double>& in) const override {
    if constexpr (StiffLoad<Load>) {  // with states that follow its rate
      const StiffSlopes slopes = items[i].stiff_slopes(in);
      const Eigen::Index n = slopes.rows() - 1;
      return std::abs(slopes.block(0, 1, 1, n).row(0).dot(slopes.block(1, 0, n, 1).col(0)));
    } else if constexpr (ActsAlong<Load> && HasUnit<Load>) {
      return items[i].d.stiffness;
    }
    return 0.0;
  }

 private:
  /// Calls f(loads that share work).
  template <class F>
  void for_each_row(F&& f) const {
    Place begin = 0;
    for (const Place end : rows_) {
      f(std::span<const Load>(items).subspan(begin, end - begin));
      begin = end;
    }
  }

  std::vector<Place> rows_;  // behind the last of each that share work
};

/// A load on one body does nothing to the ground; one between bodies, nothing to bodies that move as one:
/// there its forces cancel and do no work, unless they are from outside. States go on all the same.
template <class Load>
bool acts(const Load& load, int ground) {
  if constexpr (HasStates<Load>) {
    if (load.states.count > 0) return true;
  }
  const auto& bodies = load.bodies();
  const auto& first = *bodies.begin();
  if constexpr (FromOutside<Load>) return std::ranges::any_of(bodies, [&](int b) { return b != ground; });
  if (bodies.size() == 1) return first != ground;
  return std::any_of(bodies.begin(), bodies.end(), [&](int b) { return b != first; });
}

template <class Load>
class DescribedLoadsOf final : public DescribedAs<Load> {
 public:
  using DescribedAs<Load>::items;

  DescribedLoadsOf() : DescribedAs<Load>(load_kind<Load>()) {}
  std::unique_ptr<DescribedLoads> copy() const override { return std::make_unique<DescribedLoadsOf>(*this); }
  void add_example() override { items.push_back(Load::example()); }
  std::vector<std::string> names() const override {
    std::vector<std::string> out;
    for (const auto& d : items) out.push_back(d.name);
    return out;
  }
  void check(SceneNames& names) const override {
    for (const auto& d : items) {
      const Check c(Load::kind, d.name);
      check_fields(d, c);
      Load::check(d, c, names);
    }
  }
  std::vector<Lead> leads() const override {
    std::vector<Lead> out;
    if constexpr (Leads<Load>) {
      for (const auto& d : items) {
        for (const auto& [as, name] : Load::leads(d)) out.push_back({d.name, as, name});
      }
    }
    return out;
  }
  std::string difference(const DescribedLoads& other) const override {
    return seacrane::difference(Load::kind, items, static_cast<const DescribedLoadsOf&>(other).items);
  }
  void compile(LoadContext& context, CompiledLoads& out) const override {
    auto list = std::make_unique<LoadListOf<Load>>();
    for (const auto& d : items) {
      const Load load = Load::compile(d, context);
      if (acts(load, context.ground())) list->add(load, d.name);
      if constexpr (Leads<Load>) {
        for (const auto& [as, name] : Load::leads(d)) context.lead(as, name, {d.ratio, load.signal});
      }
    }
    if (list->size() > 0) out.lists.emplace_back(std::move(list));
  }
};

template <class Load>
const LoadKind& load_kind() {
  static const LoadKind kind{
      .name = Load::kind,
      .follows_as =
          [] {
            if constexpr (Follows<Load>) return Load::follows_as;
            return "";
          }(),
      .packs = TakesPacks<Load>,
      .by_differences = ByDifferences<Load>,
      .adds_inertia = AddsInertia<Load>,
      .describe = []() -> std::unique_ptr<DescribedLoads> {
        return std::make_unique<DescribedLoadsOf<Load>>();
      },
  };
  return kind;
}

}  // namespace seacrane
