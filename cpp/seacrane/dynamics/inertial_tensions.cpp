#include "seacrane/dynamics/inertial_tensions.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "seacrane/dynamics/terms.hpp"

namespace seacrane {

InertialTensions::InertialTensions(const Model& model)
    : on_(idx(model.inertial_tensions)),
      response_(on_.size(), std::vector<Vec6d>(idx(model.body_count()) + 1, Vec6d::Zero())),
      unit_(idx(model.body_count()) + 1, Vec6d::Zero()),
      tension_(VecXd::Zero(model.inertial_tensions)),
      change_(tension_) {
  const int ground = model.body_count();
  model.loads.for_each([&](const LoadList& list, std::size_t i) {
    const int place = list.inertial_place(i);
    if (place < 0) return;
    std::vector<int>& on = on_[idx(place)] = list.bodies[i];
    std::ranges::sort(on);
    on.erase(std::ranges::unique(on).begin(), on.end());
    std::erase(on, ground);
  });
  std::vector<int> all(idx(ground));
  std::iota(all.begin(), all.end(), 0);
  confine(std::vector<std::vector<int>>(on_.size(), all));
}

void InertialTensions::confine(std::vector<std::vector<int>> moved) {
  moved_ = std::move(moved);
  felt_.assign(moved_.size(), {});
  Eigen::Index band = 0;
  for (Eigen::Index j = 0; j < count(); ++j) {
    const auto moves = [&](int b) { return std::ranges::find(moved_[idx(j)], b) != moved_[idx(j)].end(); };
    for (Eigen::Index i = 0; i < count(); ++i) {
      if (std::ranges::none_of(on_[idx(i)], moves)) continue;
      felt_[idx(j)].push_back(i);
      band = std::max(band, std::abs(i - j));
    }
  }
  equations_ = BandLu(count(), band);
}

void InertialTensions::start(const Terms& terms, const Vec6d* acceleration) {
  told_ = &terms.told();
  for (Eigen::Index i = 0; i < count(); ++i) change_[i] = told(i).still + along(i, acceleration);
}

const std::vector<Vec6d>& InertialTensions::unit(Eigen::Index line) {
  std::ranges::fill(unit_, Vec6d::Zero());
  for (const InertialTension::Pull& p : pulls(line)) p.add_to(unit_[idx(p.body)], 1.0);
  unit_.back().setZero();
  return unit_;
}

const VecXd& InertialTensions::finish(Terms& terms) {
  MatXd& matrix = equations_.matrix();
  equations_.clear();
  for (Eigen::Index j = 0; j < count(); ++j) {
    for (const Eigen::Index i : felt_[idx(j)]) matrix(i, j) = -along(i, response(j).data());
    matrix(j, j) += 1.0;
  }
  equations_.factor();
  tension_ = change_;
  equations_.solve(tension_);
  terms.add_inertial(tension_);
  return tension_;
}

void InertialTensions::add_accelerations(std::vector<Vec6d>& acceleration) const {
  for (Eigen::Index i = 0; i < count(); ++i) {
    for (const int b : moved_[idx(i)]) acceleration[idx(b)] += tension_[i] * response_[idx(i)][idx(b)];
  }
}

const VecXd& InertialTensions::change(const VecXd& own, const Vec6d* acceleration) {
  for (Eigen::Index i = 0; i < count(); ++i) change_[i] = own[i] + along(i, acceleration);
  equations_.solve(change_);
  return change_;
}

void InertialTensions::add_loads(const VecXd& tension, Vec6d* load) const {
  for (Eigen::Index i = 0; i < count(); ++i) {
    for (const InertialTension::Pull& p : pulls(i)) {
      if (idx(p.body) + 1 < unit_.size()) p.add_to(load[p.body], tension[i]);
    }
  }
}

double InertialTensions::power(const VecXd& change) const {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count(); ++i) sum += told(i).winding * change[i];
  return sum;
}

double InertialTensions::absolute_power(const VecXd& change) const {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count(); ++i) {
    const double rate = told(i).winding;
    sum += (rate * tension_[i] < 0.0 ? -rate : rate) * change[i];
  }
  return sum;
}

}  // namespace seacrane
