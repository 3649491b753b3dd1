#include "seacrane/dynamics/inertial_tensions.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

InertialTensions::InertialTensions(const Model& model)
    : bodies_(model.body_count()), load_(idx(model.body_count()) + 1, Vec6d::Zero()) {
  const Eigen::Index n = model.inertial_tensions;
  on_.resize(idx(n));
  model.loads.for_each([&](const LoadList& list, std::size_t i) {
    const int place = list.inertial_place(i);
    if (place < 0) return;
    loads_.push_back({&list, i, place});
    std::vector<int>& on = on_[idx(place)] = list.bodies[i];
    std::ranges::sort(on);
    on.erase(std::ranges::unique(on).begin(), on.end());
    std::erase(on, bodies_);
  });
  for (auto* wrenches : {&unit_, &path_, &response_}) wrenches->assign(idx(n), load_);
  for (auto* values : {&mass_, &winding_, &tension_, &change_}) *values = VecXd::Zero(n);
  std::vector<int> all(idx(bodies_));
  std::iota(all.begin(), all.end(), 0);
  confine(std::vector<std::vector<int>>(idx(n), all));
}

void InertialTensions::confine(std::vector<std::vector<int>> moved) {
  moved_ = std::move(moved);
  felt_.assign(moved_.size(), {});
  int band = 0;
  for (int j = 0; j < count(); ++j) {
    const std::vector<int>& by_j = moved_[idx(j)];
    for (int i = 0; i < count(); ++i) {
      std::vector<int> at = on_[idx(i)];
      std::erase_if(at, [&](int b) { return std::ranges::find(by_j, b) == by_j.end(); });
      if (at.empty()) continue;
      felt_[idx(j)].push_back({i, std::move(at)});
      band = std::max(band, std::abs(i - j));
    }
  }
  equations_ = BandLu(count(), band);
}

double InertialTensions::dot(Eigen::Index line, const std::vector<int>& bodies,
                             const Vec6d* acceleration) const {
  double sum = 0.0;
  for (const int b : bodies) sum += path_[idx(line)][idx(b)].dot(acceleration[b]);
  return sum;
}

double InertialTensions::along(Eigen::Index line, const Vec6d* acceleration) const {
  return -mass_[line] * dot(line, on_[idx(line)], acceleration);
}

void InertialTensions::start(const Terms& terms, double t, const double* memory, const Vec6d* acceleration) {
  const LoadInput<double> in = terms.load_input(t, memory);
  for (const Tensioned& one : loads_) {
    std::vector<Vec6d>&unit = unit_[idx(one.place)], &path = path_[idx(one.place)];
    for (const int b : one.list->bodies[one.at]) unit[idx(b)] = path[idx(b)] = Vec6d::Zero();
    const InertialTension now = one.list->inertial(one.at, in, acceleration, unit.data(), path.data());
    unit.back() = path.back() = Vec6d::Zero();
    mass_[one.place] = now.mass;
    winding_[one.place] = now.winding;
    change_[one.place] = now.tension;
  }
}

const VecXd& InertialTensions::finish(Terms& terms) {
  MatXd& matrix = equations_.matrix();
  equations_.clear();
  for (int j = 0; j < count(); ++j) {
    for (const auto& [i, at] : felt_[idx(j)]) matrix(i, j) = mass_[i] * dot(i, at, response(j).data());
    matrix(j, j) += 1.0;
  }
  equations_.factor();
  tension_ = change_;
  equations_.solve(tension_);
  std::fill(load_.begin(), load_.end(), Vec6d::Zero());
  add_loads(tension_, load_.data());
  terms.add_inertial(tension_, winding_, load_);
  return tension_;
}

void InertialTensions::add_accelerations(std::vector<Vec6d>& acceleration) const {
  for (const Tensioned& one : loads_) {
    const std::vector<Vec6d>& response = response_[idx(one.place)];
    for (const int b : moved_[idx(one.place)]) acceleration[idx(b)] += tension_[one.place] * response[idx(b)];
  }
}

const VecXd& InertialTensions::change(const VecXd& own, const Vec6d* acceleration) {
  change_ = own;
  for (const Tensioned& one : loads_) change_[one.place] += along(one.place, acceleration);
  equations_.solve(change_);
  return change_;
}

void InertialTensions::add_loads(const VecXd& tension, Vec6d* load) const {
  for (const Tensioned& one : loads_) {
    const std::vector<Vec6d>& unit = unit_[idx(one.place)];
    for (const int b : on_[idx(one.place)]) load[b] += tension[one.place] * unit[idx(b)];
  }
}

double InertialTensions::absolute_power(const VecXd& change) const {
  double sum = 0.0;
  for (const Tensioned& one : loads_) {
    const double rate = winding_[one.place];
    sum += (rate * tension_[one.place] < 0.0 ? -rate : rate) * change[one.place];
  }
  return sum;
}

}  // namespace seacrane
