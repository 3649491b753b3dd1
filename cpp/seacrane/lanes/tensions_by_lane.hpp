#pragma once

#include <algorithm>
#include <vector>

#include "seacrane/dynamics/recursive/tree_branches.hpp"
#include "seacrane/lanes/loads_by_lane.hpp"

namespace seacrane {

/// InertialTensions of all lanes: lines say lane by lane what they need, the tree answers in packs, and the
/// equations of the tensions, which are few, are solved in packs without pivots: I plus what is nearly the
/// product of a positive diagonal and a matrix of compliances.
template <int L>
class TensionsByLane {
 public:
  using T = Pack<L>;

  using Lists = typename LoadsByLane<L>::Lists;

  TensionsByLane(const std::vector<Lists>& lists, int bodies, int speeds)
      : bodies_(bodies), unit_lane_(idx(bodies) + 1, Vec6d::Zero()), path_lane_(unit_lane_) {
    for (const Lists& list : lists) {
      for (std::size_t i = 0; i < list[0]->size(); ++i) {
        if (list[0]->inertial_place(i) < 0) continue;
        Line& line = lines_.emplace_back();
        line.list = list;
        line.at = i;
        line.touched = list[0]->bodies[i];
        std::erase(line.touched, bodies);  // the ground
        for (auto* all : {&line.unit, &line.path}) all->assign(line.touched.size(), Wrench<T>::zero());
        line.rates.assign(idx(speeds), T(0.0));
      }
    }
    std::ranges::sort(lines_, {}, [](const Line& line) { return line.list[0]->inertial_place(line.at); });
    without_.assign(idx(bodies) + 1, Twist<T>::zero());
    for (Line& line : lines_) line.response.assign(idx(bodies) + 1, Twist<T>::zero());
    matrix_.assign(lines_.size() * lines_.size(), T(0.0));
    zero_.assign(lines_.size(), 0.0);
    acceleration_.assign(idx(bodies) + 1, Vec6d::Zero());
  }

  bool any() const { return !lines_.empty(); }
  /// Inertial tensions of zero, as loads see them before they are known.
  const double* none() const { return zero_.data(); }

  std::size_t count() const { return lines_.size(); }
  /// Of a line, after add(), in the order of the model.
  const T& tension(std::size_t line) const { return lines_[line].tension; }
  /// Of a body, with the tensions, after add().
  Twist<T> acceleration(int body) const {
    Twist<T> out = without_[idx(body)];
    for (const Line& line : lines_) out += line.tension * line.response[idx(body)];
    return out;
  }

  /// Right after a solution without the tensions, with `u_rate`: adds what they change to that, and to
  /// wrenches and power. Calls responded(line) while the tree holds the response to 1 N of each.
  template <class Responded>
  void add(const LoadsByLane<L>& loads, ArticulatedTree<T>& tree, T* u_rate, LoadSum<T>& sum,
           Responded&& responded) {
    ask(loads, tree);
    for (int b = 0; b < bodies_; ++b) without_[idx(b)] = tree.acceleration(b);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      respond(lines_[i], tree);
      responded(i);
    }
    solve();
    for (const Line& line : lines_) {
      for (std::size_t k = 0; k < line.rates.size(); ++k) u_rate[k] += line.tension * line.rates[k];
      for (std::size_t k = 0; k < line.touched.size(); ++k) {
        BodyLoad<T>& wrench = sum.wrench[line.touched[k]];
        const Wrench<T> by = line.tension * line.unit[k];
        wrench.force += by.force();
        wrench.moment += by.moment();
      }
      sum.add_power(line.winding * line.tension);
    }
  }

 private:
  struct Line {
    Lists list;
    std::size_t at;
    std::vector<int> touched;
    std::vector<Wrench<T>> unit, path;  // of 1 N, with and without friction, by touched body
    std::vector<Twist<T>> response;     // of the bodies to the unit
    std::vector<T> rates;               // of the speeds, likewise
    T mass, winding, tension;
  };

