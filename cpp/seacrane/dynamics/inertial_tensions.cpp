#include "seacrane/dynamics/inertial_tensions.hpp"

#include <algorithm>
#include <cmath>

#include "seacrane/dynamics/terms.hpp"
#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {

InertialTensions::InertialTensions(const Model& model)
    : bodies_(model.body_count()), load_(idx(model.body_count()) + 1, Vec6d::Zero()) {
  const Eigen::Index n = model.inertial_tensions;
  for (const Line& line : std::get<std::vector<Line>>(*model.loads)) {
    if (line.quasi_static()) lines_.push_back(&line);
  }
  for (auto* wrenches : {&unit_, &path_, &response_}) wrenches->assign(idx(n), load_);
  for (auto* values : {&mass_, &winding_, &tension_, &change_}) *values = VecXd::Zero(n);
  matrix_ = MatXd::Identity(n, n);
  factors_ = Eigen::PartialPivLU<MatXd>(n);
}

double InertialTensions::dot(Eigen::Index line, const Vec6d* acceleration) const {
  double sum = 0.0;
  for (int b = 0; b < bodies_; ++b) sum += path_[idx(line)][idx(b)].dot(acceleration[b]);
  return sum;
}

double InertialTensions::along(Eigen::Index line, const Vec6d* acceleration) const {
  return -mass_[line] * dot(line, acceleration);
}

void InertialTensions::start(const Terms& terms, double t, const double* memory, const Vec6d* acceleration) {
  const LoadInput<double> in = terms.load_input(t, memory);
  for (const Line* line : lines_) {
    std::vector<Vec6d>&unit = unit_[idx(line->place)], &path = path_[idx(line->place)];
    for (const int b : line->bodies()) unit[idx(b)] = path[idx(b)] = Vec6d::Zero();
    line->add_unit(0, in, unit.data());
    line->add_path(in, path.data());
    unit.back() = path.back() = Vec6d::Zero();
    const Line::Motion<double> now = line->motion(in);
    mass_[line->place] = line->inertial_mass(now);
    winding_[line->place] = now.power_per_inertial();
    change_[line->place] = line->inertial_tension(in, now, acceleration);
  }
}

const VecXd& InertialTensions::finish(Terms& terms) {
  for (const Line* j : lines_) {
    for (const Line* i : lines_) {
      const double own = i == j ? 1.0 : 0.0;
      matrix_(i->place, j->place) = own + mass_[i->place] * dot(i->place, response(j->place).data());
    }
  }
  factors_.compute(matrix_);
  tension_.noalias() = factors_.solve(change_);
  std::fill(load_.begin(), load_.end(), Vec6d::Zero());
  add_loads(tension_, load_.data());
  terms.add_inertial(tension_, winding_, load_);
  return tension_;
}

void InertialTensions::add_accelerations(std::vector<Vec6d>& acceleration) const {
  for (const Line* line : lines_) {
    const std::vector<Vec6d>& response = response_[idx(line->place)];
    for (int b = 0; b < bodies_; ++b) acceleration[idx(b)] += tension_[line->place] * response[idx(b)];
  }
}

const VecXd& InertialTensions::change(const VecXd& own, const Vec6d* acceleration) {
  change_ = own;
  for (const Line* line : lines_) change_[line->place] += along(line->place, acceleration);
  change_ = factors_.solve(VecXd(change_));
  return change_;
}

void InertialTensions::add_loads(const VecXd& tension, Vec6d* load) const {
  for (const Line* line : lines_) {
    const std::vector<Vec6d>& unit = unit_[idx(line->place)];
    for (int b = 0; b < bodies_; ++b) load[b] += tension[line->place] * unit[idx(b)];
  }
}

double InertialTensions::absolute_power(const VecXd& change) const {
  double sum = 0.0;
  for (const Line* line : lines_) {
    const double rate = winding_[line->place];
    sum += (rate * tension_[line->place] < 0.0 ? -rate : rate) * change[line->place];
  }
  return sum;
}

}  // namespace seacrane