  void ask(const LoadsByLane<L>& loads, const ArticulatedTree<T>& tree) {
    const auto one = [&](int lane) {
      for (const int b : loads.bodies()) {
        const Vec6<T> a = tree.acceleration(b).vector();
        for (int i = 0; i < 6; ++i) acceleration_[idx(b)][i] = a[i][lane];
      }
      const LoadInput<double> in = loads.input(lane, none());
      for (Line& line : lines_) {
        for (const int b : line.list[0]->bodies[line.at]) {
          unit_lane_[idx(b)] = path_lane_[idx(b)] = Vec6d::Zero();
        }
        line.list[idx(lane)]->inertial(line.at, in, told_);
        for (const InertialTension::Pull& p : told_.pulls) {
          p.add_to(unit_lane_[idx(p.body)], 1.0);
          path_lane_[idx(p.body)] += (Vec6d() << p.path.force, p.path.moment).finished();
        }
        const double a0 = told_.still - told_.mass * told_.along(acceleration_.data());
        put(line, lane, told_.mass, told_.winding, a0);
      }
    };
    loads.for_each_lane(one, [&](int lane) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      for (Line& line : lines_) put(line, lane, none, none, none);
    });
  }

  void put(Line& line, int lane, double mass, double winding, double tension) {
    line.mass.set(lane, mass);
    line.winding.set(lane, winding);
    line.tension.set(lane, tension);
    for (std::size_t k = 0; k < line.touched.size(); ++k) {
      set_lane(line.unit[k], lane, unit_lane_[idx(line.touched[k])]);
      set_lane(line.path[k], lane, path_lane_[idx(line.touched[k])]);
    }
  }

  static void set_lane(Wrench<T>& wrench, int lane, const Vec6d& value) {
    Vec6<T> all = wrench.vector();
    for (int i = 0; i < 6; ++i) all[i].set(lane, value[i]);
    wrench = Wrench<T>(all);
  }

  void respond(Line& line, ArticulatedTree<T>& tree) {
    for (int b = 0; b < bodies_; ++b) tree.set_load(b, Wrench<T>::zero());
    for (std::size_t k = 0; k < line.touched.size(); ++k) tree.set_load(line.touched[k], line.unit[k]);
    tree.solve(false, line.rates.data());
    for (int b = 0; b < bodies_; ++b) line.response[idx(b)] = tree.acceleration(b);
  }

  static T dot_path(const Line& line, const std::vector<Twist<T>>& acceleration) {
    T sum(0.0);
    for (std::size_t k = 0; k < line.touched.size(); ++k) {
      sum += dot(acceleration[idx(line.touched[k])], line.path[k]);
    }
    return sum;
  }

  /// T_i + m_i sum_j (v_i . w_j) T_j = T_i(a0), into the lines' tensions.
  void solve() {
    const std::size_t n = lines_.size();
    const auto at = [&](std::size_t i, std::size_t j) -> T& { return matrix_[n * i + j]; };
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        at(i, j) = T(i == j ? 1.0 : 0.0) + lines_[i].mass * dot_path(lines_[i], lines_[j].response);
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = k + 1; i < n; ++i) {
        const T factor = at(i, k) / at(k, k);
        for (std::size_t j = k; j < n; ++j) at(i, j) -= factor * at(k, j);
        lines_[i].tension -= factor * lines_[k].tension;
      }
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t j = i + 1; j < n; ++j) lines_[i].tension -= at(i, j) * lines_[j].tension;
      lines_[i].tension /= at(i, i);
    }
  }

  int bodies_;
  std::vector<Line> lines_;
  std::vector<T> matrix_;
  std::vector<double> zero_;
  std::vector<Twist<T>> without_;                            // accelerations without the tensions, by body
  std::vector<Vec6d> acceleration_, unit_lane_, path_lane_;  // of one lane, by body
  InertialTension told_;
};

}  // namespace seacrane
